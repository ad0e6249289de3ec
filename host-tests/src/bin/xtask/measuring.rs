//! `cargo xtask measure`: the tables of `host_tests::measure`, printed and written.

use std::fs;
use std::path::{Path, PathBuf};

use meshsweep_host_tests::measure::{measure, measure_bounds, measure_tight, measure_tree};
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
    /// One part alone.
    only: Option<Only>,
}

/// What may be measured alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Only {
    Tree,
    Bounds,
    Tight,
}

impl Options {
    /// `[--firmware] [--tree | --bounds | --tight] [--json FILE] [MESH…]`; `None` if that is not what the words are.
    pub fn parse(words: &[&str]) -> Option<Self> {
        let mut options = Self::default();
        let mut words = words.iter();
        while let Some(&word) = words.next() {
            match word {
                "--firmware" => options.firmware = true,
                "--tree" | "--bounds" | "--tight" if options.only.is_some() => return None,
                "--tree" => options.only = Some(Only::Tree),
                "--bounds" => options.only = Some(Only::Bounds),
                "--tight" => options.only = Some(Only::Tight),
                "--json" => options.json = Some(PathBuf::from(words.next()?)),
                flag if flag.starts_with("--") => return None,
                mesh => options.meshes.push(PathBuf::from(mesh)),
            }
        }
        Some(options)
    }
}

/// Measures each mesh, the fixtures if none is named; with `--tree` only what is about the box tree, with `--bounds` only convex
/// bounds, with `--tight` only tight hulls; and the firmware if asked to.
pub fn run(steps: &mut Steps, options: &Options) {
    let fixtures = ["bracket.stl", "torus.ply"].map(|name| workspace::root().join("fixtures").join(name));
    let meshes = if options.meshes.is_empty() { fixtures.as_slice() } else { &options.meshes };
    let mut measured = Vec::new();
    for mesh in meshes {
        steps.run(&format!("measure {}", mesh.display()), || {
            let tables = match options.only {
                Some(Only::Tree) => measure_tree(mesh)?,
                Some(Only::Bounds) => measure_bounds(mesh)?,
                Some(Only::Tight) => measure_tight(mesh)?,
                None => measure(mesh)?,
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
    }
}
