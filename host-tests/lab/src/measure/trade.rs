//! Speed for accuracy: what a query that stops early guarantees, and what it found.

use meshsweep::cut::cut;
use meshsweep_core::{Budget, Hull};
use meshsweep_host_tests::workload::Subject;
use meshsweep_host_tests::workload::{Points, points};
use meshsweep_xtask::table::{Cell, Table, fixed, row, scientific};

use super::closest::{Answers, LONG_QUEUE, width};
use super::open;

/// Points of each kind.
const COUNT: usize = 2_000;
const TOLERANCES: [f32; 5] = [0.0, 0.001, 0.01, 0.1, 1.0];
const STEPS: [u32; 7] = [4, 8, 16, 32, 64, 128, 256];
const KINDS: [Points; 2] = [Points::Far, Points::Near];
const MEASURED: [&str; 6] =
    ["ns", "nodes", "triangles", "guaranteed width", "mean error", "largest error"];

/// A relative tolerance against cost.
pub fn tolerances(subject: &Subject, model: &Hull<'_>) -> Result<Table, String> {
    let columns = ["points", "tolerance"].iter().chain(&MEASURED).copied().collect::<Vec<_>>();
    let mut table = Table::new("tolerance", "Closest point within a relative tolerance", &columns);
    let stops = TOLERANCES
        .map(|relative| (fixed(f64::from(relative), 3), Budget::EXACT.with_relative(relative)));
    fill(&mut table, subject, model, &stops)?;
    Ok(table)
}

/// A budget of steps against width.
pub fn steps(subject: &Subject, model: &Hull<'_>) -> Result<Table, String> {
    let columns = ["points", "steps"].iter().chain(&MEASURED).copied().collect::<Vec<_>>();
    let mut table = Table::new("steps", "Closest point after so many opened nodes", &columns);
    let stops = STEPS.map(|steps| (Cell::from(steps), Budget::EXACT.with_steps(steps)));
    fill(&mut table, subject, model, &stops)?;
    Ok(table)
}

fn fill(
    table: &mut Table,
    subject: &Subject,
    model: &Hull<'_>,
    stops: &[(Cell, Budget)],
) -> Result<(), String> {
    for kind in KINDS {
        let asked = points(subject, kind, COUNT);
        let truth = Answers::of(model, &asked, &Budget::EXACT, LONG_QUEUE)?;
        for (name, stop) in stops {
            let run = Answers::of(model, &asked, stop, LONG_QUEUE)?;
            let errors = errors(&run, &truth);
            table.push(row![
                kind.name(),
                name.clone(),
                fixed(run.nanoseconds, 0),
                fixed(run.work(|work| work.nodes), 1),
                fixed(run.work(|work| work.triangles), 1),
                scientific(run.mean(width)),
                scientific(errors.iter().sum::<f64>() / errors.len() as f64),
                scientific(errors.iter().copied().fold(0.0, f64::max)),
            ]);
        }
    }
    table.note(format!(
        "{COUNT} points of each kind, queue {LONG_QUEUE}; width: mean of (upper - lower) / upper; error: upper / exact - 1"
    ));
    Ok(())
}

/// How far each upper bound is above the exact one, relative.
fn errors(run: &Answers, truth: &Answers) -> Vec<f64> {
    let pairs =
        run.answers.iter().zip(&truth.answers).filter(|(_, exact)| exact.distance.upper > 0.0);
    pairs
        .map(|(answer, exact)| {
            f64::from(answer.distance.upper) / f64::from(exact.distance.upper) - 1.0
        })
        .collect()
}

/// Levels cut off: bytes against width.
pub fn cuts(subject: &Subject, model: &Hull<'_>) -> Result<Table, String> {
    let columns = [
        "level",
        "faces",
        "bytes",
        "% of all",
        "far ns",
        "far width",
        "far of diagonal",
        "near ns",
        "near of diagonal",
        "outside",
    ];
    let mut table = Table::new("cuts", "Blobs cut after a level, closest point", &columns);
    let diagonal = subject.diagonal();
    let asked = KINDS.map(|kind| points(subject, kind, COUNT));
    let exact = [0, 1].map(|kind| Answers::of(model, &asked[kind], &Budget::EXACT, LONG_QUEUE));
    let [exact_far, exact_near] = exact;
    let (exact_far, exact_near) = (exact_far?, exact_near?);
    // The finest level is the whole.
    let finest = model.header().levels.saturating_sub(1);
    let whole = cut(model, finest).map_err(|error| error.to_string())?.to_bytes().len();
    for (index, level) in model.levels().enumerate() {
        let bytes = cut(model, index as u32).map_err(|error| error.to_string())?.to_bytes();
        let coarse = open(&bytes)?;
        let far = Answers::of(&coarse, &asked[0], &Budget::EXACT, LONG_QUEUE)?;
        let near = Answers::of(&coarse, &asked[1], &Budget::EXACT, LONG_QUEUE)?;
        let absolute = |run: &Answers| {
            run.mean(|a| f64::from(a.distance.upper) - f64::from(a.distance.lower)) / diagonal
        };
        table.push(row![
            index,
            level.faces,
            bytes.len(),
            fixed(100.0 * bytes.len() as f64 / whole as f64, 1),
            fixed(far.nanoseconds, 0),
            scientific(far.mean(width)),
            scientific(absolute(&far)),
            fixed(near.nanoseconds, 0),
            scientific(absolute(&near)),
            disjoint(&far, &exact_far) + disjoint(&near, &exact_near),
        ]);
    }
    table.note("width: mean of (upper - lower) / upper, and of upper - lower over the diagonal; outside: intervals that miss the exact one, must be 0");
    Ok(table)
}

/// Intervals that have nothing in common with the whole blob's: one of the two would be wrong.
fn disjoint(run: &Answers, exact: &Answers) -> usize {
    let pairs = run.answers.iter().zip(&exact.answers);
    pairs
        .filter(|(coarse, fine)| {
            coarse.distance.lower > fine.distance.upper
                || coarse.distance.upper < fine.distance.lower
        })
        .count()
}
