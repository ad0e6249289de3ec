//! Building firmware images.

use std::path::{Path, PathBuf};
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
}

impl Profile {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Release, Self::Small];

    /// cargo's name for it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Release => "release",
            Self::Small => "small",
        }
    }
}

/// Builds the image `name` of the suite, carrying `blob`; its path.
pub fn suite(
    cross: &Cross,
    target: &str,
    profile: Profile,
    name: &str,
    blob: &Path,
) -> Result<PathBuf, String> {
    let mut command = cargo(cross, "build", target, profile);
    process::capture(command.args(["--bin", name]).env("MESHSWEEP_BLOB", blob))?;
    Ok(image(cross, target, profile, name))
}

/// Lints the images.
pub fn lint(cross: &Cross, target: &str, blob: &Path) -> Result<(), String> {
    let mut command = cargo(cross, "clippy", target, Profile::Release);
    process::capture(command.env("MESHSWEEP_BLOB", blob).args(["--", "-D", "warnings"])).map(drop)
}

/// Builds the images whose size is measured; their paths, in the order of their names.
pub fn sizes(
    cross: &Cross,
    target: &str,
    profile: Profile,
    names: &[&str],
) -> Result<Vec<PathBuf>, String> {
    let mut command = cargo(cross, "build", target, profile);
    // Whether a panic is left is the proof's business: it must not keep the sizes from being known.
    command.args(["--features", "name_panics"]);
    for name in names {
        command.args(["--bin", name]);
    }
    process::capture(&mut command)?;
    Ok(names.iter().map(|name| image(cross, target, profile, name)).collect())
}

/// `cargo SUBCOMMAND` for the firmware, with nothing said of which images.
pub fn cargo(cross: &Cross, subcommand: &str, target: &str, profile: Profile) -> Command {
    let mut command = cross.cargo(subcommand, target);
    command
        .current_dir(workspace::firmware())
        .env("CARGO_TARGET_DIR", workspace::target().join(cross.folder()));
    command.args(["--quiet", "--profile", profile.name()]);
    command
}

/// Where an image is.
pub fn image(cross: &Cross, target: &str, profile: Profile, name: &str) -> PathBuf {
    workspace::target().join(cross.folder()).join(target).join(profile.name()).join(name)
}
