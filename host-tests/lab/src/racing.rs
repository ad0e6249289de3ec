//! `cargo xtask race`: engines against each other, in nanoseconds or in instructions.

use std::fs;
use std::path::{Path, PathBuf};

use meshsweep_lab::race::engine::ENTRANTS;
use meshsweep_lab::race::{Scale, Scope, Workload, counted, race, summary};
use meshsweep_xtask::say;
use meshsweep_xtask::steps::Steps;
use meshsweep_xtask::table::{Cell, Table, fixed};
use meshsweep_xtask::valgrind::Valgrind;
use meshsweep_xtask::workspace;
use serde_json::{Value, json};

/// Triangles up to which the hull engine takes part unasked: some seconds of building.
const HULL_TRIANGLES: usize = 100_000;
/// The same in the simulator.
const HULL_TRIANGLES_COUNTED: usize = 10_000;

/// What to run.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Options {
    meshes: Vec<PathBuf>,
    json: Option<PathBuf>,
    quick: bool,
    count: bool,
    hull: bool,
}

impl Options {
    /// `[--count] [--quick] [--hull] [--json FILE] [MESH…]`; `None` if that is not what the words
    /// are.
    pub fn parse(words: &[&str]) -> Option<Self> {
        let mut options = Self::default();
        let mut words = words.iter();
        while let Some(&word) = words.next() {
            match word {
                "--quick" => options.quick = true,
                "--count" => options.count = true,
                "--hull" => options.hull = true,
                "--json" => options.json = Some(PathBuf::from(words.next()?)),
                flag if flag.starts_with("--") => return None,
                mesh => options.meshes.push(PathBuf::from(mesh)),
            }
        }
        Some(options)
    }

    fn hull_triangles(&self, unasked: usize) -> usize {
        if self.hull { usize::MAX } else { unasked }
    }
}

/// Runs the race on each mesh, on the fixtures if none is named.
pub fn run(steps: &mut Steps, options: &Options) {
    let fixtures =
        ["bracket.stl", "torus.ply"].map(|name| workspace::root().join("fixtures").join(name));
    let meshes = if options.meshes.is_empty() { fixtures.as_slice() } else { &options.meshes };
    let results =
        if options.count { count(steps, options, meshes) } else { time(steps, options, meshes) };
    if let Some(file) = &options.json {
        steps.run("write the tables", || write(file, &results));
    }
}

fn time(steps: &mut Steps, options: &Options, meshes: &[PathBuf]) -> Vec<Value> {
    let scale = if options.quick { Scale::QUICK } else { Scale::FULL };
    let scope = Scope { scale, hull_triangles: options.hull_triangles(HULL_TRIANGLES) };
    let (mut races, mut results) = (Vec::new(), Vec::new());
    for mesh in meshes {
        if let Some(run) = steps.run(&format!("race {}", mesh.display()), || race(mesh, &scope)) {
            results.push(shown(&run.mesh, &run.tables));
            races.push(run);
        }
    }
    if races.len() > 1 {
        results.push(shown("all", &[summary(&races)]));
    }
    results
}

fn count(steps: &mut Steps, options: &Options, meshes: &[PathBuf]) -> Vec<Value> {
    let Some(valgrind) = Valgrind::find() else { return Vec::new() };
    let columns: Vec<&'static str> = ["engine"]
        .into_iter()
        .chain(Workload::ALL.iter().map(|workload| workload.name()))
        .collect();
    let mut results = Vec::new();
    for mesh in meshes {
        let name = mesh.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let mut table =
            Table::new("instructions", format!("Instructions a query, {name}"), &columns);
        for entrant in ENTRANTS.iter().filter(|entrant| entrant.counted) {
            let counts =
                steps.run(&format!("count {} on {}", entrant.name, mesh.display()), || {
                    instructions(
                        &valgrind,
                        entrant.name,
                        mesh,
                        options.hull_triangles(HULL_TRIANGLES_COUNTED),
                    )
                });
            let cell = |workload: &Workload| {
                let counted =
                    counts.iter().flatten().find(|(counted, _)| counted == workload.name());
                counted.map_or(Cell::Empty, |(_, each)| fixed(*each, 0))
            };
            let cells = Workload::ALL.iter().map(cell);
            table.push([Cell::from(entrant.name)].into_iter().chain(cells).collect());
        }
        table.note("as by `cargo xtask race`, but fewer queries, and of the field every 131st pair of rows");
        results.push(shown(&name, &[table]));
    }
    results
}

/// Instructions a query of each workload. The simulator writes a profile after each workload.
fn instructions(
    valgrind: &Valgrind,
    engine: &str,
    mesh: &Path,
    hull_triangles: usize,
) -> Result<Vec<(String, f64)>, String> {
    let hull_triangles = hull_triangles.to_string();
    let arguments =
        ["ask-engine".as_ref(), engine.as_ref(), mesh.as_os_str(), hull_triangles.as_ref()];
    let (printed, totals) =
        valgrind.stages("race-count", [counted::COUNTED, counted::WRITTEN], &arguments)?;
    let asked = printed.lines().filter_map(|line| line.strip_prefix("asked "));
    asked
        .enumerate()
        .map(|(index, line)| {
            let read = || {
                let (workload, queries) = line.split_once(' ')?;
                Some((workload.to_owned(), totals.get(index)? / queries.parse::<f64>().ok()?))
            };
            read().ok_or_else(|| format!("callgrind counted nothing for `{line}`"))
        })
        .collect()
}

/// The run that is counted.
pub fn ask(engine: &str, mesh: &str, hull_triangles: usize) -> Result<(), String> {
    for (workload, queries) in counted::ask(Path::new(mesh), engine, hull_triangles)? {
        say!("asked {} {queries}", workload.name());
    }
    Ok(())
}

fn shown(mesh: &str, tables: &[Table]) -> Value {
    for table in tables {
        say::text(table.text());
    }
    json!({ "mesh": mesh, "tables": tables.iter().map(Table::json).collect::<Vec<Value>>() })
}

fn write(file: &Path, results: &[Value]) -> Result<(), String> {
    let text = serde_json::to_string_pretty(results).map_err(|error| error.to_string())?;
    fs::write(file, text + "\n")
        .map_err(|error| format!("cannot write {}: {error}", file.display()))
}

#[cfg(test)]
mod tests {
    use super::Options;
    use std::path::PathBuf;

    #[test]
    fn flags_and_meshes_come_in_any_order() {
        let options =
            Options::parse(&["a.ply", "--quick", "--json", "out.json", "b.stl"]).expect("fine");
        assert_eq!(options.meshes, ["a.ply", "b.stl"].map(PathBuf::from));
        assert!(options.quick && !options.count && !options.hull);
        assert_eq!(Options::parse(&["--json"]), None);
        assert_eq!(Options::parse(&["--fast"]), None);
    }
}
