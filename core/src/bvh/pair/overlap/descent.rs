//! The descent of two trees at once. It visits pairs of nodes whose boxes meet, and at its end
//! pairs of leaves.
//!
//! All pairs of children of two nodes are tested together. The result is 64 bits: a byte for each
//! child of the first node, and in it a bit for each child of the second. A stack entry takes two
//! scratch entries, each with one node and 32 of the bits.

use crate::bvh::pair::leaf_pair::LeafPair;
use crate::bvh::pair::model_box::are_apart;
use crate::bvh::pair::models::{Models, most_pairs};
use crate::bvh::tree::axis_intervals::{AxisIntervals, Pairs, pairs};
use crate::bvh::tree::extended::extended;
use crate::bvh::tree::format::{Bvh, BvhChild};
use crate::bvh::tree::triangle_at::TriangleAt;
use crate::geom::{Contact, Pose};
use crate::num::lesser;
use crate::query::{Budget, Ended, PairVisitor, QueryError, RelativePose, ScratchEntry, Work};

/// Visits every pair of leaves whose boxes meet. Returns why the descent was truncated, or `None`.
#[inline(always)]
pub(crate) fn descend(
    [a, b]: [&Bvh<'_>; 2],
    pose: &Pose,
    budget: &Budget,
    scratch: &mut [ScratchEntry],
    visitor: &mut impl PairVisitor<[TriangleAt; 2]>,
) -> Result<(Option<Ended>, Work), QueryError> {
    let mut work = Work::default();
    if !(a.serves_segments() && b.serves_segments()) {
        return Err(QueryError::NO_SEGMENTS);
    }
    budget.check_with(scratch)?;
    if are_apart([a, b], pose, 0.0)? {
        return Ok((None, work));
    }
    let (stack, _) = scratch.as_chunks_mut::<2>();
    let Some(pose) = RelativePose::new(&extended(a), &extended(b), pose)? else {
        // The boxes are proved apart.
        return Ok((None, work));
    };
    let models = Models { a, b, pose: &pose };
    let steps = lesser(budget.steps, most_pairs(models.a, models.b));
    let mut truncated = None;
    let mut used = 0usize;
    let mut nodes = [0u32; 2];
    // The children of each node that still count, as bits.
    let mut wanted = [u32::MAX; 2];
    loop {
        if work.opened >= steps {
            return Ok((Some(Ended::Steps), work));
        }
        work.opened += 1;
        let pairs = models.pairs(nodes, wanted, &mut work).ok_or(QueryError::Unchecked)?;
        let mut next = None;
        if pairs.bits != [0; 2] {
            // Surfaces that meet mostly do so where boxes overlap most.
            next = Some((nodes, pairs.deepest));
            let left = without(pairs.bits, pairs.deepest);
            if left != [0; 2] {
                match stack.get_mut(used) {
                    Some(slot) => {
                        *slot = entry(nodes, left);
                        used += 1;
                    }
                    None => truncated = Some(Ended::Scratch),
                }
            }
        }
        // Finds the next pair with a node to open, and visits the pairs of leaves before it.
        loop {
            let Some((parents, indices)) = next.take().or_else(|| take(stack, &mut used)) else {
                return Ok((truncated, work));
            };
            let child = |tree: &Bvh<'_>, which: usize| tree.child(parents[which], indices[which]);
            let children = [
                child(a, 0).ok_or(QueryError::Unchecked)?,
                child(b, 1).ok_or(QueryError::Unchecked)?,
            ];
            let [opens_a, opens_b] = models.opened(&children).ok_or(QueryError::Unchecked)?;
            if opens_a || opens_b {
                // A child that is not opened stays a child of its parent, alone.
                let down = |opens: bool, which: usize| {
                    if opens {
                        (children[which].at, u32::MAX)
                    } else {
                        (parents[which], 1 << indices[which])
                    }
                };
                let ((first, rows), (second, columns)) = (down(opens_a, 0), down(opens_b, 1));
                nodes = [first, second];
                wanted = [rows, columns];
                break;
            }
            let go_on = models.leaves(parents, indices, children, visitor, &mut work);
            if !go_on.ok_or(QueryError::Unchecked)? {
                return Ok((truncated, work));
            }
        }
    }
}

/// An entry of the stack. Node numbers are below 2^24.
#[inline(always)]
fn entry([a, b]: [u32; 2], [low, high]: [u32; 2]) -> [ScratchEntry; 2] {
    [[a, low], [b, high]].map(ScratchEntry::of_words)
}

/// Takes the next pair off the stack: its parents, and which children.
#[inline(always)]
fn take(stack: &mut [[ScratchEntry; 2]], used: &mut usize) -> Option<([u32; 2], [u32; 2])> {
    let top = used.checked_sub(1)?;
    let slot = stack.get_mut(top)?;
    let [[a, low], [b, high]] = slot.map(ScratchEntry::words);
    let (word, base) = if low != 0 { (low, 0) } else { (high, 4) };
    let bit = word.trailing_zeros() & 31;
    let indices = [base + (bit >> 3), bit & 7];
    let rest = without([low, high], indices);
    *slot = entry([a, b], rest);
    if rest == [0; 2] {
        *used = top;
    }
    Some(([a, b], indices))
}

#[inline(always)]
fn without([low, high]: [u32; 2], [i, j]: [u32; 2]) -> [u32; 2] {
    let bit = 1 << (8 * (i & 3) + (j & 7));
    if i < 4 { [low & !bit, high] } else { [low, high & !bit] }
}

impl Models<'_> {
    /// Pairs of children of two nodes, `wanted` of each, whose boxes meet.
    #[inline(always)]
    fn pairs(&self, nodes: [u32; 2], wanted: [u32; 2], work: &mut Work) -> Option<Pairs> {
        let side = |tree: &Bvh<'_>, which: usize| {
            let (links, boxes) = (tree.links(nodes[which])?, tree.boxes(nodes[which])?);
            let intervals = AxisIntervals::of(&self.pose.frames[which], boxes, links.count)?;
            Some((intervals, links.mask() & wanted[which]))
        };
        let ((first, rows), (second, columns)) = (side(self.a, 0)?, side(self.b, 1)?);
        work.bounds = work.bounds.saturating_add(rows.count_ones() * columns.count_ones());
        Some(pairs(&first, &second, rows, columns))
    }

    /// Visits a pair of leaves. `true` to go on.
    #[inline(always)]
    fn leaves(
        &self,
        nodes: [u32; 2],
        indices: [u32; 2],
        [first, second]: [BvhChild; 2],
        visitor: &mut impl PairVisitor<[TriangleAt; 2]>,
        work: &mut Work,
    ) -> Option<bool> {
        let p = self.a.leaf_at(first.at, first.shape)?;
        let q = self.b.leaf_at(second.at, second.shape)?;
        let mut pair = LeafPair::new(&self.pose.vertices, &p, &q);
        for (i, mut bits) in pair.candidates()?.into_iter().enumerate() {
            while bits != 0 {
                let j = bits.trailing_zeros();
                bits &= bits - 1;
                let contact = pair.meet(i, j as usize, work);
                if contact != Contact::Apart {
                    let place = [
                        TriangleAt::new(nodes[0], indices[0], i),
                        TriangleAt::new(nodes[1], indices[1], j as usize),
                    ];
                    if !visitor.pair(place, contact)? {
                        return Some(false);
                    }
                }
            }
        }
        Some(true)
    }
}
