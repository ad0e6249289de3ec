//! `cargo xtask fit`: costs that predict instructions of a board from the work of a query.
//!
//! ```text
//! host fit (questions, features) ─ ask on a board in QEMU ─ least squares ─ costs.rs
//! ```
//! The host writes questions of meshes to fit to, and of meshes to test on. The emulator counts the
//! instructions of each query. A linear model is fitted for each board and search, with costs that
//! are at least 0. Then the mean of each question is predicted and compared.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use crate::boards::{BOARDS, Board};
use crate::host;
use crate::process;
use crate::qemu::Machine;
use crate::reading::Reading;
use crate::steps::Steps;
use crate::table::{Cell, Table, fixed};
use crate::tools::Tools;
use crate::workspace;

/// Features of a query.
const FEATURES: usize = 8;

/// Largest median of the errors of means on meshes of the repository that the fit has not seen, of
/// a board with floats. More fails.
const LIMIT: f64 = 0.1;

/// The same of searches whose work is not all counted. Of two models, looks at pairs of leaves are
/// not counted apart from those of triangles. Of curves, a kept search whose point jumps orders its
/// queue anew.
const LIMIT_OF_LESS_COUNTED: f64 = 0.15;

/// A question with the counts of its queries.
struct Counted {
    search: String,
    role: String,
    mesh: String,
    dials: String,
    rows: Vec<[f64; FEATURES]>,
    instructions: Vec<f64>,
}

impl Counted {
    fn mean(&self) -> f64 {
        self.instructions.iter().sum::<f64>() / self.instructions.len() as f64
    }

    /// How many times its costliest prediction the costliest query took.
    fn missed_by(&self, costs: &[f64; FEATURES]) -> f64 {
        let predicted = self.rows.iter().map(|row| dot(row, costs)).fold(0.0, f64::max);
        self.instructions.iter().copied().fold(0.0, f64::max) / predicted
    }

    /// The predicted mean.
    fn predicted(&self, costs: &[f64; FEATURES]) -> f64 {
        self.rows.iter().map(|row| dot(row, costs)).sum::<f64>() / self.rows.len() as f64
    }

    /// By how much the prediction is above the mean, relative.
    fn error(&self, costs: &[f64; FEATURES]) -> f64 {
        self.predicted(costs) / self.mean() - 1.0
    }
}

/// The boards whose costs are fitted, by their names in the library. A Cortex-M3 runs the code of a
/// Cortex-M0, and its board has memory for blobs of any size.
pub fn boards() -> [(&'static str, Board); 2] {
    let [m4f, m0, ..] = BOARDS;
    let machine = Machine::Arm("mps2-an385");
    [("CortexM4F", m4f), ("CortexM0", Board { machine, instructions_per_tick: 40.0, ..m0 })]
}

/// Counts the questions of the fit, then fits. `others` are mesh files to test on; their errors are
/// printed and not written.
pub fn run(steps: &mut Steps, tools: &Tools, others: &[&str]) {
    let listed = steps.run("questions of the fit", || {
        let path = folder();
        let listed = host::run(&[&["fit", &path.to_string_lossy()], others].concat())?;
        let failed = |error| format!("{}: {error}", path.display());
        fs::write(path.join(LISTED), &listed).map_err(failed)?;
        Ok(listed)
    });
    let Some(listed) = listed else { return };
    for (_, board) in boards() {
        let counted = steps.run(board.cpu, || {
            let image = tools.image(&board, "ask")?;
            let numbers: Vec<usize> = (0..listed.lines().count()).collect();
            let all = process::parallel(&numbers, |number| count(tools, &board, &image, *number));
            all.into_iter().try_for_each(|(counted, _)| counted)
        });
        if counted.is_none() {
            return;
        }
    }
    fit_kept(steps);
}

/// Fits all costs to the counts of the last run, prints their errors, and writes the file of the
/// library.
pub fn fit_kept(steps: &mut Steps) {
    let mut file = head();
    for (name, board) in boards() {
        let counted = steps.run(&format!("{}: counts", board.cpu), || {
            let listed = read(LISTED)?;
            let lines = listed.lines().enumerate();
            lines.map(|(number, line)| counted(&board, number, line)).collect::<Result<Vec<_>, _>>()
        });
        let Some(counted) = counted else { return };
        let (lines, beyond) = fitted(name, &board, &counted);
        steps.run(&format!("{}: errors", board.cpu), || {
            if beyond.is_empty() { Ok(()) } else { Err(beyond.join("\n")) }
        });
        file.push_str(&lines);
    }
    file.push_str("];\n");
    steps.run("alloc-ext/src/trade/costs.rs", || {
        let path = workspace::root().join("alloc-ext/src/trade/costs.rs");
        fs::write(&path, file).map_err(|error| format!("{}: {error}", path.display()))
    });
}

/// The file that lists the questions.
const LISTED: &str = "questions.txt";

/// Where questions and counts are kept.
fn folder() -> PathBuf {
    workspace::target().join("fit")
}

fn read(name: &str) -> Result<String, String> {
    let path = folder().join(name);
    fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))
}

/// Counts a question on a board, and keeps the counts: a line a query.
fn count(tools: &Tools, board: &Board, image: &Path, number: usize) -> Result<(), String> {
    let expected = Reading::parse(&read(&format!("{number}.expected"))?, None)?;
    let question = folder().join(format!("{number}.bin"));
    let reading = tools.asked(board, image, (&question, board.loaded), &expected, u32::MAX)?;
    let all: String = reading.each.iter().map(|count| format!("{count}\n")).collect();
    let kept = folder().join(format!("{number}.{}", board.cpu));
    fs::write(&kept, all).map_err(|error| format!("{}: {error}", kept.display()))
}

/// A question with the counts that were kept.
fn counted(board: &Board, number: usize, line: &str) -> Result<Counted, String> {
    let [search, role, mesh, dials] = *line.split('\t').collect::<Vec<_>>() else {
        return Err(format!("{LISTED}: `{line}`"));
    };
    let numbers = |row: &str| {
        let all: Vec<f64> = row.split(' ').filter_map(|word| word.parse().ok()).collect();
        <[f64; FEATURES]>::try_from(all).map_err(|_| format!("{number}.rows: `{row}`"))
    };
    let rows = read(&format!("{number}.rows"))?;
    let rows = rows.lines().map(numbers).collect::<Result<Vec<_>, _>>()?;
    let counts = read(&format!("{number}.{}", board.cpu))?;
    let counts = counts.lines().filter_map(|line| line.parse::<f64>().ok());
    let instructions: Vec<f64> = counts.collect();
    if rows.len() != instructions.len() || rows.is_empty() {
        return Err(format!("{line}: {} queries, not {}", instructions.len(), rows.len()));
    }
    let [search, role, mesh, dials] = [search, role, mesh, dials].map(str::to_owned);
    Ok(Counted { search, role, mesh, dials, rows, instructions })
}

/// Prints the errors of a board. Returns its lines of the file, and searches beyond the limit.
fn fitted(name: &str, board: &Board, counted: &[Counted]) -> (String, Vec<String>) {
    let mut searches: Vec<&str> = Vec::new();
    for one in counted {
        if !searches.contains(&one.search.as_str()) {
            searches.push(&one.search);
        }
    }
    let columns =
        ["search", "mesh", "question", "instructions", "predicted", "error %", "query, error %"];
    let mut table = Table::new("fit", format!("Unseen meshes, {}", board.cpu), &columns);
    let columns = [
        "search",
        "query",
        "inside",
        "node",
        "triangle",
        "exact",
        "split",
        "leaf",
        "tolerant",
        "fitted, error %",
        "unseen, error %",
        "median",
        "others, error %",
    ];
    let mut costs_table = Table::new("costs", format!("Costs, {}", board.cpu), &columns);
    let (mut lines, mut beyond) = (String::new(), Vec::new());
    for search in searches {
        let of_search = || counted.iter().filter(|one| one.search == search);
        let fit: Vec<&Counted> = of_search().filter(|one| one.role == "fit").collect();
        let costs = least_squares(&fit);
        let most = |all: &mut dyn Iterator<Item = &Counted>| {
            all.map(|one| one.error(&costs).abs()).fold(0.0, f64::max)
        };
        let unseen = most(&mut of_search().filter(|one| one.role == "test"));
        // A comb of needles has an error of its own.
        let plain = || of_search().filter(|one| one.role != "needles");
        let error = most(&mut plain());
        let missed_by = plain().map(|one| one.missed_by(&costs)).fold(1.0, f64::max);
        let least = of_search().flat_map(|one| &one.instructions).copied();
        let least = least.fold(f64::INFINITY, f64::min);
        let mut typical: Vec<f64> = of_search()
            .filter(|one| one.role == "test")
            .map(|one| one.error(&costs).abs())
            .collect();
        typical.sort_by(f64::total_cmp);
        let typical = typical.get(typical.len() / 2).copied().unwrap_or(f64::INFINITY);
        for one in of_search().filter(|one| one.role != "fit") {
            // Half of the queries are predicted as well as this.
            let pairs = one.rows.iter().zip(&one.instructions);
            let mut each: Vec<f64> =
                pairs.map(|(row, count)| (dot(row, &costs) / count - 1.0).abs()).collect();
            each.sort_by(f64::total_cmp);
            table.push(vec![
                Cell::from(search),
                Cell::from(one.mesh.as_str()),
                Cell::from(one.dials.as_str()),
                fixed(one.mean(), 0),
                fixed(one.predicted(&costs), 0),
                fixed(100.0 * one.error(&costs), 1),
                fixed(100.0 * each[each.len() / 2], 1),
            ]);
        }
        let cells = costs.map(|cost| fixed(cost, 1));
        let fitted = most(&mut fit.iter().copied());
        let errors =
            [fitted, unseen, typical, most(&mut of_search().filter(|one| one.role == "other"))];
        let errors = errors.map(|error| fixed(100.0 * error, 1));
        let row = [Cell::from(search)].into_iter().chain(cells);
        costs_table.push(row.chain(errors).collect());
        let is_less_counted = ["PairOfTrees", "KeptCurve"].contains(&search);
        let limit = if is_less_counted { LIMIT_OF_LESS_COUNTED } else { LIMIT };
        if board.has_floats && typical > limit {
            beyond.push(format!("{search}: {:.1} % on meshes it has not seen", 100.0 * typical));
        }
        let told: Vec<String> = costs.iter().map(|cost| format!("{cost:.1}")).collect();
        let _ = write!(
            lines,
            "    (\n        Board::{name},\n        Search::{search},\n        Cost {{\n            \
             instructions: [{}],\n            least: {least:.1},\n            missed_by: \
             {:.3},\n            error: {:.4},\n            typical: {:.3},\n        }},\n    ),\n",
            told.join(", "),
            (1000.0 * missed_by).ceil() / 1000.0,
            (10_000.0 * error).ceil() / 10_000.0,
            (1000.0 * typical).ceil() / 1000.0
        );
    }
    table.note("query: half of the queries are predicted as well, or better");
    costs_table.note("instructions for one of each; errors: the largest of a question's mean");
    say!("{}{}", table.text(), costs_table.text());
    (lines, beyond)
}

fn head() -> String {
    "//! Fitted costs. `cargo xtask fit` writes this file, from instructions that QEMU counts. The\n\
     //! costs are in the order of `FEATURES`. They are fitted to `bracket.stl`, `groove.obj` and\n\
     //! `torus.ply` of `fixtures` and to five meshes that `host-tests/src/counted/fit.rs`\n\
     //! generates, and to the curves of `fit_curves.rs`. These files also name the meshes and curves\n\
     //! that `error` and `typical` are of.\n\n\
     use super::cost::{Board, Cost, Search};\n\n\
     /// Costs by board and search.\n\
     pub(super) const COSTS: &[(Board, Search, Cost)] = &[\n"
        .to_owned()
}

/// Costs that are at least 0, and make the least sum of squared errors. Errors are relative to the
/// mean of their question.
///
/// Every set of features is tried: of those whose unconstrained optimum has no negative cost, the
/// best is the optimum of all.
fn least_squares(counted: &[&Counted]) -> [f64; FEATURES] {
    let (mut normal, mut right, mut square) = ([[0.0; FEATURES]; FEATURES], [0.0; FEATURES], 0.0);
    for one in counted {
        let weight = 1.0 / (one.mean() * one.mean());
        for (row, count) in one.rows.iter().zip(&one.instructions) {
            for i in 0..FEATURES {
                for j in 0..FEATURES {
                    normal[i][j] += weight * row[i] * row[j];
                }
                right[i] += weight * row[i] * count;
            }
            square += weight * count * count;
        }
    }
    let mut best = (f64::INFINITY, [0.0; FEATURES]);
    for set in 1u32..1 << FEATURES {
        let used: Vec<usize> = (0..FEATURES).filter(|i| set >> i & 1 == 1).collect();
        let Some(costs) = solved(&normal, &right, &used) else { continue };
        let explained = dot(&costs, &right);
        if costs.iter().all(|&cost| cost >= 0.0) && square - explained < best.0 {
            best = (square - explained, costs);
        }
    }
    best.1
}

/// The optimum with these features alone, by Gauss' elimination; `None` if they depend on each
/// other.
fn solved(
    normal: &[[f64; FEATURES]; FEATURES],
    right: &[f64; FEATURES],
    used: &[usize],
) -> Option<[f64; FEATURES]> {
    let n = used.len();
    let mut rows: Vec<Vec<f64>> = used
        .iter()
        .map(|&i| used.iter().map(|&j| normal[i][j]).chain([right[i]]).collect())
        .collect();
    for k in 0..n {
        let pivot = (k..n).max_by(|&a, &b| rows[a][k].abs().total_cmp(&rows[b][k].abs()))?;
        rows.swap(k, pivot);
        let of = used[k];
        if rows[k][k].abs() <= 1e-9 * normal[of][of].abs() {
            return None;
        }
        let upper = rows[k].clone();
        for row in &mut rows[k + 1..] {
            let factor = row[k] / upper[k];
            row.iter_mut().zip(&upper).for_each(|(x, y)| *x -= factor * y);
        }
    }
    let mut costs = [0.0; FEATURES];
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|j| rows[k][j] * costs[used[j]]).sum();
        costs[used[k]] = (rows[k][n] - known) / rows[k][k];
    }
    Some(costs)
}

fn dot(a: &[f64; FEATURES], b: &[f64; FEATURES]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::{Counted, least_squares};

    fn counted(instructions: impl Fn(&[f64; 8]) -> f64) -> Counted {
        let row = |i: u32| {
            let [a, b, c] = [i % 7, i * i % 11, i % 3].map(f64::from);
            [1.0, 0.0, a, b, 0.0, c, 0.0, 0.0]
        };
        let rows: Vec<[f64; 8]> = (0..60).map(row).collect();
        let instructions = rows.iter().map(instructions).collect();
        let text = String::new;
        let (search, mesh, dials) = (text(), text(), text());
        Counted { search, role: text(), mesh, dials, rows, instructions }
    }

    #[test]
    fn costs_that_are_there_are_found() {
        let one = counted(|row| 100.0 + 7.0 * row[2] + 3.0 * row[3] + 0.5 * row[5]);
        let costs = least_squares(&[&one]);
        for (cost, wanted) in costs.iter().zip([100.0, 0.0, 7.0, 3.0, 0.0, 0.5, 0.0, 0.0]) {
            assert!((cost - wanted).abs() < 1e-6, "{costs:?}");
        }
        assert!(one.error(&costs).abs() < 1e-9);
    }

    #[test]
    fn no_cost_is_negative() {
        let one = counted(|row| 100.0 + 7.0 * row[2] - 3.0 * row[5]);
        let costs = least_squares(&[&one]);
        assert!(costs.iter().all(|&cost| cost >= 0.0) && costs[5] == 0.0, "{costs:?}");
    }
}
