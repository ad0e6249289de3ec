//! The workspace's own checks.

use std::env;
use std::process::{Command, ExitCode};

use crate::cross::sysroot;
use crate::process;
use crate::steps::Steps;
use crate::workspace;

/// Formatting and tests: of the laboratory too.
///
/// Each command is about the whole workspace. One about a part of it enables fewer features of the
/// dependencies, and compiles them and the library again.
pub fn run(steps: &mut Steps) {
    steps.run("formatting", || process::run(&mut cargo(&["fmt", "--all", "--check"])));
    steps.run("formatting of the firmware", || {
        process::run(cargo(&["fmt", "--all", "--check"]).current_dir(workspace::firmware()))
    });
    // Apart, so that the summary tells what compiling takes and what the tests themselves.
    let test = ["test", "--workspace", "--no-fail-fast"];
    let compile = || process::run(&mut cargo(&[&test[..], &["--quiet", "--no-run"]].concat()));
    if steps.run("tests compile", compile).is_some() {
        steps.run("tests pass", || process::run(&mut cargo(&test)));
    }
}

/// Lints and documentation of the whole workspace. They compile nothing that the tests need, so they
/// can wait until a processor is free.
pub fn lints(steps: &mut Steps) {
    steps.run("lints", || {
        let mut command = cargo(&["clippy", "--quiet", "--workspace", "--all-targets"]);
        // The fuzzer is linted and not linked, so its own C++ need not be compiled.
        command.env("CUSTOM_LIBFUZZER_PATH", workspace::target().join("libfuzzer.a"));
        process::run(command.args(["--", "-D", "warnings"]))
    });
    steps.run("documentation", || {
        let mut command = cargo(&["doc", "--quiet", "--workspace", "--no-deps"]);
        let driver = sysroot()?.join("bin/clippy-driver");
        if driver.is_file() {
            // As the lints have it: else each crate beneath a documented one is checked again.
            command.env("RUSTC_WORKSPACE_WRAPPER", driver);
            command.env("CLIPPY_ARGS", "-D__CLIPPY_HACKERY__warnings__CLIPPY_HACKERY__");
        }
        process::run(command.env("RUSTDOCFLAGS", "-D warnings"))
    });
}

/// Hands the words to the laboratory, which is built as published programs are.
pub fn lab(words: &[&str]) -> ExitCode {
    let mut command =
        cargo(&["run", "--quiet", "--profile", "dist", "--package", "meshsweep-lab", "--"]);
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
