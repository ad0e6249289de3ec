//! Bytes for accuracy: what blobs that were cut after a level guarantee.

use meshsweep::cut::cut;
use meshsweep_core::{Budget, Hull};
use meshsweep_host_tests::workload::Subject;
use meshsweep_host_tests::workload::{Points, points};
use meshsweep_xtask::table::{Table, fixed, row, scientific};

use super::closest::{Answers, LONG_QUEUE, width};
use super::open;

/// Points of each kind.
const COUNT: usize = 2_000;
const KINDS: [Points; 2] = [Points::Far, Points::Near];

/// Levels cut off: bytes against width.
pub fn table(subject: &Subject, model: &Hull<'_>) -> Result<Table, String> {
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
    table.note(
        "width: mean of (upper - lower) / upper, and of upper - lower over the diagonal; \
        outside: intervals that miss the exact one, must be 0",
    );
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
