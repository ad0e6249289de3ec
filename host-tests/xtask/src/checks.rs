//! The workspace's own checks.

use std::env;
use std::process::{Command, ExitCode};

use crate::process;
use crate::steps::Steps;
use crate::workspace;

/// Formatting, lints, tests, documentation.
pub fn run(steps: &mut Steps) {
    steps.run("formatting", || process::run(&mut cargo(&["fmt", "--all", "--check"])));
    steps.run("formatting of the firmware", || {
        process::run(cargo(&["fmt", "--check"]).current_dir(workspace::firmware()))
    });
    steps.run("lints", || {
        process::run(&mut cargo(&[
            "clippy",
            "--quiet",
            "--workspace",
            "--exclude",
            "meshsweep-lab",
            "--all-targets",
            "--",
            "-D",
            "warnings",
        ]))
    });
    steps.run("tests", || {
        process::run(&mut cargo(&[
            "test",
            "--workspace",
            "--exclude",
            "meshsweep-lab",
            "--no-fail-fast",
        ]))
    });
    steps.run("documentation", || {
        process::run(
            cargo(&["doc", "--quiet", "--workspace", "--exclude", "meshsweep-lab", "--no-deps"])
                .env("RUSTDOCFLAGS", "-D warnings"),
        )
    });
}

/// Lints and tests of the laboratory, whose peers take longer to build than the library.
pub fn of_lab(steps: &mut Steps) {
    let package = ["--package", "meshsweep-lab"];
    steps.run("lints of the laboratory", || {
        let mut command = cargo(&["clippy", "--quiet", "--all-targets"]);
        process::run(command.args(package).args(["--", "-D", "warnings"]))
    });
    steps.run("tests of the laboratory", || process::run(cargo(&["test"]).args(package)));
}

/// Hands the words to the laboratory, which is built as users build the library.
pub fn lab(words: &[&str]) -> ExitCode {
    let mut command = cargo(&["run", "--quiet", "--release", "--package", "meshsweep-lab", "--"]);
    let code = command.args(words).status().ok().and_then(|status| status.code());
    code.map_or(ExitCode::FAILURE, |code| ExitCode::from(code as u8))
}

/// `cargo` at the repository's root.
pub fn cargo(arguments: &[&str]) -> Command {
    let mut command = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.args(arguments).current_dir(workspace::root());
    // What is kept for the next build costs time and a gigabyte in this one, of which most are the
    // first.
    if env::var_os("CARGO_INCREMENTAL").is_none() {
        command.env("CARGO_INCREMENTAL", "0");
    }
    command
}
