//! `cargo xtask measure`: the tables of `host_tests::measure`, printed and written.

use std::fs;
use std::path::{Path, PathBuf};

use meshsweep_host_tests::measure::{measure, measure_bounds, measure_tree, measure_triboxes};
use serde_json::{Value, json};

use crate::firmware;
use crate::steps::Steps;
use crate::workspace;

/// What to measure.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Options {
    meshes: Vec<PathBuf>,
    json: Option<PathBuf>,
    firmware: bool,
    tree: bool,
    bounds: bool,
    triboxes: bool,
}

impl Options {
    /// `[--firmware] [--tree | --bounds | --triboxes] [--json FILE] [MESH…]`; `None` if that is not what the words are.
    pub fn parse(words: &[&str]) -> Option<Self> {
        let mut options = Self::default();
        let mut words = words.iter();
        while let Some(&word) = words.next() {
            match word {
                "--firmware" => options.firmware = true,
                "--tree" => options.tree = true,
                "--bounds" => options.bounds = true,
                "--triboxes" => options.triboxes = true,
                "--json" => options.json = Some(PathBuf::from(words.next()?)),
                flag if flag.starts_with("--") => return None,
                mesh => options.meshes.push(PathBuf::from(mesh)),
            }
        }
        let one = [options.tree, options.bounds, options.triboxes].iter().filter(|&&is| is).count() <= 1;
        one.then_some(options)
    }
}

/// Measures each mesh, the fixtures if none is named; with `--tree` only what is about the box tree, with `--bounds` only convex
/// bounds, with `--triboxes` only stored triboxes; and the firmware if asked to.
pub fn run(steps: &mut Steps, options: &Options) {
    let fixtures = ["bracket.stl", "torus.ply"].map(|name| workspace::root().join("fixtures").join(name));
    let meshes = if options.meshes.is_empty() { fixtures.as_slice() } else { &options.meshes };
    let mut measured = Vec::new();
    for mesh in meshes {
        steps.run(&format!("measure {}", mesh.display()), || {
            let tables = match options {
                Options { tree: true, .. } => measure_tree(mesh)?,
                Options { bounds: true, .. } => measure_bounds(mesh)?,
                Options { triboxes: true, .. } => measure_triboxes(mesh)?,
                _ => measure(mesh)?,
            };
            for table in &tables {
                print!("{}", table.text());
            }
            measured.push(json!({
                "mesh": mesh.file_name().map(|name| name.to_string_lossy()),
                "tables": tables.iter().map(|table| table.json()).collect::<Vec<Value>>(),
            }));
            Ok(())
        });
    }
    if let Some(file) = &options.json {
        steps.run("write the tables", || write(file, &measured));
    }
    if options.firmware
        && let Some(tools) = firmware::setup(steps)
    {
        firmware::run(steps, &tools, None);
    }
}

fn write(file: &Path, measured: &[Value]) -> Result<(), String> {
    let text = serde_json::to_string_pretty(measured).map_err(|error| error.to_string())?;
    fs::write(file, text + "\n").map_err(|error| format!("cannot write {}: {error}", file.display()))
}

#[cfg(test)]
mod tests {
    use super::Options;
    use std::path::PathBuf;

    #[test]
    fn flags_and_meshes_come_in_any_order() {
        let options = Options::parse(&["a.ply", "--json", "out.json", "--firmware", "b.stl"]).expect("fine");
        assert_eq!(options.meshes, ["a.ply", "b.stl"].map(PathBuf::from));
        assert_eq!(options.json, Some(PathBuf::from("out.json")));
        assert!(options.firmware);
        assert_eq!(Options::parse(&["--json"]), None);
        assert_eq!(Options::parse(&["--fast"]), None);
        assert_eq!(Options::parse(&["--tree", "--bounds"]), None);
        assert_eq!(Options::parse(&["--triboxes", "--bounds"]), None);
    }
}
