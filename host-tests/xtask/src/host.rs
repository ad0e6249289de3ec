//! The program of host-tests: all that the commands need of the library on this machine.

use std::path::PathBuf;

use crate::checks::cargo;
use crate::process;
use crate::workspace;

/// Runs it as the tests are built, so that nothing is compiled twice; its output.
pub fn run(arguments: &[&str]) -> Result<String, String> {
    // With the features that all of the workspace asks for.
    let program = build("dev", "debug", &["--workspace"])?;
    process::capture(std::process::Command::new(program).args(arguments))
}

/// Builds it as users build the library; its path.
pub fn optimised() -> Result<PathBuf, String> {
    build("release", "release", &["--package", "meshsweep-host-tests"])
}

fn build(profile: &str, folder: &str, packages: &[&str]) -> Result<PathBuf, String> {
    let mut command = cargo(&["build", "--quiet", "--profile", profile]);
    process::capture(command.args(packages).args(["--bin", "host"]))?;
    Ok(workspace::target().join(folder).join("host"))
}
