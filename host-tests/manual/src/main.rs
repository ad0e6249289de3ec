//! Writes shell completions and man pages of the program into a folder, from the program's own
//! command line. `cargo xtask dist manual` runs this.

use clap_complete::Shell;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

#[allow(dead_code, unused_imports, reason = "the program uses all of its command line")]
#[path = "../../../alloc-ext/src/bin/meshsweep/args/mod.rs"]
mod args;

/// The program's name.
const NAME: &str = "meshsweep";

fn main() -> ExitCode {
    let Some(folder) = std::env::args_os().nth(1).map(PathBuf::from) else {
        eprintln!("usage: meshsweep-manual FOLDER");
        return ExitCode::from(2);
    };
    match write(&folder) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{}: {error}", folder.display());
            ExitCode::FAILURE
        }
    }
}

/// Writes `completions/` and `man1/`.
fn write(folder: &Path) -> std::io::Result<()> {
    let [completions, pages] = ["completions", "man1"].map(|name| folder.join(name));
    fs::create_dir_all(&completions)?;
    fs::create_dir_all(&pages)?;
    for shell in [Shell::Bash, Shell::Zsh, Shell::Fish, Shell::PowerShell, Shell::Elvish] {
        clap_complete::generate_to(shell, &mut args::command(), NAME, &completions)?;
    }
    clap_mangen::generate_to(args::command(), &pages)
}
