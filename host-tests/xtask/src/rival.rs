//! The images of `cargo xtask rival` and of triangle fans: how they are built, and that they build.

use std::path::PathBuf;
use std::process::Command;

use crate::boards::{BOARDS, Board};
use crate::cross::Cross;
use crate::tools::Tools;
use crate::{process, workspace};

/// The only one with a floating-point unit whose emulated board also has RAM enough for a heap.
pub const BOARD: Board = BOARDS[0];

/// `cargo SUBCOMMAND` for these images.
#[must_use]
pub fn cargo(cross: &Cross, subcommand: &str) -> Command {
    of_lab(cross, "rival", &BOARD, subcommand)
}

/// `cargo SUBCOMMAND` for the image that asks triangle fans on a board, and where `cargo build
/// --release` puts it.
#[must_use]
pub fn fans(cross: &Cross, board: &Board, subcommand: &str) -> (Command, PathBuf) {
    let image = target(cross, "fan").join(board.target).join("release/meshsweep-fan-firmware");
    (of_lab(cross, "fan", board, subcommand), image)
}

/// `cargo SUBCOMMAND` for the images of a folder of the laboratory.
fn of_lab(cross: &Cross, name: &str, board: &Board, subcommand: &str) -> Command {
    let mut command = cross.cargo(subcommand, &[board.target]);
    command
        .current_dir(workspace::root().join(format!("host-tests/lab/{name}-firmware")))
        .env("CARGO_TARGET_DIR", target(cross, name))
        .arg("--quiet");
    if matches!(cross, Cross::Debian { .. }) {
        // The later list counts: unlike our own images these allocate.
        command.arg("-Zbuild-std=core,alloc");
    }
    command
}

/// Apart from the firmware's: both build the same crates with other features.
#[must_use]
pub fn folder(cross: &Cross) -> PathBuf {
    target(cross, "rival")
}

fn target(cross: &Cross, name: &str) -> PathBuf {
    workspace::target().join(format!("{name}-{}", cross.folder()))
}

/// Builds the images of all engines, and that of fans, without optimisation, for they are not run.
///
/// # Errors
/// The compiler's, or the linker's.
pub fn builds(tools: &Tools) -> Result<(), String> {
    process::capture(cargo(&tools.cross, "build").arg("--bins"))?;
    process::capture(&mut fans(&tools.cross, &BOARD, "build").0).map(drop)
}
