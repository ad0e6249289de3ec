//! `cargo xtask measure`: the tables of `measure`, printed.

use std::path::PathBuf;

use meshsweep_lab::measure::paper;
use meshsweep_lab::measure::{
    field, margins, measure, measure_deform, measure_field, measure_overlap, measure_tight,
    measure_tree, measure_triboxes,
};
use meshsweep_xtask::say;
use meshsweep_xtask::steps::Steps;
use meshsweep_xtask::tools;
use meshsweep_xtask::workspace;

use crate::{fans_on_board, hulls_on_board};

/// What to measure.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Options {
    meshes: Vec<PathBuf>,
    part: Option<Part>,
    /// Trials of each margin, of no mesh.
    margins: Option<usize>,
    /// Points that each field is asked about.
    queries: Option<usize>,
    /// Tight hulls or fans on a board.
    is_on_board: bool,
}

/// What of a mesh, if not hull hierarchy and box tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Part {
    Tree,
    Overlap,
    Triboxes,
    Tight,
    Deform,
    Field,
    /// A table of [`paper::ALL`].
    Paper(usize),
}

impl Options {
    /// `[--tree | --triboxes | --deform | --overlap | --field [--queries COUNT] | --tight
    /// [--firmware] | --paper TABLE [--firmware] | --margins TRIALS] [MESH…]`; `None` if that is
    /// not what the words are.
    pub fn parse(words: &[&str]) -> Option<Self> {
        let mut options = Self::default();
        let mut words = words.iter();
        while let Some(&word) = words.next() {
            let part = match word {
                "--tree" => Part::Tree,
                "--overlap" => Part::Overlap,
                "--triboxes" => Part::Triboxes,
                "--tight" => Part::Tight,
                "--paper" => {
                    let name = words.next()?;
                    Part::Paper(paper::ALL.iter().position(|table| table.name == *name)?)
                }
                "--deform" => Part::Deform,
                "--firmware" if !options.is_on_board => {
                    options.is_on_board = true;
                    continue;
                }
                "--field" => Part::Field,
                "--queries" => {
                    options.queries = Some(words.next()?.parse().ok().filter(|&of| of > 0)?);
                    continue;
                }
                "--margins" => {
                    options.margins = Some(words.next()?.parse().ok()?);
                    continue;
                }
                flag if flag.starts_with("--") => return None,
                mesh => {
                    options.meshes.push(PathBuf::from(mesh));
                    continue;
                }
            };
            if options.part.replace(part).is_some() {
                return None;
            }
        }
        let of_boards = [Some(Part::Tight), fans().map(Part::Paper)];
        let fits = (!options.is_on_board || of_boards.contains(&options.part))
            && (options.queries.is_none() || options.part == Some(Part::Field));
        fits.then_some(options)
    }
}

/// The table of what fans store, which boards tell too.
fn fans() -> Option<usize> {
    paper::ALL.iter().position(|table| table.name == "003.3")
}

/// The meshes, or two fixtures if there are none.
pub fn or_fixtures(meshes: Vec<PathBuf>) -> Vec<PathBuf> {
    if !meshes.is_empty() {
        return meshes;
    }
    ["bracket.stl", "torus.ply"].map(|name| workspace::root().join("fixtures").join(name)).to_vec()
}

/// Measures each mesh, the fixtures if none is named; tight hulls and fans on a board if the
/// firmware is asked for.
pub fn run(steps: &mut Steps, options: Options) {
    let Options { meshes, part, margins, queries, is_on_board } = options;
    if let Some(trials) = margins {
        steps.run("margins", || margins::table(trials).map(|table| say::text(table.text())));
        return;
    }
    let tools = if is_on_board { tools::setup(steps) } else { None };
    for mesh in &or_fixtures(meshes) {
        steps.run(&format!("measure {}", mesh.display()), || {
            let tables = match part {
                Some(Part::Tree) => measure_tree(mesh)?,
                Some(Part::Overlap) => measure_overlap(mesh)?,
                Some(Part::Triboxes) => measure_triboxes(mesh)?,
                Some(Part::Paper(table)) => {
                    let mut tables = paper::measure(&paper::ALL[table], mesh)?;
                    if let Some(tools) = &tools {
                        tables.push(fans_on_board::table(tools, mesh)?);
                    }
                    tables
                }
                Some(Part::Field) => measure_field(mesh, queries.unwrap_or(field::QUERIES))?,
                Some(Part::Deform) => measure_deform(mesh)?,
                Some(Part::Tight) => match &tools {
                    Some(tools) => vec![hulls_on_board::table(tools, mesh)?],
                    None => measure_tight(mesh)?,
                },
                None => measure(mesh)?,
            };
            for table in &tables {
                say::text(table.text());
            }
            Ok(())
        });
    }
}

#[cfg(test)]
mod tests {
    use super::{Options, Part};
    use std::path::PathBuf;

    #[test]
    fn flags_and_meshes_come_in_any_order() {
        let options = Options::parse(&["a.ply", "--firmware", "--tight", "b.stl"]).expect("fine");
        assert_eq!(options.meshes, ["a.ply", "b.stl"].map(PathBuf::from));
        assert!(options.is_on_board && options.part == Some(Part::Tight));
    }

    #[test]
    fn words_that_do_not_fit_each_other_are_refused() {
        for words in [
            &["--fast"][..],
            &["--tree", "--deform"],
            &["--firmware"],
            &["--overlap", "--overlap"],
            &["--firmware", "--tree"],
            &["--queries", "10"],
            &["--field", "--queries", "0"],
            &["--firmware", "--paper", "003.1"],
            &["--paper"],
            &["--paper", "000.9"],
            &["--paper", "000.1", "--tree"],
        ] {
            assert_eq!(Options::parse(words), None, "{words:?}");
        }
    }
}
