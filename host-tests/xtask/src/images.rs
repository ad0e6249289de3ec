//! Building firmware images.

use std::path::PathBuf;
use std::process::Command;

use crate::boards::Board;
use crate::cross::Cross;
use crate::process;
use crate::workspace;

/// How an image is optimised.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Profile {
    /// `opt-level = 3`.
    Release,
    /// `opt-level = "s"`.
    Small,
    /// A debug build of firmware whose core is compiled at `opt-level = "s"`.
    Overridden,
    /// A debug build.
    Unoptimised,
}

impl Profile {
    /// Those of firmware that is shipped.
    pub const ALL: [Self; 2] = [Self::Release, Self::Small];

    /// Those of debug builds.
    pub const DEBUG: [Self; 2] = [Self::Overridden, Self::Unoptimised];

    /// cargo's name for it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Release => "release",
            Self::Small => "small",
            Self::Overridden => "overridden",
            Self::Unoptimised => "unoptimised",
        }
    }
}

/// Each image tells the frame of each function: `call_graph` reads them. The option is not stable; it
/// adds a section to the file and nothing to the code.
const FLAGS: &str = "-Zemit-stack-sizes";

/// Builds images that run, for several targets at once.
///
/// # Errors
/// The compiler's.
pub fn running(
    cross: &Cross,
    targets: &[&str],
    profile: Profile,
    names: &[&str],
) -> Result<(), String> {
    let mut command = cargo(cross, "build", targets, profile);
    for name in names {
        command.args(["--bin", name]);
    }
    process::capture(&mut command).map(drop)
}

/// Builds an image for one board, with what the compiler is told of the board; its path.
///
/// # Errors
/// The compiler's.
pub fn of_board(
    cross: &Cross,
    board: &Board,
    profile: Profile,
    name: &str,
) -> Result<PathBuf, String> {
    if board.flags.is_empty() {
        running(cross, &[board.target], profile, &[name])?;
        return Ok(image(cross, board.target, profile, name));
    }
    // A folder of its own: other flags would rebuild all in the shared one.
    let folder = workspace::target().join(cross.folder()).join(board.machine.name());
    let mut command = cargo(cross, "build", &[board.target], profile);
    let flags = [FLAGS].iter().chain(board.flags).copied().collect::<Vec<_>>().join("\u{1f}");
    command.env("CARGO_TARGET_DIR", &folder).env("CARGO_ENCODED_RUSTFLAGS", flags);
    process::capture(command.args(["--bin", name]))?;
    Ok(folder.join(board.target).join(profile.name()).join(name))
}

/// Lints the images.
///
/// # Errors
/// The lints.
pub fn lint(cross: &Cross, targets: &[&str]) -> Result<(), String> {
    let mut command = cargo(cross, "clippy", targets, Profile::Release);
    process::capture(command.args(["--", "-D", "warnings"])).map(drop)
}

/// Builds the images whose size is measured.
///
/// # Errors
/// The compiler's.
pub fn sizes(
    cross: &Cross,
    targets: &[&str],
    profile: Profile,
    names: &[&str],
) -> Result<(), String> {
    let mut command = cargo(cross, "build", targets, profile);
    // Whether a panic is left is the proof's business: it must not keep the sizes from being known.
    command.args(["--features", "name_panics"]);
    for name in names {
        command.args(["--bin", name]);
    }
    process::capture(&mut command).map(drop)
}

/// `cargo SUBCOMMAND` for the firmware, with nothing said of which images.
#[must_use]
pub fn cargo(cross: &Cross, subcommand: &str, targets: &[&str], profile: Profile) -> Command {
    let mut command = cross.cargo(subcommand, targets);
    command
        .current_dir(workspace::firmware())
        .env("CARGO_TARGET_DIR", workspace::target().join(cross.folder()));
    command.env("RUSTC_BOOTSTRAP", "1").env("CARGO_ENCODED_RUSTFLAGS", FLAGS);
    command.args(["--quiet", "--profile", profile.name()]);
    command
}

/// Where an image is.
#[must_use]
pub fn image(cross: &Cross, target: &str, profile: Profile, name: &str) -> PathBuf {
    workspace::target().join(cross.folder()).join(target).join(profile.name()).join(name)
}
