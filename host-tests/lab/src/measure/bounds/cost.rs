//! Instructions of moving a bound and of testing it.

pub mod counted;

use meshsweep_xtask::table::{Table, fixed, row};

use super::contenders::Contender;
use super::false_positives::Tally;

/// Instructions of a bound at one pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cost {
    /// To move it.
    pub update: f64,
    /// To test it.
    pub test: f64,
}

/// The table; one [`Cost`] a contender.
pub(super) fn table(contenders: &[Contender<'_>], tallies: &[Tally], costs: &[Cost]) -> Table {
    let mut table = Table::new(
        "bounds_instructions",
        "Moving a bound and testing it once, instructions",
        &[
            "bound",
            "bounded about",
            "update",
            "test",
            "both",
            "then the hull's",
            "false %",
            "volume, of the hull's",
        ],
    );
    let hull = costs.last().map_or(0.0, |cost| cost.test);
    for (index, ((contender, tally), cost)) in contenders.iter().zip(tallies).zip(costs).enumerate()
    {
        let both = cost.update + cost.test;
        // The hull, which is the last one, is not tested again.
        let again = if index + 1 == contenders.len() { 0.0 } else { tally.wrong / 100.0 * hull };
        table.push(row![
            contender.name,
            contender.about.name(),
            fixed(cost.update, 0),
            fixed(cost.test, 0),
            fixed(both, 0),
            fixed(both + again, 0),
            fixed(tally.wrong, 1),
            fixed(tally.volume, 2),
        ]);
    }
    table.note(
        "counted by callgrind; update: every vertex of the hull in turn, no search on its edges",
    );
    table.note(
        "slabs end a test at the first that parts; convex hull: parry3d's GJK, each \
        support from all vertices, nothing kept between poses",
    );
    table.note(
        "then the hull's: both, and the hull's test of the pairs that are reported; mean \
        of pairs of meshes that do not meet",
    );
    table
}
