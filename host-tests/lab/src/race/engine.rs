//! The interface of an engine.

use std::hint::black_box;

use super::workload::{HitKind, Workload};

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

    /// Seconds of the last list, for an engine in another process.
    fn own_seconds(&self) -> Option<f64> {
        None
    }

    /// Whether it takes part in a workload.
    fn answers(&self, workload: Workload) -> bool;

    /// Replaces `answers` by those to `points`, in their order: [`Answer::Point`].
    ///
    /// # Errors
    /// The engine's refusal.
    fn closest(&mut self, points: &[[f32; 3]], answers: &mut Vec<Answer>) -> Result<(), String>;

    /// Replaces `answers` by those to `segments`, in their order: [`Answer::Hit`] of first hits,
    /// [`Answer::Meets`] or [`Answer::Undecided`] of any, [`Answer::Miss`] of both.
    ///
    /// # Errors
    /// The engine's refusal.
    fn hits(
        &mut self,
        segments: &[[[f32; 3]; 2]],
        kind: HitKind,
        answers: &mut Vec<Answer>,
    ) -> Result<(), String>;
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

/// Asks one query after the other. Each answer passes through a [`black_box`], so that none is
/// computed in part or left out.
pub fn each<Q: Copy>(queries: &[Q], answers: &mut Vec<Answer>, mut ask: impl FnMut(Q) -> Answer) {
    answers.clear();
    answers.extend(queries.iter().map(|&query| black_box(ask(query))));
}

/// As [`each`], up to the first refusal.
///
/// # Errors
/// That refusal.
pub fn try_each<Q: Copy>(
    queries: &[Q],
    answers: &mut Vec<Answer>,
    mut ask: impl FnMut(Q) -> Result<Answer, String>,
) -> Result<(), String> {
    answers.clear();
    for &query in queries {
        answers.push(black_box(ask(query)?));
    }
    Ok(())
}
