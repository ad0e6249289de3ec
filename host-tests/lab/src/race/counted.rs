//! The same workloads for a simulator that counts instructions.
//!
//! callgrind collects inside of `counted_queries` only, and writes its counters each time
//! `counted_workload` returns.

use std::hint::black_box;
use std::path::Path;

use meshsweep_host_tests::workload::Subject;

use super::engine::{Answer, ENTRANTS, Engine};
use super::workload::Queries;
use super::{Scale, Scope, Workload};
use crate::measure::rival::Rival;

/// The function inside of which instructions are counted; a pattern, for its full name has the
/// compiler's hash in it.
pub const COUNTED: &str = "*counted_queries*";
/// The function after which the counters are written. Another one, for callgrind does not do both
/// at the same one.
pub const WRITTEN: &str = "*counted_workload*";

/// Rows of the field that are asked, of 64: two at a time, so that there are a next node, a next
/// row and a jump.
const ROWS: usize = 2;
/// Rows from one such run to the next; odd, so that not all runs lie in the same place of their
/// layer.
const PERIOD: usize = 131;

/// Builds one engine and asks it every workload that it answers; their names and numbers of queries
/// in the order of asking.
///
/// # Errors
/// As [`race`](super::race).
pub fn ask(
    file: &Path,
    engine: &str,
    hull_triangles: usize,
) -> Result<Vec<(Workload, usize)>, String> {
    let subject = Subject::load_any(file)?;
    let scope = Scope { scale: Scale::COUNTED, hull_triangles };
    let entrant = ENTRANTS.iter().find(|entrant| entrant.name == engine);
    let entrant = entrant.ok_or_else(|| format!("no engine `{engine}`"))?;
    let mut blob = Vec::new();
    let Some(mut engine) = (entrant.build)(&subject, &scope, &mut blob)? else {
        return Ok(Vec::new());
    };
    let guide = Rival::new(&subject)?;
    let mut asked = Vec::new();
    for workload in Workload::ALL {
        if engine.limit(workload) == 0 {
            continue;
        }
        let mut queries = workload.queries(&subject, &guide, scope.scale);
        if workload == Workload::Field {
            queries = queries.runs(ROWS * scope.scale.side, PERIOD * scope.scale.side);
        }
        let mut answers = Vec::with_capacity(queries.len());
        counted_workload(engine.as_mut(), &queries, &mut answers)?;
        asked.push((workload, queries.len()));
    }
    Ok(asked)
}

#[inline(never)]
fn counted_workload(
    engine: &mut dyn Engine,
    queries: &Queries,
    answers: &mut Vec<Answer>,
) -> Result<(), String> {
    // Not a tail call, which would leave this function before the counted one.
    black_box(counted_queries(engine, queries, answers))
}

#[inline(never)]
fn counted_queries(
    engine: &mut dyn Engine,
    queries: &Queries,
    answers: &mut Vec<Answer>,
) -> Result<(), String> {
    match queries {
        Queries::Points(points) => engine.closest(points, answers),
        Queries::Segments(segments) => engine.first_hits(segments, answers),
    }
}
