//! valgrind, where it is installed or to be had.

use std::ffi::OsStr;
use std::fs;
use std::path::Path;
use std::process::Command;

use crate::process;
use crate::toolbox::{Toolbox, Wanted};

const VALGRIND: Wanted = Wanted {
    name: "valgrind",
    alternatives: &[&["valgrind"]],
    ignore_installed: &["valgrind", "libc6-dbg"],
};

/// Where valgrind is.
pub enum Valgrind {
    /// On the path.
    Installed,
    /// From Debian's packages.
    Unpacked(Toolbox),
}

impl Valgrind {
    /// valgrind, or a line that says why it is skipped: counts are worth having, but no machine has
    /// to have them.
    pub fn find() -> Option<Self> {
        if process::on_path("valgrind") {
            return Some(Self::Installed);
        }
        match Toolbox::open(&VALGRIND) {
            Ok(toolbox) => Some(Self::Unpacked(toolbox)),
            Err(reason) => {
                say!("   skipped: no valgrind here, and none to be had: {reason}");
                None
            }
        }
    }

    /// A command that lacks its tool and what it runs.
    pub fn command(&self) -> Command {
        match self {
            Self::Installed => Command::new("valgrind"),
            Self::Unpacked(toolbox) => {
                let mut command = toolbox.command("valgrind");
                command.env("VALGRIND_LIB", toolbox.path("usr/libexec/valgrind"));
                let symbols = toolbox.path("usr/lib/debug");
                command.arg(format!("--extra-debuginfo-path={}", symbols.display()));
                command
            }
        }
    }

    /// Runs a program in callgrind, which writes its counters several times. What the program
    /// printed, and the instructions of each time. The folder is emptied for the profiles.
    pub fn dumps(
        &self,
        folder: &Path,
        options: &[String],
        program: &Path,
        arguments: &[&OsStr],
    ) -> Result<(String, Vec<f64>), String> {
        let failed = |error: std::io::Error| format!("{}: {error}", folder.display());
        if folder.exists() {
            fs::remove_dir_all(folder).map_err(failed)?;
        }
        fs::create_dir_all(folder).map_err(failed)?;
        let profile = folder.join("profile");
        let mut command = self.command();
        command.arg("--tool=callgrind").arg(format!("--callgrind-out-file={}", profile.display()));
        command.args(options).arg(program).args(arguments);
        let printed = process::capture(&mut command)?;
        let profiles = (1..).map_while(|index: usize| {
            fs::read_to_string(profile.with_extension(index.to_string())).ok()
        });
        let total = |text: String| {
            text.lines().find_map(|line| line.strip_prefix("totals: ")?.parse().ok())
        };
        let totals: Option<Vec<f64>> = profiles.map(total).collect();
        Ok((printed, totals.ok_or("callgrind counted nothing")?))
    }
}
