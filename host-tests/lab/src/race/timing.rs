//! Rounds in which every engine has its turn.

use meshsweep_host_tests::workload::Subject;

use super::agreement::{Agreement, Truth};
use super::engine::{Answer, Engine};
use super::entrants::{ENTRANTS, Entrant, REFERENCE};
use super::workload::{Queries, Scale, Workload};
use crate::measure::rival::Rival;
use crate::measure::stopwatch::Stopwatch;

/// Rounds, of which the fastest counts: others on the machine can only slow an engine down.
const ROUNDS: usize = 3;

/// An engine with its index built.
pub struct Lane<'a> {
    pub entrant: &'static Entrant,
    pub engine: Box<dyn Engine + 'a>,
    pub build_seconds: f64,
}

/// One engine on one workload.
#[derive(Clone, Debug)]
pub struct Lap {
    /// What was asked.
    pub workload: Workload,
    /// The engine that answered.
    pub engine: &'static str,
    /// Queries answered.
    pub queries: usize,
    /// Nanoseconds a query, the fastest round.
    pub nanoseconds: f64,
    /// How many times as fast as parry3d.
    pub speed: f64,
    /// How well the answers agree with the others'.
    pub agreement: Agreement,
}

/// Builds every index that this machine can have. `blobs` has one place for each entrant.
pub fn lanes<'a>(subject: &Subject, blobs: &'a mut [Vec<u8>]) -> Result<Vec<Lane<'a>>, String> {
    let mut lanes = Vec::new();
    let there = |(entrant, _): &(&Entrant, _)| (entrant.missing)().is_none();
    for (entrant, blob) in ENTRANTS.iter().zip(blobs).filter(there) {
        let begun = Stopwatch::start();
        let engine = (entrant.build)(subject, blob)
            .map_err(|reason| format!("{}: {reason}", entrant.name))?;
        let build_seconds = engine.own_build_seconds().unwrap_or(begun.seconds());
        lanes.push(Lane { entrant, engine, build_seconds });
    }
    Ok(lanes)
}

/// Runs and checks all workloads.
pub fn laps(subject: &Subject, scale: Scale, lanes: &mut [Lane<'_>]) -> Result<Vec<Lap>, String> {
    let guide = Rival::new(subject)?;
    let mut laps = Vec::new();
    for workload in Workload::ALL {
        let queries = workload.queries(subject, &guide, scale);
        let runs = rounds(workload, &queries, lanes)?;
        let reference = runs.iter().find(|run| run.engine == REFERENCE);
        let reference = reference.ok_or_else(|| format!("no {REFERENCE} to compare with"))?;
        let truth = Truth::new(subject, &queries, scale.checked);
        for run in &runs {
            laps.push(Lap {
                workload,
                engine: run.engine,
                queries: run.answers.len(),
                nanoseconds: run.nanoseconds,
                speed: reference.nanoseconds / run.nanoseconds,
                agreement: truth.compare(&run.answers, &reference.answers),
            });
        }
    }
    Ok(laps)
}

struct Run {
    engine: &'static str,
    answers: Vec<Answer>,
    nanoseconds: f64,
}

fn rounds(
    workload: Workload,
    queries: &Queries,
    lanes: &mut [Lane<'_>],
) -> Result<Vec<Run>, String> {
    let mut runs: Vec<(Run, &mut Lane<'_>)> = lanes
        .iter_mut()
        .filter(|lane| lane.engine.answers(workload))
        .map(|lane| {
            let answers = Vec::with_capacity(queries.len());
            (Run { engine: lane.entrant.name, answers, nanoseconds: f64::INFINITY }, lane)
        })
        .collect();
    for _ in 0..ROUNDS {
        for (run, lane) in &mut runs {
            let begun = Stopwatch::start();
            match queries {
                Queries::Points(points) => lane.engine.closest(points, &mut run.answers)?,
                Queries::Segments(segments, kind) => {
                    lane.engine.hits(segments, *kind, &mut run.answers)?
                }
            }
            let own = lane.engine.own_seconds().map(|s| s * 1e9 / queries.len() as f64);
            let nanoseconds = own.unwrap_or_else(|| begun.nanoseconds_each(queries.len()));
            run.nanoseconds = run.nanoseconds.min(nanoseconds);
            if run.answers.len() != queries.len() {
                return Err(format!("{} left queries unanswered", run.engine));
            }
        }
    }
    Ok(runs.into_iter().map(|(run, _)| run).collect())
}
