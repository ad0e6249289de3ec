//! Two hierarchies of triboxes, one of them moved: a proof that the models are apart, or where they
//! may meet.

use super::separating_axes::{Axes, Body};
use crate::geom::Pose;
use crate::query::{Ended, QueryError, Work};
use crate::tribox::format::Triboxes;
use core::ops::ControlFlow;

/// A node of each hierarchy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NodePair {
    /// Node of the first.
    pub a: u16,
    /// Node of the second, which is moved.
    pub b: u16,
}

impl NodePair {
    /// Any value, for filling arrays.
    pub const EMPTY: NodePair = NodePair { a: 0, b: 0 };
}

/// Whether two models are apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reject {
    /// A pair of nodes that may meet: the first one found, of two leaves unless `ended` says
    /// [`Ended::Capacity`]. `None` is a proof that the meshes have no common point, and
    /// that where both are solids no point is in both.
    pub may_meet: Option<NodePair>,
    /// What it cost: pairs tested, pairs opened.
    pub work: Work,
    /// [`Ended::Capacity`] if the stack was too short to look closer at the pair.
    pub ended: Ended,
}

impl Reject {
    /// Whether the models are proved to be apart.
    pub fn is_apart(&self) -> bool {
        self.may_meet.is_none()
    }
}

/// Where two models may meet; the pairs are in the caller's slice. Without any the models are
/// proved to be apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Candidates {
    /// Pairs in the slice.
    pub stored: usize,
    /// Pairs that did not fit.
    pub dropped: u32,
    /// What it cost: pairs tested, pairs opened.
    pub work: Work,
    /// [`Ended::Capacity`] if the stack was too short: then some pairs are not of leaves. Between
    /// any others there is no common point all the same.
    pub ended: Ended,
}

impl Candidates {
    /// Whether the models are proved to be apart.
    pub fn is_apart(&self) -> bool {
        self.stored == 0 && self.dropped == 0
    }
}

/// Stack entries with which neither [`apart`] nor [`candidates`] ends for want of them: one more
/// than both depths together.
pub fn stack_entries(a: &Triboxes<'_>, b: &Triboxes<'_>) -> usize {
    (a.depth() + b.depth()) as usize + 1
}

/// Whether two models are apart, the second one moved by `pose`, from its frame to the first one's;
/// both in input units.
///
/// Descends both hierarchies from the larger of two nodes to its children. Two nodes are apart if
/// one of the eighteen directions of both shows a gap, to which the other one's reach along that
/// direction is computed exactly, up to rounding (`core/src/tribox/support.rs`), and not, as in the
/// paper, that of a tribox around its moved vertices, which is a third to a half larger.
/// Ends with the first pair of leaves that may meet.
///
/// The matrix is taken as it is: if it is a rotation up to rounding only, so is the motion; if it
/// is none, less is told apart. Below f32's normal range everything may meet. Cost: some 2,000
/// instructions of a Cortex-M4F once, 1,500 a pair on average; 2 KiB of stack.
///
/// # Errors
/// [`QueryError::NotFinite`] and [`QueryError::PoseOutOfDomain`] of a pose with such numbers (see
/// [`Pose::bound`]); [`QueryError::NoQueue`] without a stack.
pub fn apart(
    a: &Triboxes<'_>,
    b: &Triboxes<'_>,
    pose: &Pose,
    stack: &mut [NodePair],
) -> Result<Reject, QueryError> {
    let mut may_meet = None;
    let (work, ended) = descend(a, b, pose, stack, |pair| {
        may_meet = Some(pair);
        ControlFlow::Break(())
    })?;
    Ok(Reject { may_meet, work, ended })
}

/// All pairs of leaves of two models that may meet, the second one moved by `pose`; see [`apart`].
///
/// # Errors
/// Those of [`apart`].
pub fn candidates(
    a: &Triboxes<'_>,
    b: &Triboxes<'_>,
    pose: &Pose,
    pairs: &mut [NodePair],
    stack: &mut [NodePair],
) -> Result<Candidates, QueryError> {
    let (mut stored, mut dropped) = (0, 0u32);
    let (work, ended) = descend(a, b, pose, stack, |pair| {
        match pairs.get_mut(stored) {
            Some(slot) => (*slot, stored) = (pair, stored + 1),
            None => dropped = dropped.saturating_add(1),
        }
        ControlFlow::Continue(())
    })?;
    Ok(Candidates { stored, dropped, work, ended })
}

fn descend(
    a: &Triboxes<'_>,
    b: &Triboxes<'_>,
    pose: &Pose,
    stack: &mut [NodePair],
    mut found: impl FnMut(NodePair) -> ControlFlow<()>,
) -> Result<(Work, Ended), QueryError> {
    let mut axes = Axes::NONE;
    axes.prepare(a, b, pose)?;
    let mut work = Work::default();
    let mut ended = Ended::Exact;
    let mut hint = (0, 0);
    *stack.first_mut().ok_or(QueryError::NoQueue)? = NodePair { a: 0, b: 0 };
    let mut waiting = 1usize;
    while let Some(top) = waiting.checked_sub(1) {
        let pair = *stack.get(top).ok_or(QueryError::Model)?;
        waiting = top;
        let (number_a, number_b) = (u32::from(pair.a), u32::from(pair.b));
        let body_a = Body::of(a, number_a).ok_or(QueryError::Model)?;
        let body_b = Body::of(b, number_b).ok_or(QueryError::Model)?;
        work.nodes += 1;
        if axes.separate(&body_a, &body_b, &mut hint) {
            continue;
        }
        let (below_a, below_b) = (a.children(number_a), b.children(number_b));
        let a_first = body_a.size() >= body_b.size();
        let opened = match (below_a, below_b) {
            (Some(children), below) if a_first || below.is_none() => Some((children, true)),
            (_, Some(children)) => Some((children, false)),
            _ => None,
        };
        let Some((children, of_a)) = opened else {
            if found(pair).is_break() {
                break;
            }
            continue;
        };
        let Some(room) = stack.get_mut(top..).and_then(|rest| rest.first_chunk_mut::<2>()) else {
            ended = Ended::Capacity;
            if found(pair).is_break() {
                break;
            }
            continue;
        };
        work.splits += 1;
        *room = children.map(|child| {
            // Node numbers are below 2^16.
            let child = child as u16;
            if of_a { NodePair { a: child, ..pair } } else { NodePair { b: child, ..pair } }
        });
        waiting = top + 2;
    }
    Ok((work, ended))
}
