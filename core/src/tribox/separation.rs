//! Two hierarchies of triboxes, one of them moved: a proof that the models are apart, or farther
//! than a distance from each other, or where they may meet.

use super::separating_axes::{Axes, Body};
use crate::geom::Pose;
use crate::query::{Budget, Ended, QueryError, ScratchEntry, Work};
use crate::tribox::format::Triboxes;
use core::ops::ControlFlow;

/// A node of each hierarchy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
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

/// Whether two models are apart, or farther than a distance from each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct Separation {
    /// A pair of nodes that may meet, or may be within the distance: the first one found. Both are
    /// leaves unless `ended` says otherwise. `None` is a proof that the meshes have no common
    /// point, and, where both are solids, that no point is in both; or that all points of both
    /// meshes or solids are farther than the distance from each other.
    pub may_meet: Option<NodePair>,
    /// The work of the search: pairs tested, pairs opened.
    pub work: Work,
    /// [`Ended::Scratch`] or [`Ended::Steps`] if the search could not open the pair.
    pub ended: Ended,
}

impl Separation {
    /// Whether the models are proved to be apart, or farther than the distance from each other.
    pub fn is_apart(&self) -> bool {
        self.may_meet.is_none()
    }
}

/// Where two models may meet. The pairs are in the caller's slice. Without any the models are
/// proved to be apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct TriboxCandidates {
    /// Pairs in the slice.
    pub stored: usize,
    /// Pairs that did not fit.
    pub dropped: u32,
    /// The work of the search: pairs tested, pairs opened.
    pub work: Work,
    /// [`Ended::Scratch`] or [`Ended::Steps`]: some pairs are not of leaves. Between all other
    /// pairs there is no common point all the same.
    pub ended: Ended,
}

impl TriboxCandidates {
    /// Whether the models are proved to be apart.
    pub fn is_apart(&self) -> bool {
        self.stored == 0 && self.dropped == 0
    }
}

impl Triboxes<'_> {
    /// With this many scratch entries neither [`separation`](Triboxes::separation) nor
    /// [`within_of`](Triboxes::within_of) nor [`candidates`](Triboxes::candidates) ends for lack of
    /// memory: one more than both depths together.
    pub fn separation_entries(&self, other: &Triboxes<'_>) -> usize {
        (self.depth() + other.depth()) as usize + 1
    }

    /// Whether this model is apart from `other`, moved by `pose` from its frame to this one's, both
    /// in input units.
    ///
    /// Descends both hierarchies, always into the larger of two nodes. Two nodes are apart if one
    /// of the eighteen directions of both shows a gap. The other node's extent along the direction
    /// is computed exactly, up to rounding (`tribox/support`). The paper takes the extent of a
    /// tribox around the moved vertices, which is a third to a half larger. The search ends with
    /// the first pair of leaves that may meet.
    ///
    /// The matrix is taken as exact. If it is an affine one, fewer pairs are proved apart. Below
    /// f32's normal range all pairs may meet. Of the budget only `steps` matters: pairs opened.
    ///
    /// Cost: some 2,000 instructions of a Cortex-M4F once, 1,500 a pair on average; 2 KiB of stack.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Pose, Scratch, Triboxes};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/torus.msw"));
    /// let (part, mut scratch) = (Triboxes::open(bytes)?, Scratch::<64>::new());
    /// let pose = Pose { translation: [300.0, 0.0, 0.0], ..Pose::IDENTITY };
    /// let found = part.separation(&part, pose, Budget::EXACT, &mut scratch)?;
    /// assert!(found.is_apart());
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`QueryError::NotFinite`]; [`QueryError::PoseOutOfDomain`] for an entry of the matrix beyond
    /// 2 or a translation beyond [`Tribox::DOMAIN`](crate::Tribox::DOMAIN);
    /// [`QueryError::NotRigid`] for a matrix that is no rotation, unless it is [`Pose::affine`];
    /// [`QueryError::Tolerance`], [`QueryError::NoScratch`].
    #[inline]
    pub fn separation(
        &self,
        other: &Triboxes<'_>,
        pose: Pose,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<Separation, QueryError> {
        self.within_of(other, pose, 0.0, budget, scratch)
    }

    /// Whether this model is farther than `distance` from `other`, moved by `pose`. All lengths in
    /// input units.
    ///
    /// [`Separation::is_apart`] is a proof that it is, for the input meshes and, where both are
    /// solids, for their insides. There is no proof that the models are nearer. Two nodes are
    /// farther if one of the eighteen directions shows a gap of more than the distance. Between
    /// edges or vertices that gap is less than their distance, so some models that are farther stay
    /// unproved. To cover a rounded pose, add [`RoundedPose::motion`](crate::RoundedPose::motion)
    /// of both models. A distance of 0 asks whether the models are apart.
    ///
    /// Arguments and cost as for [`separation`](Triboxes::separation).
    ///
    /// ```
    /// use meshsweep_core::{Budget, Pose, Scratch, Triboxes};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/torus.msw"));
    /// let (part, mut scratch) = (Triboxes::open(bytes)?, Scratch::<64>::new());
    /// let pose = Pose { translation: [300.0, 0.0, 0.0], ..Pose::IDENTITY };
    /// let found = part.within_of(&part, pose, 20.0, Budget::EXACT, &mut scratch)?;
    /// assert!(found.is_apart());
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`separation`](Triboxes::separation); [`QueryError::Tolerance`] also for a distance
    /// that is negative, NaN or infinite.
    #[inline(never)]
    pub fn within_of(
        &self,
        other: &Triboxes<'_>,
        pose: Pose,
        distance: f32,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<Separation, QueryError> {
        // A distance is refused as an absolute tolerance is.
        budget.with_absolute(distance).check()?;
        let mut may_meet = None;
        let (work, ended) = descend([self, other], &pose, distance, &budget, scratch, |pair| {
            may_meet = Some(pair);
            ControlFlow::Break(())
        })?;
        Ok(Separation { may_meet, work, ended })
    }

    /// All pairs of leaves of this model and of `other`, moved by `pose`, that may meet, into
    /// `pairs`.
    ///
    /// Arguments, errors and cost as for [`separation`](Triboxes::separation).
    ///
    /// ```
    /// use meshsweep_core::{Budget, NodePair, Pose, Scratch, Triboxes};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/torus.msw"));
    /// let (part, mut scratch) = (Triboxes::open(bytes)?, Scratch::<64>::new());
    /// let mut pairs = [NodePair::EMPTY; 16];
    /// let exact = Budget::EXACT;
    /// let found = part.candidates(&part, Pose::IDENTITY, &mut pairs, exact, &mut scratch)?;
    /// assert!(!found.is_apart());
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`separation`](Triboxes::separation).
    #[inline(never)]
    pub fn candidates(
        &self,
        other: &Triboxes<'_>,
        pose: Pose,
        pairs: &mut [NodePair],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<TriboxCandidates, QueryError> {
        let (mut stored, mut dropped) = (0, 0u32);
        let (work, ended) = descend([self, other], &pose, 0.0, &budget, scratch, |pair| {
            match pairs.get_mut(stored) {
                Some(slot) => (*slot, stored) = (pair, stored + 1),
                None => dropped = dropped.saturating_add(1),
            }
            ControlFlow::Continue(())
        })?;
        Ok(TriboxCandidates { stored, dropped, work, ended })
    }
}

/// A pair of nodes on the stack.
#[inline(always)]
fn entry(a: u32, b: u32) -> ScratchEntry {
    ScratchEntry::of_words([a, b])
}

/// Calls `found` with every pair that may be within `distance` and that was not opened.
fn descend(
    [a, b]: [&Triboxes<'_>; 2],
    pose: &Pose,
    distance: f32,
    budget: &Budget,
    stack: &mut [ScratchEntry],
    mut found: impl FnMut(NodePair) -> ControlFlow<()>,
) -> Result<(Work, Ended), QueryError> {
    budget.check_with(stack)?;
    let mut axes = Axes::NONE;
    axes.prepare(a, b, pose, distance)?;
    let mut work = Work::default();
    let mut ended = Ended::Exact;
    let mut hint = (0, 0);
    *stack.first_mut().ok_or(QueryError::NoScratch)? = entry(0, 0);
    let mut waiting = 1usize;
    while let Some(top) = waiting.checked_sub(1) {
        let [node_a, node_b] = stack.get(top).ok_or(QueryError::Unchecked)?.words();
        waiting = top;
        let body_a = Body::of(a, node_a).ok_or(QueryError::Unchecked)?;
        let body_b = Body::of(b, node_b).ok_or(QueryError::Unchecked)?;
        work.bounds += 1;
        if axes.separate(&body_a, &body_b, &mut hint) {
            continue;
        }
        let (below_a, below_b) = (a.children(node_a), b.children(node_b));
        let a_first = body_a.size() >= body_b.size();
        let opened = match (below_a, below_b) {
            (Some(children), below) if a_first || below.is_none() => Some((children, true)),
            (_, Some(children)) => Some((children, false)),
            _ => None,
        };
        let free = stack.get_mut(top..).and_then(|rest| rest.first_chunk_mut::<2>());
        match (opened, free) {
            (Some((children, of_a)), Some(free)) if work.opened < budget.steps => {
                work.opened += 1;
                *free = children
                    .map(|child| if of_a { entry(child, node_b) } else { entry(node_a, child) });
                waiting = top + 2;
            }
            (opened, free) => {
                if opened.is_some() {
                    ended = if free.is_some() { Ended::Steps } else { Ended::Scratch };
                }
                // Node numbers are below 2^16.
                if found(NodePair { a: node_a as u16, b: node_b as u16 }).is_break() {
                    break;
                }
            }
        }
    }
    Ok((work, ended))
}
