//! The examples of `core/examples`, built for the Cortex-M4F as their READMEs say, and run in QEMU.
//! Each prints the lines that its README promises. The C programs of the same names print them too.
//!
//! Lines about instructions depend on the compiler. They begin with `cost:` and are not compared.

use std::fs;
use std::path::PathBuf;

use crate::boards::BOARDS;
use crate::cross::Cross;
use crate::images::Profile;
use crate::steps::Steps;
use crate::tools::Tools;
use crate::{checks, images, process, workspace};

/// An example: its folder, its C program.
#[derive(Clone, Copy, Debug)]
pub struct Example {
    /// Name of the folder and of the program.
    pub name: &'static str,
    /// The models that it asks, as source.
    pub models: &'static [&'static str],
}

/// All examples.
pub const EXAMPLES: [Example; 5] = [
    Example { name: "probe", models: &["groove"] },
    Example { name: "keep_out", models: &["clamps"] },
    Example { name: "haptics", models: &["groove", "groove_pad"] },
    Example { name: "fence", models: &["zones"] },
    Example { name: "guard", models: &["link", "table", "groove"] },
];

/// Files that all folders have alike.
const ALIKE: [&str; 4] = [".cargo/config.toml", "memory.x", "build.rs", "src/board.rs"];

/// Builds and runs all, and checks that the core compiles with `defmt`.
pub fn run(steps: &mut Steps, tools: &Tools) {
    steps.run("examples: formatting, files that are alike", sources);
    for Example { name, .. } in EXAMPLES {
        let title = format!("examples: {name} on the Cortex-M4F prints what its README says");
        steps.run(&title, || {
            let printed = without_costs(&printed(tools, name)?);
            let promised = promised(name)?;
            if printed == promised {
                return Ok(());
            }
            Err(format!("it prints\n{printed}and its README says\n{promised}"))
        });
    }
    steps.run("the core with defmt, for the Cortex-M4F", || with_defmt(&tools.cross));
}

/// The lines that an example's README promises: its only block of `text`.
///
/// # Errors
/// No such block.
pub fn promised(name: &str) -> Result<String, String> {
    let text = read(name, "README.md")?;
    let block = text.split_once("```text\n").and_then(|(_, rest)| rest.split_once("```"));
    let (block, _) = block.ok_or_else(|| format!("{name}/README.md has no block of text"))?;
    Ok(block.to_owned())
}

/// Printed lines but those about instructions.
#[must_use]
pub fn without_costs(printed: &str) -> String {
    let lines = printed.lines().filter(|line| !line.starts_with("cost: "));
    lines.flat_map(|line| [line, "\n"]).collect()
}

fn folder(name: &str) -> PathBuf {
    workspace::root().join("core/examples").join(name)
}

fn read(name: &str, file: &str) -> Result<String, String> {
    let file = folder(name).join(file);
    fs::read_to_string(&file).map_err(|error| format!("cannot read {}: {error}", file.display()))
}

fn sources() -> Result<(), String> {
    let [first, others @ ..] = EXAMPLES;
    for file in ALIKE {
        let wanted = read(first.name, file)?;
        for Example { name, .. } in others {
            if read(name, file)? != wanted {
                return Err(format!("{file} of {name} is not that of {}", first.name));
            }
        }
    }
    for Example { name, .. } in EXAMPLES {
        let mut fmt = checks::cargo(&["fmt", "--check"]);
        process::capture(fmt.current_dir(folder(name)))?;
    }
    Ok(())
}

/// What the image of an example prints. Its dependencies are compiled for all images together.
fn printed(tools: &Tools, name: &str) -> Result<String, String> {
    let board = &BOARDS[0];
    let mut command = images::cargo(&tools.cross, "rustc", &[board.target], Profile::Release);
    command.current_dir(folder(name)).args(["--", "-D", "warnings"]);
    process::capture(&mut command)?;
    let image = images::image(&tools.cross, board.target, Profile::Release, name);
    tools.qemu.run(board.machine, &image, None)
}

fn with_defmt(cross: &Cross) -> Result<(), String> {
    let mut command = images::cargo(cross, "check", &[BOARDS[0].target], Profile::Release);
    command.current_dir(workspace::root()).args(["-p", "meshsweep-core", "--features", "defmt"]);
    process::capture(&mut command).map(drop)
}
