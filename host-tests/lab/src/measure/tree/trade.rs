//! Speed for accuracy: what an early stop costs, guarantees and finds.

use meshsweep_core::{Budget, Bvh};
use meshsweep_host_tests::workload::Subject;
use meshsweep_host_tests::workload::{Points, points};
use meshsweep_xtask::table::{Cell, Table, fixed, row, scientific};

use super::{Answers, Built};
use crate::measure::stopwatch::fastest;

/// Points of each kind.
const COUNT: usize = 4_000;
const TOLERANCES: [f32; 4] = [0.0, 0.001, 0.01, 0.1];
const STEPS: [u32; 6] = [1, 2, 4, 8, 16, 32];
const KINDS: [Points; 2] = [Points::Far, Points::Near];
const MEASURED: [&str; 9] = [
    "ns",
    "x exact",
    "nodes",
    "triangles",
    "promised",
    "promised ‰",
    "found",
    "found ‰",
    "finished %",
];

/// A relative tolerance, and a budget of nodes.
///
/// # Errors
/// A query is refused.
pub fn tables(subject: &Subject, built: &Built) -> Result<[Table; 2], String> {
    let tree = built.open()?;
    let columns =
        |first: &'static str| ["points", first].into_iter().chain(MEASURED).collect::<Vec<_>>();
    let title = "Box tree, closest point within a relative tolerance";
    let mut tolerances = Table::new("tree_tolerance", title, &columns("tolerance %"));
    let stops = TOLERANCES.map(|relative| {
        (fixed(100.0 * f64::from(relative), 1), Budget::EXACT.with_relative(relative))
    });
    fill(&mut tolerances, subject, &tree, &stops)?;
    let title = "Box tree, closest point after so many opened nodes";
    let mut steps = Table::new("tree_steps", title, &columns("steps"));
    let stops = STEPS.map(|steps| (Cell::from(steps), Budget::EXACT.with_steps(steps)));
    fill(&mut steps, subject, &tree, &stops)?;
    Ok([tolerances, steps])
}

fn fill(
    table: &mut Table,
    subject: &Subject,
    tree: &Bvh<'_>,
    stops: &[(Cell, Budget)],
) -> Result<(), String> {
    let thousandth = 0.001 * subject.diagonal();
    for kind in KINDS {
        let asked = points(subject, kind, COUNT);
        let timed =
            |stop: &Budget| fastest(|| Answers::of(tree, &asked, stop), |run| run.nanoseconds);
        let exact = timed(&Budget::EXACT)?;
        let quantised =
            exact.mean(|answer| f64::from(answer.distance.upper - answer.distance.lower));
        for (name, stop) in stops {
            let run = timed(stop)?;
            let width = run
                .mean(|answer| f64::from(answer.distance.upper) - f64::from(answer.distance.lower))
                - quantised;
            let relative =
                |excess: f64, of: f32| if of > 0.0 { excess / f64::from(of) } else { 0.0 };
            let promised = run.mean(|a| {
                relative(
                    f64::from(a.distance.upper) - f64::from(a.distance.lower),
                    a.distance.upper,
                )
            });
            let pairs = || run.answers.iter().zip(&exact.answers);
            let excess = |pair: (&_, &_)| above(pair.0, pair.1);
            let found =
                pairs().map(|pair| relative(excess(pair), pair.1.distance.upper)).sum::<f64>()
                    / COUNT as f64;
            let finished = pairs()
                .filter(|(early, exact)| early.distance.upper <= exact.distance.upper)
                .count();
            table.push(row![
                kind.name(),
                name.clone(),
                fixed(run.nanoseconds, 0),
                fixed(exact.nanoseconds / run.nanoseconds, 2),
                fixed(run.mean(|answer| f64::from(answer.work.opened)), 2),
                fixed(run.mean(|answer| f64::from(answer.work.triangles)), 1),
                scientific(promised),
                fixed(width.max(0.0) / thousandth, 3),
                scientific(found),
                fixed(pairs().map(excess).sum::<f64>() / COUNT as f64 / thousandth, 3),
                fixed(100.0 * finished as f64 / COUNT as f64, 1),
            ]);
        }
    }
    table.note(format!("{COUNT} points of each kind; promised: mean of (upper - lower) / upper; found: mean of upper / exact - 1"));
    table.note("‰: thousandths of the mesh's diagonal, what the exact answer promises subtracted; finished: the exact upper bound was found");
    Ok(())
}

/// By how much an upper bound is above the exact query's.
fn above(early: &meshsweep_core::ClosestPoint, exact: &meshsweep_core::ClosestPoint) -> f64 {
    f64::from(early.distance.upper) - f64::from(exact.distance.upper)
}
