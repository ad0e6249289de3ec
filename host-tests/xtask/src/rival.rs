//! The images of `cargo xtask rival`: how they are built, and that they build.

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
    let mut command = cross.cargo(subcommand, &[BOARD.target]);
    command
        .current_dir(workspace::root().join("host-tests/lab/rival-firmware"))
        .env("CARGO_TARGET_DIR", folder(cross))
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
    workspace::target().join(format!("rival-{}", cross.folder()))
}

/// Builds the images of all engines without optimisation, for they are not run.
///
/// # Errors
/// The compiler's, or the linker's.
pub fn builds(tools: &Tools) -> Result<(), String> {
    process::capture(cargo(&tools.cross, "build").arg("--bins")).map(drop)
}
