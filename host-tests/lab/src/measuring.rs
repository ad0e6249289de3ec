//! `cargo xtask measure`: the tables of `measure`, printed, written and plotted.

use std::fs;
use std::path::{Path, PathBuf};

use meshsweep_lab::measure::bounds::cost::{Cost, counted};
use meshsweep_lab::measure::plot::{self, Measured};
use meshsweep_lab::measure::tight::picture;
use meshsweep_lab::measure::{
    measure, measure_bounds, measure_overlap, measure_tight, measure_tree, measure_triboxes,
};
use meshsweep_xtask::firmware;
use meshsweep_xtask::say;
use meshsweep_xtask::steps::Steps;
use meshsweep_xtask::valgrind::Valgrind;
use meshsweep_xtask::workspace;
use serde_json::{Value, json};

use crate::hulls_on_board;

/// What to measure.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Options {
    meshes: Vec<PathBuf>,
    json: Option<PathBuf>,
    plot: Option<PathBuf>,
    picture: Option<PathBuf>,
    firmware: bool,
    part: Option<Part>,
    count: bool,
}

/// What of a mesh, if not hull hierarchy and box tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Part {
    Tree,
    Bounds,
    Overlap,
    Triboxes,
    Tight,
}

impl Options {
    /// `[--firmware] [--tree | --triboxes | --overlap | --tight | --bounds [--count]] [--json FILE]
    /// [--plot FILE.svg] [--picture FILE.svg] [MESH…]`, the picture with `--tight` alone; `None` if
    /// that is not what the words are.
    pub fn parse(words: &[&str]) -> Option<Self> {
        let mut options = Self::default();
        let mut words = words.iter();
        while let Some(&word) = words.next() {
            match word {
                "--firmware" => options.firmware = true,
                "--tree" if options.part.is_none() => options.part = Some(Part::Tree),
                "--bounds" if options.part.is_none() => options.part = Some(Part::Bounds),
                "--overlap" if options.part.is_none() => options.part = Some(Part::Overlap),
                "--triboxes" if options.part.is_none() => options.part = Some(Part::Triboxes),
                "--tight" if options.part.is_none() => options.part = Some(Part::Tight),
                "--count" => options.count = true,
                "--json" => options.json = Some(PathBuf::from(words.next()?)),
                "--plot" => options.plot = Some(svg(words.next()?)?),
                "--picture" => options.picture = Some(svg(words.next()?)?),
                flag if flag.starts_with("--") => return None,
                mesh => options.meshes.push(PathBuf::from(mesh)),
            }
        }
        let is_counted_rightly = options.part == Some(Part::Bounds) || !options.count;
        let is_drawn_rightly = options.part == Some(Part::Tight) || options.picture.is_none();
        (is_counted_rightly && is_drawn_rightly).then_some(options)
    }
}

/// A file of the only format that plots are written in.
fn svg(file: &str) -> Option<PathBuf> {
    let file = PathBuf::from(file);
    file.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("svg")).then_some(file)
}

/// Measures each mesh, the fixtures if none is named; with `--tree` only what is about the box
/// tree, with `--bounds` only convex bounds, with `--overlap` the mesh against itself, with
/// `--triboxes` only stored triboxes, with `--tight` only tight hulls, on a board if the firmware
/// is asked for; and the firmware if asked to.
pub fn run(steps: &mut Steps, options: &Options) {
    let fixtures =
        ["bracket.stl", "torus.ply"].map(|name| workspace::root().join("fixtures").join(name));
    let meshes = if options.meshes.is_empty() { fixtures.as_slice() } else { &options.meshes };
    let valgrind = if options.count { Valgrind::find() } else { None };
    let hulls_on_board = options.firmware && options.part == Some(Part::Tight);
    let tools = if hulls_on_board { firmware::setup(steps) } else { None };
    let (mut written, mut plotted, mut drawn) = (Vec::new(), Vec::new(), Vec::new());
    for mesh in meshes {
        let counts = valgrind.as_ref().and_then(|valgrind| {
            steps.run(&format!("count bounds of {}", mesh.display()), || count(valgrind, mesh))
        });
        steps.run(&format!("measure {}", mesh.display()), || {
            let tables = match options.part {
                Some(Part::Tree) => measure_tree(mesh)?,
                Some(Part::Bounds) => measure_bounds(mesh, counts.as_deref())?,
                Some(Part::Overlap) => measure_overlap(mesh)?,
                Some(Part::Triboxes) => measure_triboxes(mesh)?,
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
            written.push(json!({
                "mesh": mesh.file_name().map(|name| name.to_string_lossy()),
                "tables": tables.iter().map(|table| table.json()).collect::<Vec<Value>>(),
            }));
            let name = mesh.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            plotted.push(Measured { mesh: name, tables });
            Ok(())
        });
    }
    if let Some(file) = &options.json {
        steps.run("write the tables", || write(file, &written));
    }
    if let Some(file) = &options.plot {
        steps.run("plot", || text(file, &plot::svg(&plotted)?));
    }
    if let Some(file) = &options.picture {
        steps.run("draw the hulls", || text(file, &picture::svg(drawn)?));
    }
    if options.firmware
        && !hulls_on_board
        && let Some(tools) = firmware::setup(steps)
    {
        firmware::run(steps, &tools, None);
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

fn write(file: &Path, measured: &[Value]) -> Result<(), String> {
    text(file, &serde_json::to_string_pretty(measured).map_err(|error| error.to_string())?)
}

fn text(file: &Path, text: &str) -> Result<(), String> {
    fs::write(file, text.to_owned() + "\n")
        .map_err(|error| format!("cannot write {}: {error}", file.display()))
}

#[cfg(test)]
mod tests {
    use super::Options;
    use std::path::PathBuf;

    #[test]
    fn flags_and_meshes_come_in_any_order() {
        let options =
            Options::parse(&["a.ply", "--json", "out.json", "--firmware", "b.stl"]).expect("fine");
        assert_eq!(options.meshes, ["a.ply", "b.stl"].map(PathBuf::from));
        assert_eq!(options.json, Some(PathBuf::from("out.json")));
        assert!(options.firmware);
        assert_eq!(Options::parse(&["--json"]), None);
        assert_eq!(Options::parse(&["--fast"]), None);
        assert_eq!(Options::parse(&["--tree", "--bounds"]), None);
        assert_eq!(Options::parse(&["--triboxes", "--bounds"]), None);
        assert_eq!(Options::parse(&["--overlap", "--overlap"]), None);
    }

    #[test]
    fn plots_are_svg_and_only_bounds_are_counted() {
        let options =
            Options::parse(&["--count", "--plot", "trade.svg", "--bounds"]).expect("fine");
        assert_eq!(options.plot, Some(PathBuf::from("trade.svg")));
        assert!(options.count && options.part == Some(super::Part::Bounds));
        assert_eq!(Options::parse(&["--plot", "trade.png"]), None);
        assert_eq!(Options::parse(&["--plot"]), None);
        let options = Options::parse(&["--tight", "--picture", "hulls.svg"]).expect("fine");
        assert_eq!(options.picture, Some(PathBuf::from("hulls.svg")));
        assert_eq!(Options::parse(&["--bounds", "--picture", "hulls.svg"]), None);
        assert_eq!(Options::parse(&["--count"]), None);
        assert_eq!(Options::parse(&["--tree", "--count"]), None);
    }
}
