//! The descent that all distance questions share: nearest child first, the others on the caller's
//! stack, unsorted.
//!
//! Sorting them, or a heap, visits fewer nodes and takes longer: what decides is how often a branch
//! is guessed wrong. So every lane is stored and the stack's end moves on if the lane is wanted;
//! the nearest is followed at once. Keys never fall from parent to child, so that the set of leaves
//! that a question depends on does not depend on the order of visits.

use crate::bvh::format::{Bvh, FanLeaf};
use crate::bvh::node::{LANE_MASK, NodeFrame, WIDE, box_distances, nearest_lane};
use crate::geom::fan::WIDTH;
use crate::query::ScratchEntry;
use crate::query::{QueryError, Work};
use glam::Vec3;

/// A leaf that a descent has come to.
pub(crate) struct LeafVisit<'a> {
    pub(crate) leaf: FanLeaf<'a>,
    /// Squared lower bound of everything in it.
    pub(crate) key: f32,
    pub(crate) node: u32,
    pub(crate) lane: u32,
}

/// What a question does with leaves.
pub(crate) trait LeafVisitor {
    /// Squared bound above which nothing is wanted.
    fn limit(&self) -> f32;

    /// Looks at a leaf; `Some(false)` ends the descent, `None` says that the tree is not one that
    /// was opened.
    fn leaf(&mut self, visit: &LeafVisit<'_>) -> Option<bool>;
}

/// How a descent ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Descent {
    /// Nothing within the limit is left.
    Done,
    /// The question was answered early.
    Answered,
    /// The budget is used up, or something did not fit the stack: nothing below this squared bound
    /// was missed.
    Truncated { least: f32, steps: bool },
}

/// Puts the children of `node` within the limit on the stack, but for the nearest.
#[inline(always)]
#[allow(clippy::too_many_arguments, reason = "the state of both descents, inlined")]
pub(crate) fn push_children(
    stack: &mut [ScratchEntry],
    waiting: &mut usize,
    dropped: &mut f32,
    node: u32,
    keys: &[f32; WIDTH],
    count: u32,
    nearest: f32,
    limit: f32,
) {
    let room = stack.get_mut(*waiting..).and_then(|rest| rest.first_chunk_mut::<WIDTH>());
    if WIDE && let Some(slots) = room {
        let mut next = 0usize;
        for &key in keys {
            slots[next & (WIDTH - 1)] = ScratchEntry { key, node };
            next += usize::from((key <= limit) & (key != nearest));
        }
        *waiting += next;
        return;
    }
    // Bits of numbers that are not negative compare as the numbers do.
    let (limit, nearest) = (limit.to_bits(), nearest.to_bits());
    for &key in keys.iter().take(count as usize) {
        if key.to_bits() <= limit && key.to_bits() != nearest {
            match stack.get_mut(*waiting) {
                Some(slot) => {
                    *slot = ScratchEntry { key, node };
                    *waiting += 1;
                }
                None => *dropped = if key < *dropped { key } else { *dropped },
            }
        }
    }
}

/// Visits every leaf within `visitor`'s limit.
#[inline(always)]
pub(crate) fn descend(
    tree: &Bvh<'_>,
    p: Vec3,
    stack: &mut [ScratchEntry],
    steps: u32,
    visitor: &mut impl LeafVisitor,
    work: &mut Work,
) -> Result<Descent, QueryError> {
    let mut waiting = 0usize;
    let mut dropped = f32::INFINITY;
    let mut node = 0u32;
    let mut bound = 0f32;
    loop {
        if work.splits >= steps {
            let rest = stack
                .iter()
                .take(waiting)
                .fold(bound.min(dropped), |least, entry| least.min(entry.key));
            return Ok(Descent::Truncated { least: rest, steps: true });
        }
        let links = tree.links(node).ok_or(QueryError::Model)?;
        let record = tree.frame(node).ok_or(QueryError::NotServed)?;
        let frame = NodeFrame::of(record, p);
        let keys = box_distances(record, &frame, links.count, bound);
        work.splits += 1;
        work.nodes += links.count;
        let nearest = nearest_lane(&keys);
        let limit = visitor.limit();
        let mut found = nearest <= limit;
        if found {
            push_children(
                stack,
                &mut waiting,
                &mut dropped,
                node,
                &keys,
                links.count,
                nearest,
                limit,
            );
        }
        // The nearest child's links are at hand; what comes off the stack has to look its parent's
        // up.
        let mut child = links.child(nearest.to_bits() & LANE_MASK);
        let mut entry = ScratchEntry { key: nearest, node };
        loop {
            if found {
                bound = f32::from_bits(entry.key.to_bits() & !LANE_MASK);
                if !child.is_leaf() {
                    node = child.at;
                    break;
                }
                work.triangles += child.tag.triangles() as u32;
                let leaf = tree.patch(child.at, child.tag).ok_or(QueryError::Model)?;
                let lane = entry.key.to_bits() & LANE_MASK;
                let visit = LeafVisit { leaf, key: bound, node: entry.node, lane };
                if !visitor.leaf(&visit).ok_or(QueryError::Model)? {
                    return Ok(Descent::Answered);
                }
            }
            found = true;
            loop {
                let Some(top) = waiting.checked_sub(1) else {
                    return Ok(if dropped <= visitor.limit() {
                        Descent::Truncated { least: dropped, steps: false }
                    } else {
                        Descent::Done
                    });
                };
                waiting = top;
                entry = stack.get(top).copied().ok_or(QueryError::Model)?;
                if entry.key <= visitor.limit() {
                    break;
                }
            }
            child =
                tree.child(entry.node, entry.key.to_bits() & LANE_MASK).ok_or(QueryError::Model)?;
        }
    }
}
