//! The box and the seeds of a search, up to the way a query is asked.

use super::climb::{Climb, Domain, Summit, climb};
use crate::distances::Distances;
use meshsweep_core::{Budget, ScratchEntry, Work};

/// The goal of a search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Goal {
    /// The most work.
    Work,
    /// The widest interval that is left.
    Width,
}

/// An answer, as far as the search wants to know it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Found {
    /// The work of the search.
    pub work: Work,
    /// Of the answer's interval, if it has one.
    pub width: Option<f32>,
    /// As predicted, on each of [`Board::ALL`](crate::trade::Board::ALL).
    pub instructions: Option<[f64; 2]>,
}

impl Found {
    /// A measure of the work: instructions of a Cortex-M4F if they can be predicted, else the sum
    /// of all counters.
    #[must_use]
    pub fn effort(&self) -> f64 {
        self.instructions.map_or(f64::from(self.work.total()), |[on_m4f, _]| on_m4f)
    }
}

/// The worst query that was found.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Worst {
    /// What was greatest.
    pub goal: Goal,
    /// The query's numbers. The last one of a ball is its radius as a share of the distance.
    pub query: Vec<f32>,
    /// Its answer.
    pub found: Found,
    /// Mean value of random queries.
    pub typical: f64,
    /// Queries asked.
    pub asked: usize,
    /// Bytes of scratch with which no query ends for lack of memory.
    pub scratch_bytes: usize,
}

impl Worst {
    /// What the search made great: work or width.
    #[must_use]
    pub fn value(&self) -> f64 {
        match self.goal {
            Goal::Work => self.found.effort(),
            Goal::Width => self.found.width.map_or(0.0, f64::from),
        }
    }

    /// How many times the mean of random queries the value is.
    #[must_use]
    pub fn times(&self) -> f64 {
        self.value() / self.typical.max(f64::MIN_POSITIVE)
    }
}

/// How a query is asked.
type Ask<'q, const N: usize> = dyn Fn(&[f32; N], &mut [ScratchEntry]) -> Option<Found> + Sync + 'q;

/// A search, up to the way a query is asked.
pub(super) struct Search<'s, 'a> {
    structure: &'s Distances<'a>,
    goal: Goal,
    climb: Climb,
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
            goal,
            climb: Climb::default().with_starts(starts),
            low: std::array::from_fn(|k| (low[k] - half(k)).max(f32::MIN)),
            high: std::array::from_fn(|k| (high[k] + half(k)).min(f32::MAX)),
        }
    }

    fn middle(&self) -> [f32; 3] {
        std::array::from_fn(|k| 0.5 * self.low[k] + 0.5 * self.high[k])
    }

    /// The box's middle, and points of the surface.
    fn seeds(&self) -> Vec<[f32; 3]> {
        let mut scratch = self.scratch();
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

    fn scratch(&self) -> Vec<ScratchEntry> {
        vec![ScratchEntry::EMPTY; self.structure.scratch_entries()]
    }

    pub fn points(
        &self,
        ask: impl Fn(&[f32; 3], &mut [ScratchEntry]) -> Option<Found> + Sync,
    ) -> Option<Worst> {
        self.search(&Domain { low: self.low, high: self.high }, &self.seeds(), &ask)
    }

    /// Points, each with a distance to ask about: up to twice that of the surface.
    pub fn balls(
        &self,
        ask: impl Fn([f32; 3], f32, &mut [ScratchEntry]) -> Option<Found> + Sync,
    ) -> Option<Worst> {
        let with = |[x, y, z]: [f32; 3], share: f32| [x, y, z, share];
        let domain = Domain { low: with(self.low, 0.0), high: with(self.high, 2.0) };
        let seeds: Vec<_> = self.seeds().into_iter().map(|point| with(point, 1.0)).collect();
        self.search(&domain, &seeds, &|&[x, y, z, share], scratch| ask([x, y, z], share, scratch))
    }

    pub fn segments(
        &self,
        ask: impl Fn([f32; 3], [f32; 3], &mut [ScratchEntry]) -> Option<Found> + Sync,
    ) -> Option<Worst> {
        let join = |[a, b, c]: [f32; 3], [d, e, f]: [f32; 3]| [a, b, c, d, e, f];
        let domain = Domain { low: join(self.low, self.low), high: join(self.high, self.high) };
        let seeds = [join(self.low, self.high), join(self.middle(), self.high)];
        self.search(&domain, &seeds, &|&[a, b, c, d, e, f], scratch| {
            ask([a, b, c], [d, e, f], scratch)
        })
    }

    fn search<const N: usize>(
        &self,
        domain: &Domain<N>,
        seeds: &[[f32; N]],
        ask: &Ask<'_, N>,
    ) -> Option<Worst> {
        let value = |found: Found| match self.goal {
            Goal::Work => Some(found.effort()),
            Goal::Width => found.width.map(f64::from),
        };
        let of = |query: &[f32; N]| value(ask(query, &mut self.scratch())?);
        let Summit { query, typical, asked, .. } = climb(domain, seeds, &self.climb, &of)?;
        Some(Worst {
            goal: self.goal,
            query: query.to_vec(),
            found: ask(&query, &mut self.scratch())?,
            typical,
            asked,
            scratch_bytes: self.structure.scratch_entries() * size_of::<ScratchEntry>(),
        })
    }
}
