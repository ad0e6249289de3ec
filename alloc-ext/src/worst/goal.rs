//! What a search maximises, its result, and the call of the climb.

use super::climb::{Climb, Domain, Summit, climb};
use meshsweep_core::{ScratchEntry, Work};

/// The goal of a search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Goal {
    /// The most work.
    Work,
    /// The widest interval that is left.
    Width,
}

/// Work, width and predicted instructions of an answer.
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
    /// The query's numbers. The last one of a ball is its radius as a share of the distance. Of a
    /// pose: the translation, then the quaternion, its real part first.
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
pub(super) type Ask<'q, const N: usize> =
    dyn Fn(&[f32; N], &mut [ScratchEntry]) -> Option<Found> + Sync + 'q;

/// How to search: for what, how long, and with how much scratch.
pub(super) struct Setup {
    pub goal: Goal,
    pub climb: Climb,
    /// Entries with which no query ends for lack of memory.
    pub entries: usize,
}

impl Setup {
    /// The worst query of a domain. `None` if no query has an answer.
    pub fn worst<const N: usize>(
        &self,
        domain: &Domain<N>,
        seeds: &[[f32; N]],
        ask: &Ask<'_, N>,
    ) -> Option<Worst> {
        let value = |found: Found| match self.goal {
            Goal::Work => Some(found.effort()),
            Goal::Width => found.width.map(f64::from),
        };
        let scratch = || vec![ScratchEntry::EMPTY; self.entries];
        let of = |query: &[f32; N]| value(ask(query, &mut scratch())?);
        let Summit { query, typical, asked, .. } = climb(domain, seeds, &self.climb, &of)?;
        Some(Worst {
            goal: self.goal,
            query: query.to_vec(),
            found: ask(&query, &mut scratch())?,
            typical,
            asked,
            scratch_bytes: self.entries * size_of::<ScratchEntry>(),
        })
    }
}
