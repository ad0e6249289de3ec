//! The descent of two trees at once, nearest pair first.
//!
//! The nearest pair of children is followed at once. The others of the two nodes wait together, as
//! 64 bits with the least of their keys. Their keys are computed again when their turn comes, so a
//! pair of nodes that waits takes three scratch entries however many children wait.

use super::axis_intervals::{AxisIntervals, pairs};
use super::descent::Models;
use super::leaf_gaps::{GapVisitor, LeafGaps};
use super::pair_keys::{
    NO_PAIR, PairKeys, bound_of, children_of, distance_of, key_limit, second_factor,
};
use crate::bvh::stored_lengths::square_limit;
use crate::query::{Ended, QueryError, ScratchEntry, Work};

/// Scratch entries of a pair of nodes that waits.
const ENTRIES: usize = 3;

/// What the search did not look at.
#[derive(Clone, Copy, Debug)]
pub(super) struct Missed {
    pub(super) why: Ended,
    /// No pair that was missed is nearer than this, common units.
    pub(super) lower: f64,
}

/// Children of two nodes that are still to be looked at.
#[derive(Clone, Copy)]
struct Waiting {
    /// Not above any of their keys.
    key: u32,
    nodes: [u32; 2],
    wanted: u64,
}

const EVERY_PAIR: u64 = u64::MAX;

impl Waiting {
    /// Keys are the bits of an f32 that is finite, and node numbers are below 2^24.
    #[inline(always)]
    fn entries(self) -> [ScratchEntry; ENTRIES] {
        let ([a, b], wanted) = (self.nodes, self.wanted);
        [[self.key, wanted as u32], [a, (wanted >> 32) as u32], [b, 0]].map(ScratchEntry::of_words)
    }

    #[inline(always)]
    fn of(entries: &[ScratchEntry; ENTRIES]) -> Waiting {
        let [[key, low], [a, high], [b, _]] = entries.map(ScratchEntry::words);
        Waiting { key, nodes: [a, b], wanted: u64::from(high) << 32 | u64::from(low) }
    }
}

/// Visits every pair of leaves that may be within the visitor's limit. Returns what it missed.
#[inline(always)]
pub(super) fn descend(
    models: &Models<'_>,
    leaves: &mut LeafGaps<'_>,
    steps: u32,
    scratch: &mut [ScratchEntry],
    visitor: &mut impl GapVisitor,
    work: &mut Work,
) -> Result<Option<Missed>, QueryError> {
    let (stack, _) = scratch.as_chunks_mut::<ENTRIES>();
    let factor = second_factor(models.pose);
    let limit_of = |visitor: &_| key_limit(square_limit(GapVisitor::limit(visitor)));
    let mut used = 0usize;
    // The least key of the pairs that did not fit the stack.
    let mut dropped = NO_PAIR;
    let mut now = Waiting { key: 0, nodes: [0; 2], wanted: EVERY_PAIR };
    loop {
        if work.splits >= steps {
            let waiting = stack.iter().take(used).map(|entries| Waiting::of(entries).key);
            let key = waiting.fold(now.key.min(dropped), u32::min);
            return Ok(Some(Missed { why: Ended::Steps, lower: distance_of(key) }));
        }
        work.splits += 1;
        let (mut keys, deepest) = keys(models, &now, factor, work).ok_or(QueryError::Unchecked)?;
        let mut preferred = deepest;
        let mut down = None;
        while down.is_none() {
            let key = preferred.take().unwrap_or_else(|| keys.least());
            if key > limit_of(visitor) {
                break;
            }
            keys.drop(key);
            let indices = children_of(key);
            let child = |which: usize, index: u32| {
                let tree = if which == 0 { models.a } else { models.b };
                tree.child(now.nodes[which & 1], index).ok_or(QueryError::Unchecked)
            };
            let children = [child(0, indices[0])?, child(1, indices[1])?];
            let [opens_a, opens_b] = models.opened(&children).ok_or(QueryError::Unchecked)?;
            if opens_a || opens_b {
                // A child that is not opened stays a child of its parent, alone.
                let part = |opens: bool, which: usize| {
                    if opens {
                        (children[which].at, 0xFF)
                    } else {
                        (now.nodes[which], 1u64 << indices[which])
                    }
                };
                let ((first, rows), (second, columns)) = (part(opens_a, 0), part(opens_b, 1));
                let wanted =
                    (0..8).fold(0, |bits, i| bits | (columns * (rows >> i & 1)) << (8 * i));
                let key = bound_of(key).to_bits();
                down = Some(Waiting { key, nodes: [first, second], wanted });
                continue;
            }
            let [first, second] = children;
            let p = models.a.leaf_at(first.at, first.shape).ok_or(QueryError::Unchecked)?;
            let q = models.b.leaf_at(second.at, second.shape).ok_or(QueryError::Unchecked)?;
            let place = [[now.nodes[0], indices[0]], [now.nodes[1], indices[1]]];
            let go_on = leaves.visit([&p, &q], place, visitor, work);
            if !go_on.ok_or(QueryError::Unchecked)? {
                return Ok(None);
            }
        }
        if let Some(next) = down {
            let (wanted, key) = keys.up_to(limit_of(visitor));
            if wanted != 0 {
                let left = Waiting { key: bound_of(key).to_bits(), nodes: now.nodes, wanted };
                match stack.get_mut(used) {
                    Some(slot) => {
                        *slot = left.entries();
                        used += 1;
                    }
                    None => dropped = dropped.min(left.key),
                }
            }
            now = next;
            continue;
        }
        let limit = limit_of(visitor);
        now = loop {
            let Some(top) = used.checked_sub(1) else {
                let is_short = dropped <= limit;
                return Ok(
                    is_short.then(|| Missed { why: Ended::Scratch, lower: distance_of(dropped) })
                );
            };
            used = top;
            let waiting = Waiting::of(stack.get(top).ok_or(QueryError::Unchecked)?);
            if waiting.key <= limit {
                break waiting;
            }
        };
    }
}

/// Keys of the pairs that wait. Of boxes that meet, the key of the pair that overlaps most:
/// surfaces most often meet there.
#[inline(always)]
fn keys(
    models: &Models<'_>,
    now: &Waiting,
    factor: f32,
    work: &mut Work,
) -> Option<(PairKeys, Option<u32>)> {
    let [a, b] = now.nodes;
    let [frame_a, frame_b] = &models.pose.frames;
    let (count_a, count_b) = (models.a.links(a)?.count, models.b.links(b)?.count);
    let first = AxisIntervals::of(frame_a, models.a.boxes(a)?, count_a)?;
    let second = AxisIntervals::of(frame_b, models.b.boxes(b)?, count_b)?;
    let below = |count: u32| u32::MAX >> (32 - count.clamp(1, 8));
    let (rows, columns) = (below(count_a), below(count_b));
    let all = (0..8).fold(0, |bits, i| bits | u64::from(columns * (rows >> i & 1)) << (8 * i));
    let wanted = now.wanted & all;
    work.nodes = work.nodes.saturating_add(wanted.count_ones());
    let keys = PairKeys::of(&first, &second, wanted, factor);
    if bound_of(keys.least()) > 0.0 || wanted & wanted.wrapping_sub(1) == 0 {
        return Some((keys, None));
    }
    let [i, j] = pairs(&first, &second, rows, columns).deepest;
    let deepest = keys.0.get((8 * i + j) as usize).copied().filter(|&key| bound_of(key) == 0.0);
    Some((keys, deepest))
}
