//! The same bits on processors of workstations: other widths of words and of vectors.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

use crate::checks::cargo;
use crate::process;
use crate::steps::Steps;
use crate::toolbox::{Toolbox, Wanted};
use crate::workspace;

/// A build of the program that answers, and how it is run.
struct Processor {
    name: &'static str,
    /// rustup's name of it; `None`: this machine's own.
    target: Option<&'static str>,
    /// Flags of the compiler.
    flags: &'static str,
    /// QEMU's program that runs it, if this machine may not.
    emulator: Option<&'static str>,
}

const PROCESSORS: [Processor; 4] = [
    Processor { name: "this machine", target: None, flags: "", emulator: None },
    Processor {
        name: "this machine, all its vectors",
        target: None,
        flags: "-C target-cpu=native",
        emulator: None,
    },
    Processor {
        name: "i686",
        target: Some("i686-unknown-linux-musl"),
        flags: "",
        emulator: Some("qemu-i386"),
    },
    Processor {
        name: "AArch64",
        target: Some("aarch64-unknown-linux-musl"),
        flags: "",
        emulator: Some("qemu-aarch64"),
    },
];

const QEMU: Wanted =
    Wanted { name: "qemu-user", alternatives: &[&["qemu-user"]], ignore_installed: &["qemu-"] };

/// A download on a closed network may hang.
const LIMIT: Duration = Duration::from_secs(180);

/// Compares the answers about the committed blobs, optimised, with the committed answers.
pub fn run(steps: &mut Steps) {
    for processor in &PROCESSORS {
        let name = format!("{}: the committed bits, optimised", processor.name);
        steps.run(&name, || processor.compare());
    }
}

impl Processor {
    fn compare(&self) -> Result<(), String> {
        let fixtures = workspace::root().join("fixtures");
        let read = |name: &str| {
            std::fs::read_to_string(fixtures.join(name)).map_err(|error| format!("{name}: {error}"))
        };
        let expected = read("answers.txt")? + &read("kept/answers.txt")?;
        let program = self.build()?;
        let found = process::capture(self.command(&program)?.arg(&fixtures))?;
        match found.lines().zip(expected.lines()).find(|(here, there)| here != there) {
            Some((here, there)) => Err(format!("`{here}`, but committed is `{there}`")),
            None if found != expected => Err("more or fewer answers than are committed".to_owned()),
            None => Ok(()),
        }
    }

    /// The program, with no library but its own.
    fn build(&self) -> Result<PathBuf, String> {
        let mut command = cargo(&["build", "--quiet", "--profile", "dist", "--package"]);
        command.args(["meshsweep-counted", "--bin", "answers"]).env("RUSTFLAGS", self.flags);
        let mut folder = workspace::target().join("processors");
        if !self.flags.is_empty() {
            folder = folder.join("flags");
        }
        command.env("CARGO_TARGET_DIR", &folder);
        if let Some(target) = self.target {
            process::capture_within(Command::new("rustup").args(["target", "add", target]), LIMIT)?;
            let variable = target.replace('-', "_").to_uppercase();
            // The compiler's own linker: a machine need not have one for each target.
            command.env(format!("CARGO_TARGET_{variable}_LINKER"), "rust-lld");
            command.args(["--target", target]);
            folder = folder.join(target);
        }
        process::capture(&mut command)?;
        Ok(folder.join("dist/answers"))
    }

    fn command(&self, program: &Path) -> Result<Command, String> {
        match self.emulator {
            None => Ok(Command::new(program)),
            Some(emulator) if process::on_path(emulator) => {
                let mut command = Command::new(emulator);
                command.arg(program);
                Ok(command)
            }
            Some(emulator) => {
                let mut command = Toolbox::open(&QEMU)?.command(emulator);
                command.arg(program);
                Ok(command)
            }
        }
    }
}
