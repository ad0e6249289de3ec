//! Speculative leaf search on all threads. The result equals the sequential packing.
//!
//! A leaf depends only on its seed and on the remaining triangles of the seed's window.
//! 1. `prefetch` cuts the start of the lowest queue into one chunk for each thread.
//! 2. Each thread packs its chunk on its own copy of [`Remaining`], then restores the copy. It also
//!    packs the seeds of lower degree that its leaves make.
//! 3. When a seed's turn comes, its leaf is used if the window is unchanged ([`Footprint`]).
//!    Otherwise the leaf is searched again. That happens near the ends of chunks.

use super::adjacency::Adjacency;
use super::best_leaf::LeafSearch;
use super::front::Front;
use super::remaining::Remaining;
use super::window::Footprint;
use super::{Effort, FanLeaf};
use glam::DVec3;
use rayon::prelude::*;
use rustc_hash::FxHashMap;

/// Most workers. Each has a copy of 2.5 bytes a triangle.
const MAX_WORKERS: usize = 16;

/// Least entries of a chunk. In shorter ones too many leaves are near an end.
const MIN_CHUNK: usize = 64;
/// Most entries of a chunk. Longer ones save no time, and their leaves need memory.
const MAX_CHUNK: usize = 4096;

/// Leaves found early, and the threads that find them.
pub(super) struct Speculation<'a> {
    adjacency: &'a Adjacency<'a>,
    workers: Vec<Worker<'a>>,
    found: FxHashMap<u32, Found>,
    /// The queue that was prefetched, and its `popped` count once all of it is used.
    prefetched: (usize, usize),
    /// How many leaves are out of the workers' copies already.
    synced_leaves: usize,
}

struct Found {
    leaf: FanLeaf,
    footprint: Footprint,
}

/// One thread's copy of the packing state.
struct Worker<'a> {
    adjacency: &'a Adjacency<'a>,
    remaining: Remaining,
    search: LeafSearch<'a>,
}

impl<'a> Speculation<'a> {
    /// One worker for each thread of rayon's current pool, up to [`MAX_WORKERS`]. None if there is
    /// only one thread, or if the soup is small.
    pub(super) fn new(
        adjacency: &'a Adjacency<'a>,
        positions: &'a [DVec3],
        effort: Effort,
    ) -> Self {
        let threads = rayon::current_num_threads().min(MAX_WORKERS);
        let count = adjacency.triangles().len();
        let workers = if threads > 1 && count > threads * MIN_CHUNK { threads } else { 0 };
        let worker = |_| Worker {
            adjacency,
            remaining: Remaining::new(adjacency),
            search: LeafSearch::new(adjacency, positions, effort),
        };
        Self {
            adjacency,
            workers: (0..workers).into_par_iter().map(worker).collect(),
            found: FxHashMap::default(),
            prefetched: (0, 0),
            synced_leaves: 0,
        }
    }

    /// Searches the leaves of the queue of `degree`, the lowest one, on all threads. Does nothing
    /// while prefetched seeds are left, or if the queue is short. `leaves` are all that `remaining`
    /// lacks.
    pub(super) fn prefetch(
        &mut self,
        front: &Front,
        degree: usize,
        remaining: &Remaining,
        leaves: &[FanLeaf],
    ) {
        let Self { adjacency, workers, found, prefetched, synced_leaves } = self;
        let queue = front.queue(degree);
        let count = queue.len().min(workers.len() * MAX_CHUNK);
        let is_prefetched = front.popped(prefetched.0) < prefetched.1;
        // Degree 3 means no front: the queue holds all that remains, and each leaf starts a front
        // of its own.
        if degree == 3 || is_prefetched || workers.is_empty() || count < workers.len() * MIN_CHUNK {
            return;
        }
        *prefetched = (degree, front.popped(degree) + count);
        found.clear();
        let seeds: Vec<u32> = queue.range(..count).copied().collect();
        let new = &leaves[*synced_leaves..];
        // The last workers may get none. All of them learn of the new leaves.
        let chunk = count.div_ceil(workers.len());
        let chunk_of = |worker: usize| {
            let rest = seeds.get(worker * chunk..).unwrap_or_default();
            &rest[..rest.len().min(chunk)]
        };
        let searched: Vec<Vec<(u32, Found)>> = workers
            .par_iter_mut()
            .enumerate()
            .map(|(number, worker)| {
                new.iter().flat_map(FanLeaf::triangles).for_each(|t| {
                    worker.remaining.take(adjacency, t);
                });
                worker.pack(chunk_of(number), degree)
            })
            .collect();
        debug_assert!(workers.iter().all(|worker| worker.remaining == *remaining));
        *synced_leaves = leaves.len();
        found.extend(searched.into_iter().flatten());
    }

    /// The best leaf about `seed`, if it was found early and its window is unchanged.
    pub(super) fn take_if_current(&mut self, seed: u32, remaining: &Remaining) -> Option<FanLeaf> {
        let Found { leaf, footprint } = self.found.remove(&seed)?;
        footprint.is_current(self.adjacency, remaining).then_some(leaf)
    }
}

impl Worker<'_> {
    /// The leaves of seeds, and of the seeds of lower degree that they make, with the seeds.
    /// `remaining` is restored.
    fn pack(&mut self, seeds: &[u32], degree: usize) -> Vec<(u32, Found)> {
        let mut front = Front::default();
        let mut found: Vec<(u32, Found)> = Vec::new();
        // Bounds the memory: in a strip each leaf makes one more seed of lower degree, without end.
        let max_leaves = 2 * seeds.len();
        let mut seeds = seeds.iter();
        while found.len() < max_leaves {
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
