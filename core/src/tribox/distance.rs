//! Lower bounds from triboxes: of a point's distance, and of where a segment may first meet a
//! model.

use super::bounds::{Tribox, TriboxError};
use crate::query::{Ended, QueryError, Work};
use crate::tribox::format::Triboxes;

/// An entry of the stack.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundEntry {
    lower: f32,
    node: u32,
}

impl BoundEntry {
    /// Any value, for filling arrays.
    pub const EMPTY: BoundEntry = BoundEntry { lower: f32::INFINITY, node: 0 };
}

/// A lower bound that a union of triboxes gives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bound {
    /// Nothing of the mesh, or of its inside where that counts, is nearer (of a distance, input
    /// units), or at a lesser parameter of the segment. Infinity if there is nothing of it on
    /// the segment at all.
    pub lower: f32,
    /// The node that decided; `None` if `lower` is infinite.
    pub node: Option<u32>,
    /// What it cost: triboxes tested, nodes opened.
    pub work: Work,
    /// [`Ended::Capacity`] if the stack was too short: then the bound may be lower than it need
    /// be.
    pub ended: Ended,
}

/// A lower bound of the distance of a point and the mesh: the distance to the leaf that is nearest
/// by [`Tribox::distance`]. 0 in a leaf.
///
/// A stack of [`depth`](Triboxes::depth) + 2 entries suffices. Cost: about a thousand instructions
/// of a Cortex-M4F a tribox tested.
///
/// # Errors
/// [`QueryError::NotFinite`] and [`QueryError::OutOfDomain`] (beyond [`Tribox::DOMAIN`]) of the
/// point; [`QueryError::NoQueue`] without a stack.
pub fn distance(
    triboxes: &Triboxes<'_>,
    point: [f32; 3],
    stack: &mut [BoundEntry],
) -> Result<Bound, QueryError> {
    Tribox::of_point(point)?;
    least(triboxes, stack, |tribox| Some(tribox.distance(point)))
}

/// Parameter before which the segment from `a` (0) to `b` (1) is clear of the mesh: where it first
/// enters a leaf, by [`Tribox::clip`].
///
/// Stack, cost and errors are those of [`distance`]; both ends have to be in the domain. A segment
/// of no length is at 0 or nowhere.
///
/// # Errors
/// Those of [`distance`].
pub fn clip(
    triboxes: &Triboxes<'_>,
    a: [f32; 3],
    b: [f32; 3],
    stack: &mut [BoundEntry],
) -> Result<Bound, QueryError> {
    Tribox::of_point(a)?;
    Tribox::of_point(b)?;
    least(triboxes, stack, |tribox| tribox.clip(a, b).map(|(enter, _)| enter))
}

impl From<TriboxError> for QueryError {
    fn from(error: TriboxError) -> Self {
        match error {
            TriboxError::NotFinite => QueryError::NotFinite,
            TriboxError::OutOfDomain => QueryError::OutOfDomain,
        }
    }
}

/// The least bound of a leaf, nearer children first.
fn least(
    triboxes: &Triboxes<'_>,
    stack: &mut [BoundEntry],
    bound: impl Fn(&Tribox) -> Option<f32>,
) -> Result<Bound, QueryError> {
    let mut answer =
        Bound { lower: f32::INFINITY, node: None, work: Work::default(), ended: Ended::Exact };
    let enter = |node: u32, above: f32, work: &mut Work| {
        work.nodes += 1;
        let tribox = triboxes.node(node).ok_or(QueryError::Model)?;
        let here = bound(&tribox).unwrap_or(f32::INFINITY);
        // Rounding may have given the parent more, and the child is a part of it.
        Ok::<BoundEntry, QueryError>(BoundEntry {
            lower: if here > above { here } else { above },
            node,
        })
    };
    let root = enter(0, 0.0, &mut answer.work)?;
    *stack.first_mut().ok_or(QueryError::NoQueue)? = root;
    let mut waiting = 1usize;
    while let Some(top) = waiting.checked_sub(1) {
        let entry = *stack.get(top).ok_or(QueryError::Model)?;
        waiting = top;
        if entry.lower >= answer.lower {
            continue;
        }
        let children = triboxes.children(entry.node);
        let room = stack.get_mut(top..).and_then(|rest| rest.first_chunk_mut::<2>());
        let (Some([first, second]), Some(room)) = (children, room) else {
            (answer.lower, answer.node) = (entry.lower, Some(entry.node));
            if children.is_some() {
                answer.ended = Ended::Capacity;
            }
            continue;
        };
        answer.work.splits += 1;
        let first = enter(first, entry.lower, &mut answer.work)?;
        let second = enter(second, entry.lower, &mut answer.work)?;
        *room = if first.lower < second.lower { [second, first] } else { [first, second] };
        waiting = top + 2;
    }
    Ok(answer)
}
