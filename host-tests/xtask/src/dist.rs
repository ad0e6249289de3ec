//! Archives of the C interface, one a target: library, header, packages, README and licences. Shell
//! completions and man pages of the program.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::c_library::{self, CTools, HOST};
use crate::checks::cargo;
use crate::cross::Cross;
use crate::images::Profile;
use crate::process;
use crate::steps::Steps;
use crate::{c_checks, host, workspace};

const TARGETS: [&str; 6] = [
    "thumbv6m-none-eabi",
    "thumbv7em-none-eabi",
    "thumbv7em-none-eabihf",
    "thumbv8m.main-none-eabihf",
    "riscv32imac-unknown-none-elf",
    HOST,
];

/// Programs whose code is measured: a name, and the functions that they call.
const PROGRAMS: [(&str, &[&str]); 5] = [
    ("open", &["msw_open"]),
    ("closest", &["msw_open", "msw_closest_point"]),
    ("hit", &["msw_open", "msw_first_hit"]),
    (
        "four",
        &["msw_open", "msw_closest_point", "msw_first_hit", "msw_within", "msw_signed_distance"],
    ),
    ("tight", &["msw_open_tight", "msw_tight_within"]),
];

/// Folders and files of the interface that an archive has.
const PACKED: [&str; 6] = ["include", "examples", "cmake", "zephyr", "CMakeLists.txt", "README.md"];

/// What is wanted of the program's completions and man pages.
const MANUAL: &str = "manual";

/// Writes archives of the wanted targets, or the program's `MANUAL` (all, if none is wanted),
/// into `target/dist`. Prints the bytes of programs with the libraries.
pub fn run(steps: &mut Steps, wanted: &[&str]) {
    if wanted.is_empty() || wanted.contains(&MANUAL) {
        steps.run("completions and man pages", manual);
    }
    if wanted == [MANUAL] {
        return;
    }
    let wanted: Vec<&str> = wanted.iter().copied().filter(|&target| target != MANUAL).collect();
    let Some(cross) = steps.run("setup: std for the boards", Cross::find) else { return };
    let Some(c) = steps.run("setup: arm-none-eabi-gcc, cppcheck", CTools::find) else { return };
    let mut rows = Vec::new();
    if let Some(unknown) = wanted.iter().find(|target| !TARGETS.contains(target)) {
        let known = TARGETS.join(", ");
        steps.run("targets", || Err::<(), _>(format!("no target `{unknown}`; there are {known}")));
        return;
    }
    for target in TARGETS.into_iter().filter(|target| wanted.is_empty() || wanted.contains(target))
    {
        rows.extend(steps.run(target, || archive(&cross, &c, target)).into_iter().flatten());
    }
    let names: Vec<&str> = PROGRAMS.iter().map(|(name, _)| *name).collect();
    say!("\nbytes of code and constants of a program that calls nothing else");
    say!("| target | opt-level | {} | all |", names.join(" | "));
    for row in rows {
        say!("| {} |", row.join(" | "));
    }
}

/// Completions for shells and man pages, in a folder.
fn manual() -> Result<(), String> {
    let folder = workspace::target().join("dist/meshsweep-manual");
    let _ = fs::remove_dir_all(&folder);
    let mut command = cargo(&["run", "--quiet", "--package", "meshsweep-manual", "--"]);
    process::capture(command.arg(&folder))?;
    say!("   {}", folder.display());
    Ok(())
}

fn archive(cross: &Cross, c: &CTools, target: &str) -> Result<Vec<Vec<String>>, String> {
    cross.add(target)?;
    let name = format!("meshsweep-c-{}-{target}", env!("CARGO_PKG_VERSION"));
    let dist = workspace::target().join("dist");
    let folder = dist.join(&name);
    let _ = fs::remove_dir_all(&folder);
    make(&folder.join("lib"))?;
    let mut rows = Vec::new();
    // For a workstation size does not matter.
    let profiles = if target == HOST { &[Profile::Release][..] } else { &Profile::ALL };
    for &profile in profiles {
        let library = c_library::build(cross, c, target, profile)?;
        let (file, level) = match profile {
            Profile::Small => ("libmeshsweep_small.a", "s"),
            _ => ("libmeshsweep.a", "3"),
        };
        if target != HOST {
            rows.push(row(c, target, level, &library)?);
        }
        copy(&library, &folder.join("lib").join(file))?;
    }
    for part in PACKED {
        copy_all(&c_library::folder().join(part), &folder.join(part))?;
    }
    for licence in ["LICENSE-APACHE", "LICENSE-MIT"] {
        copy(&workspace::root().join(licence), &folder.join(licence))?;
    }
    // No date and no user, so that the same sources give the same bytes.
    let mut tar = Command::new("tar");
    tar.args(["--sort=name", "--mtime=@0", "--owner=0", "--group=0", "--numeric-owner"]);
    tar.args(["--mode=u=rwX,go=rX", "--use-compress-program=gzip -n", "--create", "--file"]);
    tar.arg(format!("{name}.tar.gz")).arg(&name);
    process::capture(tar.current_dir(&dist))?;
    say!("   {}", dist.join(format!("{name}.tar.gz")).display());
    if target == HOST {
        say!("   compares its answers with Rust's, whose program takes a while to build");
        let library = folder.join("lib/libmeshsweep.a");
        c_checks::programs_on_host(&library, &host::run(&["c-answers"])?)?;
    }
    Ok(rows)
}

fn row(c: &CTools, target: &str, level: &str, library: &Path) -> Result<Vec<String>, String> {
    let mut row = vec![target.to_owned(), level.to_owned()];
    for (_, functions) in PROGRAMS {
        row.push(c_library::bytes(c, target, library, functions)?.to_string());
    }
    let all = c_library::functions()?;
    let all: Vec<&str> = all.iter().map(String::as_str).collect();
    row.push(c_library::bytes(c, target, library, &all)?.to_string());
    Ok(row)
}

fn make(folder: &Path) -> Result<(), String> {
    fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))
}

fn copy(from: &Path, to: &Path) -> Result<(), String> {
    let copied = fs::copy(from, to).map(drop);
    copied.map_err(|error| format!("{} to {}: {error}", from.display(), to.display()))
}

fn copy_all(from: &Path, to: &Path) -> Result<(), String> {
    if !from.is_dir() {
        return copy(from, to);
    }
    make(to)?;
    let entries = fs::read_dir(from).map_err(|error| format!("{}: {error}", from.display()))?;
    let files: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    for file in files {
        let name = file.file_name().ok_or_else(|| format!("{}: no name", file.display()))?;
        copy_all(&file, &to.join(name))?;
    }
    Ok(())
}
