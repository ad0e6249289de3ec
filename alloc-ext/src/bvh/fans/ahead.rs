//! Leaves that are searched side by side, before their seeds' turn comes.
//!
//! A leaf depends on its seed and on the triangles that remain in the window about it. Each thread
//! takes a stretch of the front's lowest queue and packs on from there, as if no other thread did:
//! it searches the leaf of each seed, takes it in a view of its own, and follows up the seeds of
//! fewer neighbours that this makes, as the packing will. When a seed's turn comes, its leaf is
//! used if the same triangles remain in its window as in the view. Then it is the leaf that a new
//! search would find. So the result is the same with any number of threads. Near the ends of the
//! stretches some leaves are searched twice.

use super::FanLeaf;
use super::adjacency::Adjacency;
use super::best_leaf::LeafSearch;
use super::front::Front;
use super::remaining::Remaining;
use super::window::Footprint;
use glam::DVec3;
use rayon::prelude::*;
use rustc_hash::FxHashMap;

/// Least entries of a stretch. In shorter ones too many leaves are near an end.
const LEAST: usize = 64;
/// Most entries of a stretch. Longer ones save no time, and their leaves need memory.
const MOST: usize = 4096;

/// The leaves found ahead, and the threads' views.
pub(super) struct Ahead<'a> {
    adjacency: &'a Adjacency<'a>,
    views: Vec<View<'a>>,
    found: FxHashMap<u32, Found>,
    /// The degree of the seeds looked at, and how many entries will have left its queue when they
    /// have.
    looked_at: (usize, usize),
    /// Leaves that the views know of.
    known: usize,
}

struct Found {
    leaf: FanLeaf,
    footprint: Footprint,
}

/// What one thread takes to remain.
struct View<'a> {
    adjacency: &'a Adjacency<'a>,
    remaining: Remaining,
    search: LeafSearch<'a>,
}

impl<'a> Ahead<'a> {
    /// Looks ahead in all threads of rayon's current pool; never if there is only one.
    pub(super) fn new(adjacency: &'a Adjacency<'a>, positions: &'a [DVec3]) -> Self {
        let threads = rayon::current_num_threads();
        let count = adjacency.triangles().len();
        let views = if threads > 1 && count > threads * LEAST { threads } else { 0 };
        let view = |_| View {
            adjacency,
            remaining: Remaining::new(adjacency),
            search: LeafSearch::new(adjacency, positions),
        };
        Self {
            adjacency,
            views: (0..views).into_par_iter().map(view).collect(),
            found: FxHashMap::default(),
            looked_at: (0, 0),
            known: 0,
        }
    }

    /// Looks ahead in the queue of `degree`, the lowest one, if enough of it has not been looked at
    /// yet. `leaves` are all that `remaining` lacks.
    pub(super) fn look(
        &mut self,
        front: &Front,
        degree: usize,
        remaining: &Remaining,
        leaves: &[FanLeaf],
    ) {
        let Self { adjacency, views, found, looked_at, known } = self;
        let queue = front.queue(degree);
        let count = queue.len().min(views.len() * MOST);
        let is_looked_at = front.popped(looked_at.0) < looked_at.1;
        // With three neighbours a seed starts a front of its own, and the queue holds all that
        // remains.
        if degree == 3 || is_looked_at || views.is_empty() || count < views.len() * LEAST {
            return;
        }
        *looked_at = (degree, front.popped(degree) + count);
        found.clear();
        let seeds: Vec<u32> = queue.range(..count).copied().collect();
        let new = &leaves[*known..];
        let stretches = seeds.par_chunks(count.div_ceil(views.len()));
        let searched: Vec<Vec<(u32, Found)>> = views
            .par_iter_mut()
            .zip_eq(stretches)
            .map(|(view, seeds)| {
                new.iter().flat_map(FanLeaf::triangles).for_each(|t| {
                    view.remaining.take(adjacency, t);
                });
                view.pack(seeds, degree)
            })
            .collect();
        debug_assert!(views.iter().all(|view| view.remaining == *remaining));
        *known = leaves.len();
        found.extend(searched.into_iter().flatten());
    }

    /// The best leaf about `seed`, if it was found ahead.
    pub(super) fn leaf(&mut self, seed: u32, remaining: &Remaining) -> Option<FanLeaf> {
        let Found { leaf, footprint } = self.found.remove(&seed)?;
        footprint.is_of(self.adjacency, remaining).then_some(leaf)
    }
}

impl View<'_> {
    /// The leaves of seeds, and of the lower seeds that they make, with the seeds. What remains is
    /// as before.
    fn pack(&mut self, seeds: &[u32], degree: usize) -> Vec<(u32, Found)> {
        let mut front = Front::default();
        let mut found: Vec<(u32, Found)> = Vec::new();
        // A seed in a strip makes a lower one in each step.
        let most = 2 * seeds.len();
        let mut seeds = seeds.iter();
        while found.len() < most {
            let lower = front.lowest(&self.remaining).filter(|&lowest| lowest < degree);
            let seed = match lower {
                Some(_) => front.pop(&self.remaining),
                None => seeds
                    .find(|&&t| self.remaining.has(t) && self.remaining.degree(t) == degree)
                    .copied(),
            };
            let Some(seed) = seed else { break };
            let leaf = self.search.best_leaf(&self.remaining, seed);
            front.take(&leaf, self.adjacency, &mut self.remaining);
            found.push((seed, Found { leaf, footprint: self.search.footprint() }));
        }
        let taken = found.iter().flat_map(|(_, found)| found.leaf.triangles());
        taken.for_each(|t| self.remaining.give_back(self.adjacency, t));
        found
    }
}
