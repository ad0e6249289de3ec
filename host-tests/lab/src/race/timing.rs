//! Rounds in which every engine has its turn.

use meshsweep_host_tests::workload::Subject;

use super::agreement::{Agreement, Truth};
use super::engine::Engine;
use super::entrants::{ENTRANTS, Entrant, REFERENCE};
use super::workload::{Queries, Scale, Workload};
use crate::measure::rival::Rival;
use crate::measure::stopwatch::{Stopwatch, rounds};

/// An engine with its index built.
pub struct BuiltEngine<'a> {
    pub entrant: &'static Entrant,
    pub engine: Box<dyn Engine + 'a>,
    pub build_seconds: f64,
}

/// One engine on one workload.
#[derive(Clone, Debug)]
pub struct Measurement {
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

/// Builds every index that this machine can have, and says which it cannot have and why. `blobs`
/// has one place for each entrant.
pub fn build_engines<'a>(
    subject: &Subject,
    blobs: &'a mut [Vec<u8>],
) -> (Vec<BuiltEngine<'a>>, Vec<String>) {
    let (mut built, mut missing) = (Vec::new(), Vec::new());
    for (entrant, blob) in ENTRANTS.iter().zip(blobs) {
        let begun = Stopwatch::start();
        match (entrant.build)(subject, blob) {
            Ok(engine) => {
                let build_seconds = engine.own_build_seconds().unwrap_or(begun.seconds());
                built.push(BuiltEngine { entrant, engine, build_seconds });
            }
            Err(reason) => missing.push(format!("without {}: {reason}", entrant.name)),
        }
    }
    (built, missing)
}

/// Runs and checks all workloads.
pub fn measure(
    subject: &Subject,
    scale: Scale,
    built: &mut [BuiltEngine<'_>],
) -> Result<Vec<Measurement>, String> {
    let guide = Rival::new(subject)?;
    let mut measurements = Vec::new();
    for workload in Workload::ALL {
        let queries = workload.queries(subject, &guide, scale);
        let mut built: Vec<_> =
            built.iter_mut().filter(|one| one.engine.answers(workload)).collect();
        let runs = rounds(
            &mut built,
            |one| {
                let answers = match &queries {
                    Queries::Points(points) => one.engine.closest(points),
                    Queries::Segments(segments, kind) => one.engine.hits(segments, *kind),
                }?;
                let is_whole = answers.all.len() == queries.len();
                is_whole.then_some(answers).ok_or_else(|| "queries left unanswered".to_owned())
            },
            |run| run.seconds,
        )?;
        let runs = || built.iter().map(|one| one.entrant.name).zip(&runs);
        let (_, reference) = runs()
            .find(|(name, _)| *name == REFERENCE)
            .ok_or_else(|| format!("no {REFERENCE} to compare with"))?;
        let truth = Truth::new(subject, &queries, scale.checked);
        measurements.extend(runs().map(|(engine, run)| Measurement {
            workload,
            engine,
            queries: queries.len(),
            nanoseconds: run.seconds * 1e9 / queries.len() as f64,
            speed: reference.seconds / run.seconds,
            agreement: truth.compare(&run.all, &reference.all),
        }));
    }
    Ok(measurements)
}
