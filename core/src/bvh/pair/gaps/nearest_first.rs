//! The descent of two trees at once, nearest pair first.
//!
//! The nearest pair of children, or of boxes that meet the deepest, is followed at once. The others
//! of the two nodes wait together, as 64 bits with the least of their keys. Their keys are computed
//! again when their turn comes, so a pair of nodes that waits takes three scratch entries however
//! many children wait.

use super::leaf_gaps::{GapVisit, LeafGaps};
use super::question::PairQuestion;
use super::skipped::{ChildPairs, SkippedPairs};
use crate::bvh::pair::models::{Models, most_pairs};
use crate::bvh::pair::pair_keys::{
    NO_PAIR, PairKeys, bound_sq_of, distance_of, indices_of, key_limit, pair_bit, second_factor,
};
use crate::bvh::pair::stored_pair::StoredPair;
use crate::bvh::tree::axis_intervals::{AxisIntervals, pairs};
use crate::bvh::tree::stored_lengths::square_limit;
use crate::bvh::tree::triangle_at::TriangleAt;
use crate::num::lesser;
use crate::num::tolerance::SQUARED_SLACK;
use crate::query::{Ended, QueryError, RelativePose, ScratchEntry, Work};

/// How a search ended.
#[derive(Clone, Copy, Debug)]
pub(crate) enum PairDescent {
    /// Everything within the limit was looked at.
    Done,
    /// The question wanted no more.
    Answered,
    Truncated(Missed),
}

impl PairDescent {
    pub(crate) fn missed(self) -> Option<Missed> {
        match self {
            PairDescent::Truncated(missed) => Some(missed),
            PairDescent::Done | PairDescent::Answered => None,
        }
    }
}

/// Scratch entries of a pair of nodes that waits.
const ENTRIES: usize = 3;

/// What the search did not look at.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Missed {
    pub(crate) why: Ended,
    /// No pair that was missed is nearer than this, common units.
    pub(crate) lower: f64,
}

/// Children of two nodes that are still to be looked at.
#[derive(Clone, Copy)]
struct PendingPairs {
    /// Not above any of their keys.
    key: u32,
    pairs: ChildPairs,
}

impl PendingPairs {
    /// Keys are the bits of an f32 that is finite, and node numbers are below 2^24.
    #[inline(always)]
    fn entries(self) -> [ScratchEntry; ENTRIES] {
        let ChildPairs { nodes: [a, b], wanted } = self.pairs;
        [[self.key, wanted as u32], [a, (wanted >> 32) as u32], [b, 0]].map(ScratchEntry::of_words)
    }

    #[inline(always)]
    fn of(entries: &[ScratchEntry; ENTRIES]) -> PendingPairs {
        let [[key, low], [a, high], [b, _]] = entries.map(ScratchEntry::words);
        let wanted = u64::from(high) << 32 | u64::from(low);
        PendingPairs { key, pairs: ChildPairs { nodes: [a, b], wanted } }
    }

    #[inline(always)]
    fn skip_to(self, skipped: &mut Option<&mut SkippedPairs<'_>>) {
        if let Some(skipped) = skipped
            && self.pairs.wanted != 0
        {
            skipped.keep(self.pairs, distance_of(self.key));
        }
    }
}

/// A search in two trees.
pub(crate) struct Search<'s, 'a> {
    pub(crate) models: Models<'a>,
    pub(crate) leaves: LeafGaps<'a>,
    /// Budget: pairs of nodes, over all descents.
    pub(crate) steps: u32,
    pub(crate) scratch: &'s mut [ScratchEntry],
    pub(crate) work: Work,
}

impl<'s, 'a> Search<'s, 'a> {
    pub(crate) fn new(
        pair: &'a StoredPair<'a>,
        pose: &'a RelativePose,
        steps: u32,
        scratch: &'s mut [ScratchEntry],
    ) -> Self {
        let [a, b] = pair.trees;
        let (models, leaves) = (Models { a, b, pose }, pair.leaves());
        Search { models, leaves, steps, scratch, work: Work::NONE }
    }

    /// Visits every pair of leaves below `start` that may be within the question's limit. What the
    /// limit left out goes to `skipped`. None of `start` is nearer than `distance`, common units.
    pub(crate) fn descend(
        &mut self,
        (start, distance): (ChildPairs, f32),
        question: &mut PairQuestion<'_>,
        mut skipped: Option<&mut SkippedPairs<'_>>,
    ) -> Result<PairDescent, QueryError> {
        let Search { models, leaves, work, .. } = self;
        let steps = lesser(self.steps, work.opened.saturating_add(most_pairs(models.a, models.b)));
        let (stack, _) = self.scratch.as_chunks_mut::<ENTRIES>();
        let factor = second_factor(models.pose);
        let limit_of = |question: &PairQuestion<'_>| key_limit(square_limit(question.limit()));
        let mut used = 0usize;
        // The least key of the pairs that did not fit the stack.
        let mut dropped = NO_PAIR;
        let key = (distance * distance * SQUARED_SLACK).to_bits();
        let mut now = PendingPairs { key, pairs: start };
        loop {
            if work.opened >= steps {
                let waiting = stack.iter().take(used).map(|entries| PendingPairs::of(entries).key);
                let key = waiting.fold(now.key.min(dropped), u32::min);
                now.skip_to(&mut skipped);
                skip_all(stack, used, &mut skipped);
                return Ok(PairDescent::Truncated(Missed {
                    why: Ended::Steps,
                    lower: distance_of(key),
                }));
            }
            work.opened += 1;
            let (mut keys, deepest) =
                keys_of_children(models, &now.pairs, factor, work).ok_or(QueryError::Unchecked)?;
            let nodes = now.pairs.nodes;
            let mut preferred = deepest;
            let mut down = None;
            while down.is_none() {
                let key = preferred.take().unwrap_or_else(|| keys.least());
                if key > limit_of(question) {
                    break;
                }
                keys.drop(key);
                let indices = indices_of(key);
                let child = |which: usize, index: u32| {
                    let tree = if which == 0 { models.a } else { models.b };
                    tree.child(nodes[which & 1], index).ok_or(QueryError::Unchecked)
                };
                let children = [child(0, indices[0])?, child(1, indices[1])?];
                let [opens_a, opens_b] = models.opened(&children).ok_or(QueryError::Unchecked)?;
                if opens_a || opens_b {
                    // A child that is not opened stays a child of its parent, alone.
                    let part = |opens: bool, which: usize| {
                        if opens {
                            (children[which].at, 0xFF)
                        } else {
                            (nodes[which], 1u64 << indices[which])
                        }
                    };
                    let ((first, rows), (second, columns)) = (part(opens_a, 0), part(opens_b, 1));
                    let wanted =
                        (0..8).fold(0, |bits, i| bits | (columns * (rows >> i & 1)) << (8 * i));
                    let pairs = ChildPairs { nodes: [first, second], wanted };
                    down = Some(PendingPairs { key: bound_sq_of(key).to_bits(), pairs });
                    continue;
                }
                let [first, second] = children;
                let p = models.a.leaf_at(first.at, first.shape).ok_or(QueryError::Unchecked)?;
                let q = models.b.leaf_at(second.at, second.shape).ok_or(QueryError::Unchecked)?;
                // One by one: at `opt-level = "s"` a `map` stays a loop that checks its indices.
                let ([node_a, node_b], [index_a, index_b]) = (nodes, indices);
                let place =
                    [TriangleAt::new(node_a, index_a, 0), TriangleAt::new(node_b, index_b, 0)];
                let visit = leaves.visit([&p, &q], place, None, question, skipped.is_some(), work);
                let GapVisit { goes_on, lower, .. } = visit.ok_or(QueryError::Unchecked)?;
                if let Some(skipped) = &mut skipped {
                    skipped.keep(ChildPairs { nodes, wanted: pair_bit(key) }, lower);
                }
                if !goes_on {
                    let (wanted, _) = keys.up_to(NO_PAIR - 1);
                    PendingPairs { key: now.key, pairs: ChildPairs { nodes, wanted } }
                        .skip_to(&mut skipped);
                    skip_all(stack, used, &mut skipped);
                    return Ok(PairDescent::Answered);
                }
            }
            let limit = limit_of(question);
            let (near, key) = keys.up_to(limit);
            // With `skipped`, pairs beyond the limit wait in the same entry.
            let wanted = if skipped.is_some() { keys.up_to(NO_PAIR - 1).0 } else { near };
            let rest = PendingPairs {
                key: bound_sq_of(key).to_bits(),
                pairs: ChildPairs { nodes, wanted },
            };
            if near == 0 {
                rest.skip_to(&mut skipped);
            }
            if let Some(next) = down {
                if near != 0 {
                    match stack.get_mut(used) {
                        Some(slot) => {
                            *slot = rest.entries();
                            used += 1;
                        }
                        None => {
                            dropped = dropped.min(rest.key);
                            if let Some(skipped) = &mut skipped {
                                skipped.overflow();
                            }
                        }
                    }
                }
                now = next;
                continue;
            }
            now = loop {
                let Some(top) = used.checked_sub(1) else {
                    if dropped > limit {
                        return Ok(PairDescent::Done);
                    }
                    let lower = distance_of(dropped);
                    return Ok(PairDescent::Truncated(Missed { why: Ended::Scratch, lower }));
                };
                used = top;
                let waiting = PendingPairs::of(stack.get(top).ok_or(QueryError::Unchecked)?);
                if waiting.key <= limit {
                    break waiting;
                }
                waiting.skip_to(&mut skipped);
            };
        }
    }
}

/// Skips all pairs that wait.
#[inline(always)]
fn skip_all(
    stack: &[[ScratchEntry; ENTRIES]],
    used: usize,
    skipped: &mut Option<&mut SkippedPairs<'_>>,
) {
    stack.iter().take(used).for_each(|entries| PendingPairs::of(entries).skip_to(skipped));
}

/// Keys of the pairs that wait. Of boxes that meet, the key of the pair that overlaps most:
/// surfaces most often meet there.
#[inline(always)]
fn keys_of_children(
    models: &Models<'_>,
    now: &ChildPairs,
    factor: f32,
    work: &mut Work,
) -> Option<(PairKeys, Option<u32>)> {
    let [a, b] = now.nodes;
    let [frame_a, frame_b] = &models.pose.frames;
    let (links_a, links_b) = (models.a.links(a)?, models.b.links(b)?);
    let first = AxisIntervals::of(frame_a, models.a.boxes(a)?, links_a.count)?;
    let second = AxisIntervals::of(frame_b, models.b.boxes(b)?, links_b.count)?;
    let (rows, columns) = (links_a.mask(), links_b.mask());
    let all = (0..8).fold(0, |bits, i| bits | u64::from(columns * (rows >> i & 1)) << (8 * i));
    let wanted = now.wanted & all;
    work.bounds = work.bounds.saturating_add(wanted.count_ones());
    let keys = PairKeys::of(&first, &second, wanted, factor);
    if bound_sq_of(keys.least()) > 0.0 || wanted & wanted.wrapping_sub(1) == 0 {
        return Some((keys, None));
    }
    let [i, j] = pairs(&first, &second, rows, columns).deepest;
    let deepest = keys.0.get((8 * i + j) as usize).copied().filter(|&key| bound_sq_of(key) == 0.0);
    Some((keys, deepest))
}
