//! `cargo xtask release`: what has to hold before the crates are published, beyond the tests. The
//! oldest Rust, the documentation as docs.rs makes it, the public interfaces, a dry run.

use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::checks::cargo;
use crate::process;
use crate::steps::Steps;
use crate::workspace;

/// The oldest Rust that the crates support: `rust-version`.
const OLDEST: &str = env!("CARGO_PKG_RUST_VERSION");

/// The compiler of the documentation and of the lists, by its day: of another day's the lists may
/// differ, and [`LISTER`] may not read its JSON.
const NIGHTLY: &str = "nightly-2026-10-30";

/// Lists public items from rustdoc's JSON, whose format depends on the compiler.
const LISTER: (&str, &str) = ("cargo-public-api", "0.52.0");

/// The crates that are published, in this order.
const CRATES: [&str; 2] = ["meshsweep-core", "meshsweep"];

/// Checks all, and compares the lists of public items, or writes them anew.
pub fn run(steps: &mut Steps, is_update: bool) {
    steps.run(&format!("Rust {OLDEST}"), oldest);
    steps.run("documentation as docs.rs makes it", documentation);
    let lister = steps.run(LISTER.0, lister);
    for name in CRATES {
        let Some(lister) = &lister else { break };
        steps.run(&format!("public interface of {name}"), || interface(lister, name, is_update));
    }
    if is_update {
        // A list that changed is committed first.
        return;
    }
    steps.run("dry run of publishing", || {
        process::run(cargo(&["publish", "--dry-run", "--locked", "--quiet"]).args(packages()))
    });
}

fn packages() -> impl Iterator<Item = &'static str> {
    CRATES.iter().flat_map(|name| ["--package", name])
}

/// cargo of another compiler, which rustup fetches if it is missing. In a folder of its own: the
/// artifacts of compilers replace each other.
fn cargo_of(compiler: &str) -> Result<Command, String> {
    let has_it = ["run", compiler, "rustc", "--version"];
    if process::capture(Command::new("rustup").args(has_it)).is_err() {
        let fetch = ["toolchain", "install", compiler, "--profile", "minimal", "--no-self-update"];
        process::capture(Command::new("rustup").args(fetch))?;
    }
    let mut command = Command::new("rustup");
    // Else the variables of the compiler that runs this decide.
    command.env_remove("RUSTUP_TOOLCHAIN").env_remove("CARGO").env_remove("RUSTC");
    command.current_dir(workspace::root()).args(["run", compiler, "cargo"]);
    command.env("CARGO_TARGET_DIR", workspace::target().join("release-checks").join(compiler));
    Ok(command)
}

fn oldest() -> Result<(), String> {
    let check = ["check", "--quiet", "--locked", "--all-features"];
    process::run(cargo_of(OLDEST)?.args(check).args(packages()))
}

fn documentation() -> Result<(), String> {
    for name in CRATES {
        let doc = ["doc", "--quiet", "--locked", "--no-deps", "--all-features", "--package", name];
        let mut command = cargo_of(NIGHTLY)?;
        process::run(command.args(doc).env("RUSTDOCFLAGS", "--cfg docsrs -D warnings"))?;
    }
    Ok(())
}

/// The program that lists items, installed aside.
fn lister() -> Result<PathBuf, String> {
    let (name, version) = LISTER;
    let folder = workspace::tools()?.join(format!("{name}-{version}"));
    let program = folder.join("bin").join(name);
    if !program.exists() {
        let words = ["install", "--quiet", "--locked", name, "--version", version, "--root"];
        process::run(cargo(&words).arg(&folder))?;
    }
    Ok(program)
}

/// Lists the public items of a crate without those of traits that the compiler derives or that all
/// types implement, and compares them with `host-tests/interface`, or writes them there.
fn interface(lister: &Path, name: &str, is_update: bool) -> Result<(), String> {
    let file = workspace::root().join("host-tests/interface").join(name).with_extension("txt");
    // The lister runs cargo of this compiler by itself.
    cargo_of(NIGHTLY)?;
    let mut list = Command::new(lister);
    list.current_dir(workspace::root()).env("RUSTUP_TOOLCHAIN", NIGHTLY);
    list.args(["--package", name, "-sss", "--color", "never", "--target-dir"]);
    list.arg(workspace::target().join("release-checks/interface"));
    let now = process::capture(&mut list)?;
    let failed = |error| format!("{}: {error}", file.display());
    if is_update {
        return fs::write(&file, now).map_err(failed);
    }
    let kept = fs::read_to_string(&file).map_err(failed)?;
    let [before, after] = [&kept, &now].map(|text| text.lines().collect::<HashSet<_>>());
    let gone = kept.lines().filter(|line| !after.contains(line)).map(|line| format!("- {line}"));
    let new = now.lines().filter(|line| !before.contains(line)).map(|line| format!("+ {line}"));
    let changes: Vec<String> = gone.chain(new).collect();
    if changes.is_empty() {
        return Ok(());
    }
    let changes = changes.join("\n");
    let remedy = "`cargo xtask release --write` writes it";
    Err(format!("{} is stale; {remedy}\n{changes}", file.display()))
}
