//! Verdicts at random places of the arm, a tenth of the pairs moved to their threshold.

use std::f64::consts::PI;
use std::path::Path;

use meshsweep_core::Bvh;
use meshsweep_host_tests::generate::Rng;
use meshsweep_host_tests::oracle::placed::Tree;
use meshsweep_host_tests::workload::thresholds::{Both, Pair, Tally, count};
use meshsweep_suite::ask::robot::PAIRS;
use meshsweep_xtask::table::{Table, row};
use rayon::prelude::*;

use super::arm::{self, NAMES};
use super::workload::{blob, triangles};

/// Pairs of a piece of work.
const PIECE: usize = 500;

/// Counts wrong verdicts.
///
/// # Errors
/// A file that is missing or wrong, or a wrong verdict.
pub fn table_of_verdicts(folder: &Path, pairs: usize) -> Result<Table, String> {
    let file = |name: &&str| folder.join(name).with_extension("stl");
    let blobs = NAMES.iter().map(|name| blob(&file(name))).collect::<Result<Vec<_>, _>>()?;
    let truths: Vec<Tree> = NAMES
        .iter()
        .map(|name| triangles(&file(name)).map(Tree::new))
        .collect::<Result<_, String>>()?;
    let trees = blobs
        .iter()
        .map(|blob| Bvh::open(blob).map_err(|error| error.to_string()))
        .collect::<Result<Vec<_>, _>>()?;
    let draw = |rng: &mut Rng| {
        let angles = [0.0; arm::JOINTS].map(|_: f64| (2.0 * rng.unit_f64() - 1.0) * PI);
        let placed = arm::placed(angles);
        let (a, b, distance) = PAIRS[rng.below(PAIRS.len())];
        let models = [a, b].map(|model| Both { tree: trees[model], truth: &truths[model] });
        Pair { models, poses: [a, b].map(|model| placed[model].pose()), distance }
    };
    let piece = |seed: usize| {
        count(PIECE, &mut Rng::new(seed as u64), draw).map_err(|error| error.to_string())
    };
    let pieces = (0..pairs.div_ceil(PIECE)).into_par_iter().map(piece);
    let tallies = pieces.collect::<Result<Vec<Tally>, String>>()?;
    let sum = |of: fn(&Tally) -> usize| tallies.iter().map(of).sum::<usize>();
    let wrong = [sum(|tally| tally.false_clear), sum(|tally| tally.false_near)];
    let columns = ["pairs", "asked", "decided", "false clear", "false near"];
    let mut table =
        Table::new("verdicts", "Verdicts beside the oracle, pairs of the arm", &columns);
    let moved = sum(|tally| tally.bisected);
    table.push(row![
        "random places",
        sum(|tally| tally.asked) - moved,
        sum(|tally| tally.decided[0]),
        "",
        ""
    ]);
    table.push(row!["moved to the threshold", moved, sum(|tally| tally.decided[1]), "", ""]);
    table.push(row![
        "all",
        sum(|tally| tally.asked),
        sum(|tally| tally.decided[0] + tally.decided[1]),
        wrong[0],
        wrong[1]
    ]);
    table.note("moved: the distance is the threshold up to a millionth of a metre");
    if wrong == [0, 0] { Ok(table) } else { Err(table.text()) }
}
