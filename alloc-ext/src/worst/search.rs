//! The domain and the seeds of searches for points, balls and segments.

use super::climb::{Climb, Domain};
use super::goal::{Found, Goal, Setup, Worst};
use crate::distances::Distances;
use meshsweep_core::{Budget, ScratchEntry};

/// A search for queries about one structure.
pub(super) struct Search<'s, 'a> {
    structure: &'s Distances<'a>,
    setup: Setup,
    /// The model's box, doubled.
    low: [f32; 3],
    high: [f32; 3],
}

impl<'s, 'a> Search<'s, 'a> {
    pub fn new(structure: &'s Distances<'a>, goal: Goal, starts: usize) -> Self {
        let [low, high] = structure.bounds();
        let half = |k: usize| 0.5 * high[k] - 0.5 * low[k];
        Search {
            structure,
            setup: Setup {
                goal,
                climb: Climb::default().with_starts(starts),
                entries: structure.scratch_entries(),
            },
            low: std::array::from_fn(|k| (low[k] - half(k)).max(f32::MIN)),
            high: std::array::from_fn(|k| (high[k] + half(k)).min(f32::MAX)),
        }
    }

    fn middle(&self) -> [f32; 3] {
        std::array::from_fn(|k| 0.5 * self.low[k] + 0.5 * self.high[k])
    }

    /// The box's middle, and points of the surface.
    fn seeds(&self) -> Vec<[f32; 3]> {
        let mut scratch = vec![ScratchEntry::EMPTY; self.setup.entries];
        let mut seeds = vec![self.middle()];
        for corner in 0..8 {
            let corner: [f32; 3] =
                std::array::from_fn(
                    |k| {
                        if corner >> k & 1 == 0 { self.low[k] } else { self.high[k] }
                    },
                );
            if let Ok(near) = self.structure.closest_point(corner, Budget::EXACT, &mut scratch) {
                seeds.push(near.point);
            }
        }
        seeds
    }

    pub fn points(
        &self,
        ask: impl Fn(&[f32; 3], &mut [ScratchEntry]) -> Option<Found> + Sync,
    ) -> Option<Worst> {
        self.setup.worst(&Domain { low: self.low, high: self.high }, &self.seeds(), &ask)
    }

    /// Points, each with a distance to ask about: up to twice that of the surface.
    pub fn balls(
        &self,
        ask: impl Fn([f32; 3], f32, &mut [ScratchEntry]) -> Option<Found> + Sync,
    ) -> Option<Worst> {
        let with = |[x, y, z]: [f32; 3], share: f32| [x, y, z, share];
        let domain = Domain { low: with(self.low, 0.0), high: with(self.high, 2.0) };
        let seeds: Vec<_> = self.seeds().into_iter().map(|point| with(point, 1.0)).collect();
        self.setup
            .worst(&domain, &seeds, &|&[x, y, z, share], scratch| ask([x, y, z], share, scratch))
    }

    pub fn segments(
        &self,
        ask: impl Fn([f32; 3], [f32; 3], &mut [ScratchEntry]) -> Option<Found> + Sync,
    ) -> Option<Worst> {
        let join = |[a, b, c]: [f32; 3], [d, e, f]: [f32; 3]| [a, b, c, d, e, f];
        let domain = Domain { low: join(self.low, self.low), high: join(self.high, self.high) };
        let seeds = [join(self.low, self.high), join(self.middle(), self.high)];
        self.setup.worst(&domain, &seeds, &|&[a, b, c, d, e, f], scratch| {
            ask([a, b, c], [d, e, f], scratch)
        })
    }
}
