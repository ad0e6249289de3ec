//! The cost of moving a bound and of testing it, beside how often it is wrong.

pub mod counted;

use meshsweep_xtask::table::{Table, fixed};

use super::contenders::Contender;
use super::false_positives::{Cases, Tally};
use super::pose::Motion;
use crate::measure::stopwatch::Stopwatch;

/// Rounds, in each of which every bound has its turn; the fastest counts: others on the machine can
/// only slow a bound down.
const ROUNDS_OF_UPDATES: usize = 5;
/// The same of tests, which take no time but are sooner disturbed.
const ROUNDS_OF_TESTS: usize = 25;

/// What a bound costs at one pose, in nanoseconds or in instructions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cost {
    /// To move it.
    pub update: f64,
    /// To test it.
    pub test: f64,
}

impl Cost {
    const MOST: Self = Self { update: f64::INFINITY, test: f64::INFINITY };

    fn both(self) -> f64 {
        self.update + self.test
    }
}

/// Nanoseconds, and verdicts that differ from the f64 ones.
fn timed(
    cases: &Cases,
    contenders: &mut [Contender<'_>],
    tallies: &[Tally],
) -> (Vec<Cost>, Vec<usize>) {
    let motions: Vec<Motion> = cases.poses.iter().map(Motion::of).collect();
    let mut costs = vec![Cost::MOST; contenders.len()];
    for _ in 0..ROUNDS_OF_UPDATES {
        for (contender, cost) in contenders.iter_mut().zip(&mut costs) {
            let begun = Stopwatch::start();
            contender.rig.update(&motions);
            cost.update = cost.update.min(begun.nanoseconds_each(motions.len()));
        }
    }
    let mut differ = vec![0; contenders.len()];
    let mut verdicts = Vec::with_capacity(motions.len());
    for _ in 0..ROUNDS_OF_TESTS {
        for (index, contender) in contenders.iter().enumerate() {
            let begun = Stopwatch::start();
            contender.rig.test(&mut verdicts);
            costs[index].test = costs[index].test.min(begun.nanoseconds_each(motions.len()));
            let pairs = verdicts.iter().zip(&tallies[index].meets);
            differ[index] = pairs.filter(|(ours, wanted)| ours != wanted).count();
        }
    }
    (costs, differ)
}

/// Columns of one unit.
const TIMES: [&str; 5] =
    ["update ns", "test ns", "both ns", "test, of the box's", "both, of the box's"];
const COUNTS: [&str; 5] = [
    "update instructions",
    "test instructions",
    "both instructions",
    "test instructions, of the box's",
    "both instructions, of the box's",
];

/// The tables: nanoseconds, and instructions if they were counted, one [`Cost`] a contender.
pub(super) fn tables(
    cases: &Cases,
    contenders: &mut [Contender<'_>],
    tallies: &[Tally],
    counts: Option<&[Cost]>,
) -> Vec<Table> {
    let (times, differ) = timed(cases, contenders, tallies);
    let mut tables = vec![Table::new(
        "bounds_time",
        "Moving a bound and testing it once, time",
        &columns(TIMES),
    )];
    fill(&mut tables[0], contenders, tallies, &times, &differ, 1);
    tables[0].note(format!(
        "f32, one thread, a pose each; fastest of {ROUNDS_OF_UPDATES} rounds of updates and {ROUNDS_OF_TESTS} of tests in which all take turns: noise, take ratios"
    ));
    if let Some(counts) = counts {
        let mut table = Table::new(
            "bounds_instructions",
            "Moving a bound and testing it once, instructions",
            &columns(COUNTS),
        );
        fill(&mut table, contenders, tallies, counts, &differ, 0);
        table.note("counted by callgrind");
        tables.push(table);
    }
    for table in &mut tables {
        table.note("of the box's: the box's about the hull's vertices; update: every vertex of the hull in turn, no search on its edges");
        table.note("slabs end a test at the first that parts; convex hull: parry3d's GJK, each support from all vertices, nothing kept between poses");
        table.note("then the hull's: both, and the hull's test of the pairs that are reported; mean of pairs of meshes that do not meet");
        table.note("differ: verdicts in f32 that are not those in f64; an oriented box's errs to meeting where axes are parallel");
    }
    tables
}

fn columns(units: [&'static str; 5]) -> Vec<&'static str> {
    let last = ["then the hull's", "false %", "volume, of the hull's", "differ"];
    ["bound", "bounded about"].into_iter().chain(units).chain(last).collect()
}

fn fill(
    table: &mut Table,
    contenders: &[Contender<'_>],
    tallies: &[Tally],
    costs: &[Cost],
    differ: &[usize],
    digits: usize,
) {
    let (Some(&reference), Some(hull)) = (costs.first(), costs.last()) else { return };
    for (((contender, tally), cost), differ) in
        contenders.iter().zip(tallies).zip(costs).zip(differ)
    {
        table.push(meshsweep_xtask::table::row![
            contender.name,
            contender.about.name(),
            fixed(cost.update, digits),
            fixed(cost.test, digits),
            fixed(cost.both(), digits),
            fixed(cost.test / reference.test, 2),
            fixed(cost.both() / reference.both(), 3),
            // Of the hull itself that is its own cost.
            if std::ptr::eq(cost, hull) {
                fixed(cost.both(), digits)
            } else {
                fixed(cost.both() + tally.wrong / 100.0 * hull.test, digits)
            },
            fixed(tally.wrong, 1),
            fixed(tally.volume(), 2),
            *differ,
        ]);
    }
}
