//! valgrind, where it is installed or to be had.

use std::process::Command;

use crate::process;
use crate::toolbox::{Toolbox, Wanted};

const VALGRIND: Wanted =
    Wanted { name: "valgrind", alternatives: &[&["valgrind"]], ignore_installed: &["valgrind", "libc6-dbg"] };

/// Where valgrind is.
pub enum Valgrind {
    Installed,
    Unpacked(Toolbox),
}

impl Valgrind {
    /// valgrind, or a line that says why it is skipped: counts are worth having, but no machine has to have them.
    pub fn find() -> Option<Self> {
        if process::on_path("valgrind") {
            return Some(Self::Installed);
        }
        match Toolbox::open(&VALGRIND) {
            Ok(toolbox) => Some(Self::Unpacked(toolbox)),
            Err(reason) => {
                println!("   skipped: no valgrind here, and none to be had: {reason}");
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
}
