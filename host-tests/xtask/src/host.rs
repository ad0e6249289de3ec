//! The programs of host-tests: all that the commands need of the library on this machine.

use std::path::PathBuf;

use crate::checks::cargo;
use crate::process;
use crate::workspace;

/// Runs the one that builds as the tests are built, so that nothing is compiled twice; its output.
pub fn run(arguments: &[&str]) -> Result<String, String> {
    // With the features that all of the workspace asks for.
    let program = build("dev", "debug", &["--workspace", "--bin", "host"])?;
    process::capture(std::process::Command::new(program.join("host")).args(arguments))
}

/// Builds those that ask, as published programs are built; their folder.
pub fn counted() -> Result<PathBuf, String> {
    let bins = ["--bin", "counted", "--bin", "counted-suite"];
    build("dist", "dist", &[&["--package", "meshsweep-counted"][..], &bins].concat())
}

/// The folder of what was built.
fn build(profile: &str, folder: &str, packages: &[&str]) -> Result<PathBuf, String> {
    let mut command = cargo(&["build", "--quiet", "--profile", profile]);
    process::capture(command.args(packages))?;
    Ok(workspace::target().join(folder))
}
