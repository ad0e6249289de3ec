//! Building firmware images.

use std::path::PathBuf;
use std::process::Command;

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
    // Each image tells the frame of each function: `call_graph` reads them. The option is not
    // stable; it adds a section to the file and nothing to the code.
    command.env("RUSTC_BOOTSTRAP", "1").env("CARGO_ENCODED_RUSTFLAGS", "-Zemit-stack-sizes");
    command.args(["--quiet", "--profile", profile.name()]);
    command
}

/// Where an image is.
#[must_use]
pub fn image(cross: &Cross, target: &str, profile: Profile, name: &str) -> PathBuf {
    workspace::target().join(cross.folder()).join(target).join(profile.name()).join(name)
}
