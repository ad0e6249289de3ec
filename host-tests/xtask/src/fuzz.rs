//! `cargo xtask fuzz`: runs the fuzz targets, and keeps the inputs that reach new code.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use crate::checks::cargo;
use crate::host;
use crate::process;
use crate::steps::Steps;
use crate::workspace;

/// The longest input of a target: two blobs with all edits and all questions.
const LONGEST: &str = "-max_len=400";
/// The longest mesh file.
const LONGEST_FILE: &str = "-max_len=2048";

/// Runs each target so many minutes, as many at once as there are cores.
pub fn run(steps: &mut Steps, minutes: u32, targets: &[&str]) {
    let all = steps.run("fuzz targets", || host::run(&["fuzz"])).unwrap_or_default();
    let unknown = targets.iter().find(|target| !all.lines().any(|known| known == **target));
    if let Some(unknown) = unknown {
        let reason = format!("no fuzz target `{unknown}`; there are\n{all}");
        steps.run("names", || Err::<(), _>(reason));
        return;
    }
    let Some(program) = steps.run("fuzzer", build) else { return };
    let is_wanted = |target: &&str| targets.is_empty() || targets.contains(target);
    let targets: Vec<&str> = all.lines().filter(is_wanted).collect();
    let found = process::parallel(&targets, |target| {
        let fuzzed = fuzz(&program, target, minutes);
        say!("   {target}: {}", fuzzed.as_ref().map_or("a finding", |text| text));
        fuzzed
    });
    for (target, (fuzzed, seconds)) in targets.iter().zip(found) {
        steps.ended(target, seconds, fuzzed);
    }
}

/// The program of all targets, with coverage and address sanitizer.
fn build() -> Result<PathBuf, String> {
    let nightly = || {
        let mut command = Command::new("rustup");
        // What cargo sets for this program would choose its own toolchain.
        command.env_remove("RUSTUP_TOOLCHAIN").env_remove("CARGO").env_remove("RUSTC");
        command
    };
    if process::capture(nightly().args(["run", "nightly", "rustc", "--version"])).is_err() {
        let install = ["toolchain", "install", "nightly", "--profile", "minimal"];
        process::run(nightly().args(install))?;
    }
    let tools = workspace::tools()?.join("cargo-fuzz");
    if !tools.join("bin/cargo-fuzz").is_file() {
        let install = ["install", "--locked", "cargo-fuzz", "--root"];
        process::run(cargo(&install).arg(&tools))?;
    }
    let folder = folder();
    let path = env::var_os("PATH").unwrap_or_default();
    let folders = [tools.join("bin")].into_iter().chain(env::split_paths(&path));
    let path = env::join_paths(folders).map_err(|error| error.to_string())?;
    process::run(
        nightly()
            .args(["run", "nightly", "cargo", "fuzz", "build", "any"])
            .current_dir(crate_folder())
            .env("PATH", path)
            .env("CARGO_TARGET_DIR", &folder),
    )?;
    // The folder between is the target's triple.
    let built = fs::read_dir(&folder).into_iter().flatten().flatten();
    let mut programs = built.map(|entry| entry.path().join("release/any"));
    programs.find(|program| program.is_file()).ok_or("cargo fuzz built no program".to_owned())
}

fn crate_folder() -> PathBuf {
    workspace::root().join("host-tests/fuzz")
}

fn folder() -> PathBuf {
    workspace::target().join("fuzz")
}

/// Fuzzes one target, and writes its corpus anew. Returns a line that tells the runs.
fn fuzz(program: &Path, target: &str, minutes: u32) -> Result<String, String> {
    let [corpus, merged, artifacts] = ["corpus", "merged", "artifacts"].map(|part| {
        let folder = folder().join(part).join(target);
        fs::create_dir_all(&folder).map(|()| folder).map_err(|error| error.to_string())
    });
    let (corpus, merged, artifacts) = (corpus?, merged?, artifacts?);
    host::run(&["unpack", target, &corpus.to_string_lossy()])?;
    let mut command = with_limits(program, target);
    command
        .arg(format!("-max_total_time={}", minutes.saturating_mul(60)))
        .arg("-print_final_stats=1");
    command.arg(format!("-artifact_prefix={}/", artifacts.display()));
    let Output { status, stderr, .. } = process::output(command.arg(&corpus))?;
    let said = String::from_utf8_lossy(&stderr).into_owned();
    if !status.success() {
        let log = folder().join(target).with_extension("log");
        fs::write(&log, &said).map_err(|error| error.to_string())?;
        let (input, log) = (artifacts.display(), log.display());
        return Err(format!(
            "{target}: {status}; the input is in {input}, what it said in {log}.\n\
             Make a test of the input in host-tests/tests/fuzz, then mend the cause."
        ));
    }
    let runs = said.lines().find_map(|line| line.strip_prefix("stat::number_of_executed_units:"));
    let runs = runs.ok_or_else(|| format!("{target}: the fuzzer said nothing"))?.trim();
    // Inputs that differ only in how often an edge runs are dropped: nine of ten.
    fs::remove_dir_all(&merged)
        .and_then(|()| fs::create_dir(&merged))
        .map_err(|e| e.to_string())?;
    let mut command = with_limits(program, target);
    command.args(["-set_cover_merge=1", "-use_counters=0"]).args([&merged, &corpus]);
    process::capture(&mut command)?;
    let kept = host::run(&["pack", target, &merged.to_string_lossy()])?;
    Ok(format!("{runs} runs, no finding; {} inputs kept", kept.trim()))
}

fn with_limits(program: &Path, target: &str) -> Command {
    let mut command = Command::new(program);
    command.env("MESHSWEEP_FUZZ", target).args([
        "-timeout=30",
        "-rss_limit_mb=4096",
        "-len_control=0",
    ]);
    command.arg(if target == "mesh" { LONGEST_FILE } else { LONGEST });
    command
}
