//! `cargo xtask python`: the Python package. Its wheel, its types, its tests.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::checks::cargo;
use crate::process;
use crate::steps::Steps;
use crate::toolbox::{Toolbox, Wanted};
use crate::workspace;

/// pip, for a Python without the module that brings it.
const PIP: Wanted =
    Wanted { name: "pip", alternatives: &[&["python3-pip-whl"]], ignore_installed: &[] };

/// What builds, checks and tests the package.
const PACKAGES: [&str; 8] = [
    "maturin>=1.8,<2",
    "numpy",
    "pytest>=8",
    "trimesh",
    "tqdm",
    "mypy>=1.11",
    "ruff>=0.8",
    "dask[distributed]",
];

/// What the package is raced against.
const RIVALS: [&str; 5] = ["libigl", "python-fcl", "coal", "rtree", "scipy"];

/// The package of the program that times a batch without Python.
const LAB: &str = "meshsweep-lab";

/// Races the package against others of PyPI on these meshes.
pub fn race(steps: &mut Steps, meshes: &[&str]) {
    let Some(python) = steps.run("Python: an environment", environment) else { return };
    let ready = steps.run("Python: the wheel, and packages to race", || {
        wheel(&python)?;
        process::run(pip(&python).args(RIVALS))
    });
    let lab = steps.run("the laboratory", || {
        process::run(&mut cargo(&["build", "--quiet", "--profile", "dist", "--package", LAB]))
    });
    if ready.is_some() && lab.is_some() {
        steps.run("Python: race", || {
            let mut command = Command::new(&python);
            command.arg(workspace::root().join("host-tests/lab/src/race/packages.py")).args(meshes);
            command.env("MESHSWEEP_LAB", workspace::target().join("dist/meshsweep-lab"));
            for threads in ["RAYON_NUM_THREADS", "IGL_NUM_THREADS", "OMP_NUM_THREADS"] {
                command.env(threads, "1");
            }
            process::run(&mut command)
        });
    }
}

/// Builds the wheel into `target/dist`, installs it aside, and runs the package's tests.
pub fn run(steps: &mut Steps) {
    let Some(python) = steps.run("Python: an environment", environment) else { return };
    lints(steps);
    let built = steps.run("Python: the wheel", || wheel(&python));
    for (title, tool) in [
        ("Python: style", &["ruff", "check", "--quiet", "."][..]),
        ("Python: formatting", &["ruff", "format", "--quiet", "--check", "."]),
        ("Python: types", &["mypy", "--no-error-summary"]),
    ] {
        steps.run(title, || process::run(&mut module(&python, tool)));
    }
    if built.is_some() {
        steps.run("Python: the stub of the Rust half", || {
            process::run(&mut module(
                &python,
                &["mypy.stubtest", "--concise", "meshsweep._meshsweep"],
            ))
        });
        steps.run("Python: tests", || {
            process::run(&mut module(
                &python,
                &["pytest", "--quiet", "-p", "no:cacheprovider", "tests"],
            ))
        });
    }
}

/// Formatting and lints of the package's Rust, which need no Python.
pub fn lints(steps: &mut Steps) {
    let manifest = folder().join("Cargo.toml").to_string_lossy().into_owned();
    let lint =
        ["clippy", "--quiet", "--locked", "--manifest-path", &manifest, "--", "-D", "warnings"];
    for (title, words) in [
        ("Python: formatting of Rust", &["fmt", "--check", "--manifest-path", &manifest][..]),
        ("Python: lints of Rust", &lint),
    ] {
        steps.run(title, || {
            let mut command = cargo(words);
            command.env("CARGO_TARGET_DIR", workspace::target().join("python"));
            // An extension links no library of Python, so none has to be there.
            command.env("PYO3_NO_PYTHON", "1").env("PYO3_BUILD_EXTENSION_MODULE", "1");
            process::run(&mut command)
        });
    }
}

/// A module of the environment, run in the package's folder.
fn module(python: &Path, words: &[&str]) -> Command {
    let mut command = Command::new(python);
    command.arg("-m").args(words).current_dir(folder());
    // The folder of the sources has no caches, and the installed package is the one that is tested.
    command.env("PYTHONDONTWRITEBYTECODE", "1").env("RUFF_NO_CACHE", "true");
    command.env("MYPY_CACHE_DIR", workspace::target().join("python/mypy"));
    command
}

fn folder() -> PathBuf {
    workspace::root().join("alloc-ext/python")
}

/// The interpreter of an environment with all packages.
fn environment() -> Result<PathBuf, String> {
    if !process::on_path("python3") {
        return Err("no `python3` on the path: apt-get install python3".to_owned());
    }
    let place = workspace::target().join("python/environment");
    let python = place.join("bin/python");
    if !python.is_file() {
        let venv = |words: &[&str]| {
            let mut command = Command::new("python3");
            process::capture(command.args(["-m", "venv", "--clear"]).args(words).arg(&place))
        };
        if venv(&[]).is_err() {
            venv(&["--without-pip"])?;
            let mut command = Command::new(&python);
            command.arg(pip_wheel()?.join("pip")).args(["install", "--quiet", "pip"]);
            process::run(&mut command)?;
        }
    }
    process::run(pip(&python).args(PACKAGES)).map(|()| python)
}

/// Installs what is named behind it.
fn pip(python: &Path) -> Command {
    let mut command = Command::new(python);
    command.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check"]);
    command
}

/// Debian's wheel of pip, which runs without being installed.
fn pip_wheel() -> Result<PathBuf, String> {
    let wheels = Toolbox::open(&PIP)?.path("usr/share/python-wheels");
    let entries =
        fs::read_dir(&wheels).map_err(|error| format!("{}: {error}", wheels.display()))?;
    let is_pip = |name: &std::ffi::OsStr| name.to_string_lossy().starts_with("pip-");
    let mut found = entries.flatten().filter(|entry| is_pip(&entry.file_name()));
    found.next().map(|entry| entry.path()).ok_or_else(|| "Debian's package has no pip".to_owned())
}

/// Builds the wheel, and installs it in place of an older one.
fn wheel(python: &Path) -> Result<(), String> {
    let dist = workspace::target().join("dist");
    for entry in fs::read_dir(&dist).into_iter().flatten().flatten() {
        if entry.path().extension().is_some_and(|extension| extension == "whl") {
            fs::remove_file(entry.path()).map_err(|error| error.to_string())?;
        }
    }
    let out = dist.to_string_lossy().into_owned();
    let mut build =
        module(python, &["maturin", "build", "--release", "--locked", "--quiet", "--out"]);
    build.arg(&out).env("CARGO_TARGET_DIR", workspace::target().join("python"));
    process::run(&mut build)?;
    let install = ["pip", "install", "--quiet", "--force-reinstall", "--no-deps", "--no-index"];
    let mut install = module(python, &install);
    process::run(install.args(["--find-links", &out, "meshsweep"]))
}
