//! Closest points: cost, the same by parry3d, and agreement with f64 brute force.

use meshsweep_core::{Budget, ClosestPoint, Ended, Hull, ScratchEntry, Work};
use meshsweep_host_tests::workload::Subject;
use meshsweep_host_tests::workload::{Points, points};
use meshsweep_xtask::table::{Table, fixed, row, scientific};

use super::brute::Brute;
use super::rival::Rival;
use super::stopwatch::{Stopwatch, fastest};

/// Points of each kind.
const COUNT: usize = 10_000;
/// Points of each kind that are compared with every triangle in f64.
const BRUTE: usize = 3334;
/// Room for a best-first search.
const LONG_QUEUE: usize = 4096;

/// Answers to a list of points, and the time of one.
struct Answers {
    answers: Vec<ClosestPoint>,
    nanoseconds: f64,
}

impl Answers {
    /// Asks all points.
    fn of(model: &Hull<'_>, points: &[[f32; 3]], queue: usize) -> Result<Self, String> {
        let mut queue = vec![ScratchEntry::EMPTY; queue];
        let mut answers = Vec::with_capacity(points.len());
        let begun = Stopwatch::start();
        for &point in points {
            answers.push(
                model
                    .closest_point(point, Budget::EXACT, &mut queue)
                    .map_err(|error| error.to_string())?,
            );
        }
        let nanoseconds = begun.nanoseconds_each(points.len());
        Ok(Self { answers, nanoseconds })
    }

    /// Mean of something over all answers.
    fn mean(&self, what: impl Fn(&ClosestPoint) -> f64) -> f64 {
        self.answers.iter().map(what).sum::<f64>() / self.answers.len() as f64
    }

    /// Mean of a counter.
    fn work(&self, counter: impl Fn(&Work) -> u32) -> f64 {
        self.mean(|answer| f64::from(counter(&answer.work)))
    }
}

/// Cost by workload and queue, and agreement.
pub fn tables(subject: &Subject, model: &Hull<'_>) -> Result<[Table; 2], String> {
    let columns = [
        "points",
        "queue",
        "ns",
        "parry3d ns",
        "ratio",
        "nodes",
        "triangles",
        "exact",
        "opened",
        "widest interval",
    ];
    let mut cost = Table::new("closest_point", "Closest point, exact", &columns);
    let columns = ["points", "asked", "outside the interval", "parry3d: largest relative error"];
    let mut agreement =
        Table::new("closest_agreement", "Closest point against f64 brute force", &columns);
    let rival = Rival::new(subject)?;
    let brute = Brute::new(subject);
    for kind in Points::ALL {
        let asked = points(subject, kind, COUNT);
        let by_rival = || {
            let begun = Stopwatch::start();
            let answers: Vec<[f32; 3]> = asked.iter().map(|&point| rival.closest(point)).collect();
            Ok((answers, begun.nanoseconds_each(asked.len())))
        };
        let (theirs, their_ns) = fastest(by_rival, |run| run.1)?;
        let mut last = None;
        for queue in [model.scratch_entries(), LONG_QUEUE] {
            let run = fastest(|| Answers::of(model, &asked, queue), |run| run.nanoseconds)?;
            let widest = run.answers.iter().map(width).fold(0.0, f64::max);
            cost.push(row![
                kind.name(),
                queue,
                fixed(run.nanoseconds, 0),
                fixed(their_ns, 0),
                fixed(run.nanoseconds / their_ns, 2),
                fixed(run.work(|work| work.bounds), 1),
                fixed(run.work(|work| work.triangles), 1),
                fixed(run.work(|work| work.exact), 2),
                fixed(run.work(|work| work.opened), 1),
                scientific(widest),
            ]);
            if let Some(early) = run.answers.iter().find(|answer| answer.ended != Ended::Exact) {
                return Err(format!(
                    "an exact query ended by {:?} with {queue} queue entries",
                    early.ended
                ));
            }
            last = Some(run);
        }
        let ours = last.ok_or("no queue was tried")?;
        let (mut outside, mut their_error) = (0, 0.0_f64);
        for ((&point, ours), &theirs) in asked.iter().zip(&ours.answers).zip(&theirs).take(BRUTE) {
            let truth = brute.distance(point);
            outside += usize::from(!contains(ours, truth));
            their_error = their_error.max((distance(point, theirs) / truth - 1.0).abs());
        }
        agreement.push(row![kind.name(), BRUTE, outside, scientific(their_error)]);
    }
    cost.note("ratio below 1: faster than parry3d; the first queue is the model's capacity, the second lets the search be best first");
    Ok([cost, agreement])
}

/// Width of an interval relative to its upper end.
fn width(answer: &ClosestPoint) -> f64 {
    if answer.distance.upper > 0.0 {
        f64::from(answer.distance.upper - answer.distance.lower) / f64::from(answer.distance.upper)
    } else {
        0.0
    }
}

/// Whether a distance that f64 rounding may have moved lies in the interval.
fn contains(answer: &ClosestPoint, truth: f64) -> bool {
    let slack = 1.0e-13 * (truth + answer.point.iter().map(|x| f64::from(x.abs())).sum::<f64>());
    f64::from(answer.distance.lower) <= truth + slack
        && truth <= f64::from(answer.distance.upper) + slack
}

fn distance(a: [f32; 3], b: [f32; 3]) -> f64 {
    (0..3).map(|k| (f64::from(a[k]) - f64::from(b[k])).powi(2)).sum::<f64>().sqrt()
}
