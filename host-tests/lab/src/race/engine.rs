//! The interface of an engine.

use std::hint::black_box;

use super::workload::{HitKind, Workload};
use crate::measure::stopwatch::Stopwatch;

/// An index over one mesh that answers lists of queries. A list is one call, so that the call's
/// cost is no part of a query's, a coherent query may carry over what it knows, and a batch may be
/// sorted.
pub trait Engine {
    /// Bytes that it keeps to answer, the triangles included.
    fn bytes(&self) -> usize;

    /// Seconds of its build, for an engine in another process.
    fn own_build_seconds(&self) -> Option<f64> {
        None
    }

    /// Whether it takes part in a workload.
    fn answers(&self, workload: Workload) -> bool;

    /// Answers to `points`, in their order: [`Answer::Point`].
    ///
    /// # Errors
    /// The engine's refusal.
    fn closest(&mut self, points: &[[f32; 3]]) -> Result<Answers, String>;

    /// Answers to `segments`, in their order: [`Answer::Hit`] of first hits, [`Answer::Meets`] or
    /// [`Answer::Undecided`] of any, [`Answer::Miss`] of both.
    ///
    /// # Errors
    /// The engine's refusal.
    fn hits(&mut self, segments: &[[[f32; 3]; 2]], kind: HitKind) -> Result<Answers, String>;
}

/// What an engine says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Answer {
    /// The closest point of the surface.
    Point([f32; 3]),
    /// The parameter of the first hit, 0 at the segment's start, 1 at its end.
    Hit(f32),
    /// There is a hit.
    Meets,
    /// No hit.
    Miss,
    /// Neither is proved.
    Undecided,
}

/// Answers to a list of queries.
pub struct Answers {
    /// In the order of the queries.
    pub all: Vec<Answer>,
    /// Processor time of all.
    pub seconds: f64,
}

impl Answers {
    /// Asks one query after the other, up to the first refusal. Each answer passes through a
    /// [`black_box`], so that none is computed in part or left out.
    ///
    /// # Errors
    /// That refusal.
    pub fn each<Q: Copy, E: ToString>(
        queries: &[Q],
        mut ask: impl FnMut(Q) -> Result<Answer, E>,
    ) -> Result<Self, String> {
        let mut all = Vec::with_capacity(queries.len());
        let watch = Stopwatch::start();
        for &query in queries {
            all.push(black_box(ask(query).map_err(|error| error.to_string())?));
        }
        Ok(Self { all, seconds: watch.seconds() })
    }
}
