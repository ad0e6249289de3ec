//! `cargo xtask measure`: the tables of `measure`, printed and plotted.

use std::fs;
use std::path::{Path, PathBuf};

use meshsweep_lab::measure::bounds::cost::{Cost, counted};
use meshsweep_lab::measure::paper;
use meshsweep_lab::measure::plot::{self, Measured};
use meshsweep_lab::measure::tight::picture;
use meshsweep_lab::measure::{
    margins, measure, measure_bounds, measure_deform, measure_motion, measure_overlap,
    measure_tight, measure_tree, measure_triboxes, measure_winding,
};
use meshsweep_xtask::say;
use meshsweep_xtask::steps::Steps;
use meshsweep_xtask::tools;
use meshsweep_xtask::valgrind::Valgrind;
use meshsweep_xtask::workspace;

use crate::hulls_on_board;

/// What to measure.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Options {
    meshes: Vec<PathBuf>,
    plot: Option<PathBuf>,
    picture: Option<PathBuf>,
    part: Option<Part>,
    /// Trials of each margin, of no mesh.
    margins: Option<usize>,
    /// Hulls on a board, or bounds in the simulator.
    is_counted: bool,
}

/// What of a mesh, if not hull hierarchy and box tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Part {
    Tree,
    Bounds,
    Overlap,
    Motion,
    Winding,
    Triboxes,
    Tight,
    Deform,
    /// A table of [`paper::ALL`].
    Paper(usize),
}

impl Options {
    /// `[--tree | --triboxes | --deform | --overlap | --motion | --winding | --tight [--firmware] |
    /// --bounds [--count] | --paper TABLE | --margins TRIALS] [--plot FILE.svg] [--picture
    /// FILE.svg] [MESH…]`, the picture with `--tight` alone; `None` if that is not what the words
    /// are.
    pub fn parse(words: &[&str]) -> Option<Self> {
        let mut options = Self::default();
        let mut only = None;
        let mut words = words.iter();
        while let Some(&word) = words.next() {
            let part = match word {
                "--tree" => Part::Tree,
                "--bounds" => Part::Bounds,
                "--overlap" => Part::Overlap,
                "--motion" => Part::Motion,
                "--winding" => Part::Winding,
                "--triboxes" => Part::Triboxes,
                "--tight" => Part::Tight,
                "--paper" => {
                    let name = words.next()?;
                    Part::Paper(paper::ALL.iter().position(|table| table.name == *name)?)
                }
                "--deform" => Part::Deform,
                "--count" | "--firmware" if only.is_none() => {
                    only = Some(if word == "--count" { Part::Bounds } else { Part::Tight });
                    continue;
                }
                "--margins" => {
                    options.margins = Some(words.next()?.parse().ok()?);
                    continue;
                }
                "--plot" => {
                    options.plot = Some(svg(words.next()?)?);
                    continue;
                }
                "--picture" => {
                    options.picture = Some(svg(words.next()?)?);
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
        options.is_counted = only.is_some();
        let is_drawn_rightly = options.part == Some(Part::Tight) || options.picture.is_none();
        (is_drawn_rightly && (only.is_none() || only == options.part)).then_some(options)
    }
}

/// A file of the only format that plots are written in.
fn svg(file: &str) -> Option<PathBuf> {
    let file = PathBuf::from(file);
    file.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("svg")).then_some(file)
}

/// The meshes, or two fixtures if there are none.
pub fn or_fixtures(meshes: Vec<PathBuf>) -> Vec<PathBuf> {
    if !meshes.is_empty() {
        return meshes;
    }
    ["bracket.stl", "torus.ply"].map(|name| workspace::root().join("fixtures").join(name)).to_vec()
}

/// Measures each mesh, the fixtures if none is named; tight hulls on a board if the firmware is
/// asked for.
pub fn run(steps: &mut Steps, options: Options) {
    let Options { meshes, plot, picture, part, margins, is_counted } = options;
    if let Some(trials) = margins {
        steps.run("margins", || margins::table(trials).map(|table| say::text(table.text())));
        return;
    }
    let valgrind = if is_counted && part == Some(Part::Bounds) { Valgrind::find() } else { None };
    let tools = if is_counted && part == Some(Part::Tight) { tools::setup(steps) } else { None };
    let (mut plotted, mut drawn) = (Vec::new(), Vec::new());
    for mesh in &or_fixtures(meshes) {
        let counts = valgrind.as_ref().and_then(|valgrind| {
            steps.run(&format!("count bounds of {}", mesh.display()), || count(valgrind, mesh))
        });
        steps.run(&format!("measure {}", mesh.display()), || {
            let tables = match part {
                Some(Part::Tree) => measure_tree(mesh)?,
                Some(Part::Bounds) => measure_bounds(mesh, counts.as_deref())?,
                Some(Part::Overlap) => measure_overlap(mesh)?,
                Some(Part::Motion) => measure_motion(mesh)?,
                Some(Part::Winding) => measure_winding(mesh)?,
                Some(Part::Triboxes) => measure_triboxes(mesh)?,
                Some(Part::Paper(table)) => paper::measure(&paper::ALL[table], mesh)?,
                Some(Part::Deform) => measure_deform(mesh)?,
                Some(Part::Tight) => match &tools {
                    Some(tools) => vec![hulls_on_board::table(tools, mesh)?],
                    None => {
                        let (tables, gallery) = measure_tight(mesh)?;
                        drawn.push(gallery);
                        tables
                    }
                },
                None => measure(mesh)?,
            };
            for table in &tables {
                say::text(table.text());
            }
            let name = mesh.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            plotted.push(Measured { mesh: name, tables });
            Ok(())
        });
    }
    if let Some(file) = &plot {
        steps.run("plot", || write(file, &plot::svg(&plotted)?));
    }
    if let Some(file) = &picture {
        steps.run("draw the hulls", || write(file, &picture::svg(drawn)?));
    }
}

/// Instructions of each bound at one pose. The simulator writes a profile after each move and after
/// each test.
fn count(valgrind: &Valgrind, mesh: &Path) -> Result<Vec<Cost>, String> {
    let functions = [counted::COUNTED, counted::WRITTEN];
    let (printed, totals) =
        valgrind.stages("bounds-count", functions, &["ask-bounds".as_ref(), mesh.as_os_str()])?;
    let asked = printed.lines().find_map(|line| line.strip_prefix("asked "));
    let read = || {
        let (bounds, poses) = asked?.split_once(' ')?;
        let (bounds, poses): (usize, f64) = (bounds.parse().ok()?, poses.parse().ok()?);
        let stages = totals.get(..2 * bounds)?.chunks_exact(2);
        let each = |total: f64| total / poses;
        Some(stages.map(|pair| Cost { update: each(pair[0]), test: each(pair[1]) }).collect())
    };
    read().ok_or_else(|| format!("callgrind counted nothing\n{printed}"))
}

/// The run that is counted.
pub fn ask(mesh: &str) -> Result<(), String> {
    let [bounds, poses] = counted::ask(Path::new(mesh))?;
    say!("asked {bounds} {poses}");
    Ok(())
}

fn write(file: &Path, text: &str) -> Result<(), String> {
    fs::write(file, text.to_owned() + "\n")
        .map_err(|error| format!("cannot write {}: {error}", file.display()))
}

#[cfg(test)]
mod tests {
    use super::{Options, Part};
    use std::path::PathBuf;

    #[test]
    fn flags_and_meshes_come_in_any_order() {
        let words = ["a.ply", "--count", "--plot", "trade.svg", "--bounds", "b.stl"];
        let options = Options::parse(&words).expect("fine");
        assert_eq!(options.meshes, ["a.ply", "b.stl"].map(PathBuf::from));
        assert_eq!(options.plot, Some(PathBuf::from("trade.svg")));
        assert!(options.is_counted && options.part == Some(Part::Bounds));
        let options = Options::parse(&["--tight", "--picture", "hulls.svg"]).expect("fine");
        assert_eq!(options.picture, Some(PathBuf::from("hulls.svg")));
    }

    #[test]
    fn words_that_do_not_fit_each_other_are_refused() {
        for words in [
            &["--plot"][..],
            &["--fast"],
            &["--tree", "--bounds"],
            &["--overlap", "--overlap"],
            &["--plot", "trade.png"],
            &["--count"],
            &["--firmware", "--tree"],
            &["--picture", "hulls.svg"],
            &["--paper"],
            &["--paper", "000.9"],
            &["--paper", "000.1", "--tree"],
        ] {
            assert_eq!(Options::parse(words), None, "{words:?}");
        }
    }
}
