//! cargo for targets that have no operating system.
//!
//! rustup's ready-made std where it can be had, else Debian's compiler, which builds `core` from
//! the sources it is packaged with. Both compile the same arithmetic: the hashes that the images
//! print do not depend on the choice.

use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

use crate::boards::BOARDS;
use crate::process;
use crate::toolbox::{Toolbox, Wanted};

const RUST: Wanted = Wanted {
    name: "rust",
    // `rustc-web` is the recent compiler that Debian keeps for its browsers; the plain one may be
    // older than our MSRV. The linker of the same LLVM where there is one.
    alternatives: &[
        &["rustc-web", "cargo-web", "rust-web-src", "lld-22"],
        &["rustc-web", "cargo-web", "rust-web-src", "lld"],
    ],
    ignore_installed: &["rustc", "cargo", "rust-", "libstd-rust", "rustup", "lld", "libllvm"],
};

/// A download on a closed network may hang.
const LIMIT: Duration = Duration::from_secs(180);

/// A compiler with std for all boards.
#[derive(Clone, Debug)]
pub enum Cross {
    /// The toolchain in use has the targets.
    Installed,
    /// Debian's compiler with this linker.
    #[allow(missing_docs, reason = "the line above names both")]
    Debian { rust: Toolbox, linker: PathBuf },
}

impl Cross {
    /// Makes sure of std for all boards.
    pub fn find() -> Result<Self, String> {
        match env::var("MESHSWEEP_STD").as_deref() {
            Ok("rustup") => Self::installed(),
            Ok("debian") => Self::debian(),
            Ok(other) => Err(format!("MESHSWEEP_STD is `{other}`, not `rustup` or `debian`")),
            Err(_) => Self::installed().or_else(|reason| {
                say!("   no std from rustup: {}", reason.lines().next().unwrap_or_default());
                Self::debian().map_err(|other| {
                    format!(
                        "{other}\nremedy: `rustup target add {}` where the network lets it",
                        targets().join(" ")
                    )
                })
            }),
        }
    }

    fn installed() -> Result<Self, String> {
        let sysroot = sysroot()?;
        let missing: Vec<_> =
            targets().into_iter().filter(|target| !has_std(&sysroot, target)).collect();
        if !missing.is_empty() {
            if !process::on_path("rustup") {
                return Err(format!("no std for {} and no rustup", missing.join(", ")));
            }
            process::capture_within(
                Command::new("rustup").args(["target", "add"]).args(&missing),
                LIMIT,
            )?;
        }
        match targets().into_iter().find(|target| !has_std(&sysroot, target)) {
            Some(target) => Err(format!("rustup added no std for {target}")),
            None => {
                say!("   std of {}", own_version()?);
                Ok(Self::Installed)
            }
        }
    }

    fn debian() -> Result<Self, String> {
        let rust = Toolbox::open(&RUST)?;
        let sources = rust.path("usr/lib/rustlib/src/rust/library/core/Cargo.toml");
        if !sources.is_file() {
            return Err(format!("Debian's compiler came without {}", sources.display()));
        }
        let cross = Self::Debian { linker: linker(&rust)?, rust };
        say!("   std built by {}", cross.version()?);
        Ok(cross)
    }

    /// What the compiler of the images calls itself.
    ///
    /// # Errors
    /// It cannot be asked.
    pub fn version(&self) -> Result<String, String> {
        match self {
            Self::Installed => own_version(),
            Self::Debian { rust, .. } => {
                let version = process::capture(rust.command("rustc").arg("-V"))?;
                Ok(version.trim().to_owned())
            }
        }
    }

    /// Makes sure of std for a target that is no board's. Debian's compiler builds it.
    pub fn add(&self, target: &str) -> Result<(), String> {
        if matches!(self, Self::Debian { .. }) { Ok(()) } else { add_std(target) }
    }

    /// `cargo SUBCOMMAND --target TARGET...`, at home in the firmware's workspace.
    #[must_use]
    pub fn cargo(&self, subcommand: &str, targets: &[&str]) -> Command {
        let mut command = match self {
            Self::Installed => Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into())),
            Self::Debian { rust, linker } => {
                let mut command = rust.command("cargo");
                // What the outer cargo set for its own toolchain.
                for variable in ["RUSTUP_TOOLCHAIN", "CARGO", "RUSTC_WRAPPER"] {
                    command.env_remove(variable);
                }
                command.env("RUSTC", rust.path("usr/bin/rustc"));
                // Building std is not stable yet, and there is no other way to it without rustup.
                command.env("RUSTC_BOOTSTRAP", "1");
                for target in targets {
                    let variable = target.replace(['-', '.'], "_").to_uppercase();
                    command.env(format!("CARGO_TARGET_{variable}_LINKER"), linker);
                }
                command
            }
        };
        // Flags for the host, such as a target CPU, would be wrong here.
        command.env_remove("RUSTFLAGS").env_remove("CARGO_ENCODED_RUSTFLAGS");
        command.arg(subcommand);
        for target in targets {
            command.args(["--target", target]);
        }
        if matches!(self, Self::Debian { .. }) {
            command.arg("-Zbuild-std=core");
        }
        command
    }

    /// LLVM's linker for images without an operating system.
    pub fn linker(&self) -> Result<Command, String> {
        match self {
            Self::Installed => {
                let programs = sysroot()?.join("lib/rustlib");
                let found = std::fs::read_dir(&programs).into_iter().flatten().flatten();
                let mut found = found.map(|target| target.path().join("bin/rust-lld"));
                let linker = found.find(|path| path.is_file()).ok_or("no rust-lld")?;
                let mut command = Command::new(linker);
                command.args(["-flavor", "gnu"]);
                Ok(command)
            }
            Self::Debian { rust, linker } => {
                let name = linker.file_name().and_then(|name| name.to_str());
                Ok(rust.command(name.ok_or("the linker has no name")?))
            }
        }
    }

    /// Whether the toolchain has its lints for the boards: Debian's compiler comes without.
    pub const fn has_clippy(&self) -> bool {
        matches!(self, Self::Installed)
    }

    /// Where the images of this compiler go: two compilers in one folder would rebuild each other's
    /// work.
    pub const fn folder(&self) -> &'static str {
        match self {
            Self::Installed => "firmware",
            Self::Debian { .. } => "firmware-debian",
        }
    }
}

fn targets() -> Vec<&'static str> {
    BOARDS.iter().map(|board| board.target).collect()
}

/// What the compiler in use calls itself.
///
/// # Errors
/// It cannot be asked.
pub fn own_version() -> Result<String, String> {
    Ok(process::capture(Command::new("rustc").arg("-V"))?.trim().to_owned())
}

/// The folder of the toolchain in use.
///
/// # Errors
/// It cannot be asked.
pub fn sysroot() -> Result<PathBuf, String> {
    let printed = process::capture(Command::new("rustc").args(["--print", "sysroot"]))?;
    Ok(PathBuf::from(printed.trim()))
}

/// Makes sure that the toolchain in use has std for a target.
///
/// # Errors
/// There is no rustup, or it has none.
pub fn add_std(target: &str) -> Result<(), String> {
    if has_std(&sysroot()?, target) {
        return Ok(());
    }
    if !process::on_path("rustup") {
        return Err(format!("no std for {target} and no rustup: `rustup target add {target}`"));
    }
    process::capture_within(Command::new("rustup").args(["target", "add", target]), LIMIT).map(drop)
}

fn has_std(sysroot: &Path, target: &str) -> bool {
    sysroot.join("lib/rustlib").join(target).join("lib").is_dir()
}

/// The linker for bare ELF images that came with the compiler; its name carries LLVM's version.
fn linker(rust: &Toolbox) -> Result<PathBuf, String> {
    let programs = std::fs::read_dir(rust.path("usr/bin")).into_iter().flatten().flatten();
    programs
        .map(|entry| entry.path())
        .find(|path| {
            path.file_name().is_some_and(|name| name.to_string_lossy().starts_with("ld.lld"))
        })
        .ok_or_else(|| "Debian's lld came without ld.lld".to_owned())
}
