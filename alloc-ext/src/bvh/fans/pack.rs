//! Greedy packing of a soup into leaves.

use std::collections::VecDeque;

use glam::DVec3;

use super::adjacency::{Adjacency, NONE};
use super::score::{contact, cut_off, spread};
use super::window::{Run, Window};
use super::{FanLeaf, MAX_LEAF_TRIANGLES};

/// Candidates whose score is computed in full. More give no better result.
const FINALISTS: usize = 16;
/// Places for masks seen, a power of two well above the number of candidates (76 on average, a few
/// hundred at most).
const SEEN: usize = 512;

/// Packs a soup into leaves of the box tree. Every triangle is in exactly one leaf.
///
/// The paper's rule, with the leaf in place of the fan: the front starts at the open edges and
/// moves inwards. The next seed is the remaining triangle with the fewest remaining neighbours; of
/// equals, the oldest entry of the queue. In a window of 32 triangles about the seed, every leaf is
/// scored that contains the seed and cannot be extended: by its size, the open edges it leaves, the
/// triangles it cuts off, and its box. The best becomes the next leaf. Triangles that share no edge
/// never meet in a leaf.
///
/// The same input gives the same leaves.
///
/// Cost: linear time and memory, about 20 µs a leaf, for any valences.
///
/// # Panics
/// If a triangle names a vertex that has no position, or if there are 2³²/3 triangles or more.
pub(in crate::bvh) fn pack(triangles: &[[u32; 3]], positions: &[DVec3]) -> Vec<FanLeaf> {
    let adjacency = Adjacency::new(positions.len(), triangles);
    let mut packing = Packing {
        adjacency: &adjacency,
        positions,
        taken: vec![false; triangles.len()],
        window: Window::new(positions.len(), triangles.len()),
        candidates: Candidates { list: Vec::new(), seen: [0; SEEN] },
    };
    let mut front = Front::default();
    for triangle in 0..triangles.len() as u32 {
        front.push(triangle, packing.degree(triangle));
    }
    let mut leaves = Vec::with_capacity(triangles.len() / MAX_LEAF_TRIANGLES);
    while let Some(seed) = front.pop(&packing) {
        let leaf = packing.take_best(seed);
        for half_edge in leaf.triangles().flat_map(|t| 3 * t..3 * t + 3) {
            let across = adjacency.across(half_edge);
            if across != NONE && !packing.taken[across as usize / 3] {
                front.push(across / 3, packing.degree(across / 3));
            }
        }
        leaves.push(leaf);
    }
    leaves
}

/// Remaining triangles by their number of remaining neighbours, oldest first. An entry is stale if
/// the number has changed.
#[derive(Default)]
struct Front([VecDeque<u32>; 4]);

impl Front {
    fn push(&mut self, triangle: u32, degree: usize) {
        self.0[degree].push_back(triangle);
    }

    fn pop(&mut self, packing: &Packing) -> Option<u32> {
        for (degree, queue) in self.0.iter_mut().enumerate() {
            while let Some(triangle) = queue.pop_front() {
                if !packing.taken[triangle as usize] && packing.degree(triangle) == degree {
                    return Some(triangle);
                }
            }
        }
        None
    }
}

/// A leaf that could be next; the flag tells whether its second fan is reversed.
#[derive(Clone, Copy)]
struct Candidate {
    score: i32,
    mask: u32,
    first: Run,
    second: Option<(Run, bool)>,
}

impl Candidate {
    /// Decides between equal scores: fewer fans, hence fewer stored vertices, then the triangles
    /// nearest to the seed.
    fn tie(&self) -> (Option<(Run, bool)>, u32, Run) {
        (self.second, self.mask, self.first)
    }
}

/// Each set of triangles counts once, as one fan if possible.
struct Candidates {
    list: Vec<Candidate>,
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
            self.list.push(Candidate { score: contact(window, mask), mask, first, second });
        }
    }

    /// The longest runs that can be joined to `run`, whose last corner is `end`.
    fn add_pairs(&mut self, window: &Window, run: Run, end: u8) {
        let mask = window.runs(run.corner, false)[run.len as usize];
        let room = MAX_LEAF_TRIANGLES - run.len as usize;
        let longest = |corner: u8, behind: bool| {
            let masks = window.runs(corner, behind);
            // The masks grow with the length, so the search ends where the run does or where it
            // meets the other.
            let len =
                (1..=room).take_while(|&len| masks[len] != 0 && masks[len] & mask == 0).last()?;
            Some((masks[len] | mask, Run { corner, len: len as u8, behind }))
        };
        for at in window.corners_at(window.before(end)) {
            if let Some((mask, other)) = longest(window.before(at), false) {
                self.add(window, mask, run, Some((other, false)));
            }
            if let Some((mask, other)) = longest(window.after(at), true) {
                self.add(window, mask, run, Some((other, true)));
            }
        }
        for at in window.corners_at(window.after(run.corner)) {
            if let Some((mask, other)) = longest(window.after(at), true) {
                self.add(window, mask, other, Some((run, false)));
            }
        }
    }
}

struct Packing<'a> {
    adjacency: &'a Adjacency<'a>,
    positions: &'a [DVec3],
    taken: Vec<bool>,
    window: Window,
    candidates: Candidates,
}

impl Packing<'_> {
    fn degree(&self, triangle: u32) -> usize {
        (3 * triangle..3 * triangle + 3)
            .map(|half_edge| self.adjacency.across(half_edge))
            .filter(|&across| across != NONE && !self.taken[across as usize / 3])
            .count()
    }

    fn take_best(&mut self, seed: u32) -> FanLeaf {
        self.window.fill(self.adjacency, &self.taken, seed);
        self.collect();
        let best = self.best();
        let fan = |run, reversed| self.window.fan(self.adjacency, run, reversed);
        let leaf = FanLeaf {
            first: fan(best.first, false),
            second: best.second.map(|(run, reversed)| fan(run, reversed)),
        };
        leaf.triangles().for_each(|t| self.taken[t as usize] = true);
        leaf
    }

    /// All leaves of the window that contain the seed, as far as they cannot be extended.
    fn collect(&mut self) {
        let Self { window, candidates, .. } = self;
        candidates.clear();
        let mut runs = arrayvec::ArrayVec::<
            (Run, u8),
            { 3 * MAX_LEAF_TRIANGLES * (MAX_LEAF_TRIANGLES + 1) / 2 },
        >::new();
        for seed_corner in 0..3 {
            let mut start = seed_corner;
            for before in 0..MAX_LEAF_TRIANGLES {
                let masks = window.runs(start, false);
                let mut end = start;
                for len in (1..=MAX_LEAF_TRIANGLES).take_while(|&len| masks[len] != 0) {
                    if len > 1 {
                        end = window.next(end).unwrap_or(end);
                    }
                    if len > before {
                        let run = Run { corner: start, len: len as u8, behind: false };
                        runs.push((run, end));
                        candidates.add(window, masks[len], run, None);
                    }
                }
                match window.previous(start) {
                    Some(previous) if previous != seed_corner => start = previous,
                    _ => break,
                }
            }
        }
        for (run, end) in runs {
            candidates.add_pairs(window, run, end);
        }
    }

    fn best(&mut self) -> Candidate {
        let list = &mut self.candidates.list;
        if list.len() > FINALISTS {
            list.select_nth_unstable_by_key(FINALISTS - 1, |candidate| {
                (-candidate.score, candidate.tie())
            });
            list.truncate(FINALISTS);
        }
        let total = |candidate: &Candidate| {
            f64::from(candidate.score + cut_off(&self.window, candidate.mask))
                + spread(&self.window, candidate.mask, self.adjacency.triangles(), self.positions)
        };
        let (_, best) = list
            .iter()
            .map(|candidate| (total(candidate), *candidate))
            .max_by(|(score, a), (other, b)| {
                score.total_cmp(other).then_with(|| b.tie().cmp(&a.tie()))
            })
            .expect("the seed by itself is a candidate");
        best
    }
}
