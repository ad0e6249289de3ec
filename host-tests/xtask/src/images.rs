//! Building firmware images.

use std::fs;
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

/// Builds the image `name` of the suite, carrying `blob`, for several targets at once; a copy of
/// each, which the next blob leaves alone.
///
/// # Errors
/// The compiler's.
pub fn suite(
    cross: &Cross,
    targets: &[&str],
    profile: Profile,
    name: &str,
    blob: &Path,
) -> Result<Vec<PathBuf>, String> {
    let mut command = cargo(cross, "build", targets, profile);
    process::capture(command.args(["--bin", name]).env("MESHSWEEP_BLOB", blob))?;
    let stem = blob.file_stem().unwrap_or_default().to_string_lossy();
    let folder = workspace::target().join(cross.folder()).join("images");
    fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let copied = targets.iter().map(|target| {
        let kept = folder.join(format!("{target}-{stem}"));
        fs::copy(image(cross, target, profile, name), &kept)
            .map_err(|error| format!("{}: {error}", kept.display()))?;
        Ok(kept)
    });
    copied.collect()
}

/// Lints the images.
///
/// # Errors
/// The lints.
pub fn lint(cross: &Cross, targets: &[&str], blob: &Path) -> Result<(), String> {
    let mut command = cargo(cross, "clippy", targets, Profile::Release);
    process::capture(command.env("MESHSWEEP_BLOB", blob).args(["--", "-D", "warnings"])).map(drop)
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
    command.args(["--quiet", "--profile", profile.name()]);
    command
}

/// Where an image is.
#[must_use]
pub fn image(cross: &Cross, target: &str, profile: Profile, name: &str) -> PathBuf {
    workspace::target().join(cross.folder()).join(target).join(profile.name()).join(name)
}
