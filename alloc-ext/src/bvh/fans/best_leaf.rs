//! The best leaf about a seed.

use glam::DVec3;

use super::adjacency::Adjacency;
use super::remaining::Remaining;
use super::score::{Spreads, contact, cut_off};
use super::window::{Run, Window};
use super::{Effort, FanLeaf, MAX_LEAF_TRIANGLES};

/// Places for masks seen, a power of two well above the number of candidates (76 on average, a few
/// hundred at most).
const SEEN: usize = 512;

/// A leaf that could be next: `first`, and a second run with a flag that tells whether its fan is
/// reversed.
#[derive(Debug, PartialEq, Eq)]
struct Candidate {
    score: i32,
    mask: u32,
    first: Run,
    second: Option<(Run, bool)>,
}

/// A [`Candidate`] as one number, for sorting: the best score is the least number.
///
/// Equal scores are ordered by fewer fans, then by the second run, then by the mask. Fewer fans
/// store fewer vertices. Smaller masks hold triangles nearer to the seed.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Ranked(u128);

// Bit offsets in [`Ranked`]. The first run is at bit 0.
const MASK: u32 = 16;
const REVERSED: u32 = MASK + 32;
const SECOND: u32 = REVERSED + 1;
const HAS_SECOND: u32 = SECOND + 16;
const SCORE: u32 = HAS_SECOND + 1;

impl Ranked {
    fn new(of: &Candidate) -> Self {
        let run = |run: Run| {
            u128::from(run.corner) << 8 | u128::from(run.len) << 1 | u128::from(run.is_backward)
        };
        // Of a single fan 0, below all others.
        let second = of.second.map_or(0, |(second, reversed)| {
            1 << HAS_SECOND | run(second) << SECOND | u128::from(reversed) << REVERSED
        });
        let score = (i64::from(i32::MAX) - i64::from(of.score)) as u128;
        Self(score << SCORE | second | u128::from(of.mask) << MASK | run(of.first))
    }

    /// The bits below the score.
    const fn tie(self) -> u128 {
        self.0 & ((1 << SCORE) - 1)
    }

    fn candidate(self) -> Candidate {
        let bits = |at: u32, count: u32| (self.0 >> at) as u64 & ((1 << count) - 1);
        let run = |at: u32| Run {
            corner: bits(at + 8, 8) as u8,
            len: bits(at + 1, 7) as u8,
            is_backward: bits(at, 1) != 0,
        };
        Candidate {
            score: (i64::from(i32::MAX) - (self.0 >> SCORE) as i64) as i32,
            mask: bits(MASK, 32) as u32,
            first: run(0),
            second: (bits(HAS_SECOND, 1) != 0).then(|| (run(SECOND), bits(REVERSED, 1) != 0)),
        }
    }
}

/// Candidates of one window. Most repeated masks are dropped. Single fans are added first, so a
/// mask keeps its one-fan form.
struct Candidates {
    list: Vec<Ranked>,
    /// Masks seen, each at the place that its hash gives; a later one replaces an earlier one.
    seen: [u32; SEEN],
}

impl Candidates {
    fn clear(&mut self) {
        self.list.clear();
        self.seen.fill(0);
    }

    fn add(&mut self, window: &Window, mask: u32, first: Run, second: Option<(Run, bool)>) {
        // Fibonacci hashing: the upper bits of the product depend on all bits of the mask.
        let place = mask.wrapping_mul(0x9E37_79B9) as usize >> (32 - SEEN.ilog2());
        if std::mem::replace(&mut self.seen[place], mask) != mask {
            let score = contact(window, mask);
            self.list.push(Ranked::new(&Candidate { score, mask, first, second }));
        }
    }

    /// Adds `run`, whose last corner is `end`, with each longest run that joins it.
    ///
    /// A fan about corner c has the ring `next_in_triangle(c)` … `previous_in_triangle(c)`.
    /// 1. `run`, then a fan whose ring starts at the last ring vertex of `run`.
    /// 2. `run`, then a reversed fan whose ring ends there.
    /// 3. A fan whose ring ends at the first ring vertex of `run`, then `run`.
    ///
    /// A reversed fan cannot come first: `FanLeaf::first` is never reversed.
    fn add_pairs(&mut self, window: &Window, run: Run, end: u8) {
        let mask = window.runs(run.corner, false).mask(run.len as usize);
        let room = MAX_LEAF_TRIANGLES - run.len as usize;
        let longest = |corner: u8, is_backward: bool| {
            let runs = window.runs(corner, is_backward);
            // The masks grow with the length: if one meets the other run, so do all longer ones.
            if room == 0 || runs.mask(1) & mask != 0 {
                return None;
            }
            let mut len = runs.longest().min(room);
            while runs.mask(len) & mask != 0 {
                len -= 1;
            }
            Some((runs.mask(len) | mask, Run { corner, len: len as u8, is_backward }))
        };
        for at in window.corners_at(window.previous_in_triangle(end)) {
            // Case 1.
            if let Some((mask, other)) = longest(window.previous_in_triangle(at), false) {
                self.add(window, mask, run, Some((other, false)));
            }
            // Case 2.
            if let Some((mask, other)) = longest(window.next_in_triangle(at), true) {
                self.add(window, mask, run, Some((other, true)));
            }
        }
        for at in window.corners_at(window.next_in_triangle(run.corner)) {
            // Case 3.
            if let Some((mask, other)) = longest(window.next_in_triangle(at), true) {
                self.add(window, mask, other, Some((run, false)));
            }
        }
    }

    /// Candidates: every run that contains the seed, alone and with each longest second run that
    /// joins it. Only the `pairs` longest runs are joined.
    fn collect(&mut self, window: &Window, pairs: usize) {
        self.clear();
        let mut runs = arrayvec::ArrayVec::<
            (Run, u8),
            { 3 * MAX_LEAF_TRIANGLES * (MAX_LEAF_TRIANGLES + 1) / 2 },
        >::new();
        for seed_corner in 0..3 {
            let mut start = seed_corner;
            for steps_back in 0..MAX_LEAF_TRIANGLES {
                let forward = window.runs(start, false);
                let mut end = start;
                for len in 1..=forward.longest() {
                    if len > 1 {
                        end = window.next_about_vertex(end).unwrap_or(end);
                    }
                    if len > steps_back {
                        let run = Run { corner: start, len: len as u8, is_backward: false };
                        runs.push((run, end));
                        self.add(window, forward.mask(len), run, None);
                    }
                }
                match window.previous_about_vertex(start) {
                    Some(previous) if previous != seed_corner => start = previous,
                    _ => break,
                }
            }
        }
        if runs.len() > pairs {
            runs.sort_unstable_by_key(|&(run, _)| (std::cmp::Reverse(run.len), run));
            runs.truncate(pairs);
        }
        for (run, end) in runs {
            self.add_pairs(window, run, end);
        }
    }
}

/// The search for the best leaf, with its reused buffers.
pub(super) struct LeafSearch<'a> {
    adjacency: &'a Adjacency<'a>,
    positions: &'a [DVec3],
    window: Window,
    candidates: Candidates,
    spreads: Spreads,
    effort: Effort,
}

impl<'a> LeafSearch<'a> {
    pub(super) fn new(
        adjacency: &'a Adjacency<'a>,
        positions: &'a [DVec3],
        effort: Effort,
    ) -> Self {
        let count = adjacency.triangles().len();
        Self {
            adjacency,
            positions,
            window: Window::new(positions.len(), count, effort.window),
            candidates: Candidates { list: Vec::new(), seen: [0; SEEN] },
            spreads: Spreads::default(),
            effort,
        }
    }

    /// The best leaf of remaining triangles that contains `seed`.
    pub(super) fn best_leaf(&mut self, remaining: &Remaining, seed: u32) -> FanLeaf {
        self.window.fill(self.adjacency, remaining, seed);
        self.candidates.collect(&self.window, self.effort.pairs);
        let best = self.best();
        let fan = |run, reversed| self.window.fan(self.adjacency, run, reversed);
        FanLeaf {
            first: fan(best.first, false),
            second: best.second.map(|(run, reversed)| fan(run, reversed)),
        }
    }

    fn best(&mut self) -> Candidate {
        let list = &mut self.candidates.list;
        let finalists = self.effort.finalists;
        if list.len() > finalists {
            list.select_nth_unstable(finalists - 1);
            list.truncate(finalists);
        }
        list.sort_unstable();
        self.spreads.clear();
        let mut best: Option<(f64, u128, Candidate)> = None;
        for ranked in list {
            let candidate = ranked.candidate();
            let tie = ranked.tie();
            // Spread and cut-off only lower a score, and rounding is monotone. So no later
            // candidate wins.
            let best_score = best.as_ref().map_or(f64::NEG_INFINITY, |best| best.0);
            if f64::from(candidate.score) < best_score {
                break;
            }
            let spread = self.spreads.spread_score(
                &self.window,
                candidate.mask,
                self.adjacency.triangles(),
                self.positions,
            );
            if f64::from(candidate.score) + spread < best_score {
                continue;
            }
            let total = f64::from(candidate.score + cut_off(&self.window, candidate.mask)) + spread;
            let is_better = best.as_ref().is_none_or(|(score, other, _)| {
                total.total_cmp(score).then(other.cmp(&tie)).is_gt()
            });
            if is_better {
                best = Some((total, tie, candidate));
            }
        }
        best.expect("the seed by itself is a candidate").2
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn candidates_rank_by_score_then_by_fans_and_come_back_whole() {
        let run = |corner, len, is_backward| Run { corner, len, is_backward };
        let sorted = [
            Candidate { score: 9, mask: !0, first: run(95, 4, false), second: None },
            Candidate {
                score: 9,
                mask: 1,
                first: run(0, 1, true),
                second: Some((run(3, 2, false), false)),
            },
            Candidate {
                score: 9,
                mask: 1,
                first: run(0, 1, true),
                second: Some((run(3, 2, false), true)),
            },
            Candidate { score: -70, mask: 0, first: run(0, 1, false), second: None },
        ];
        let ranked = sorted.each_ref().map(Ranked::new);
        assert!(ranked.is_sorted());
        for (ranked, of) in ranked.into_iter().zip(sorted) {
            assert_eq!(ranked.candidate(), of);
        }
    }
}
