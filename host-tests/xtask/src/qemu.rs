//! The emulator.

use std::path::Path;
use std::process::Command;
use std::time::Duration;

use crate::process;
use crate::toolbox::{Toolbox, Wanted};

/// An emulated machine, by QEMU's name for it.
#[derive(Clone, Copy, Debug)]
pub enum Machine {
    /// Of `qemu-system-arm`.
    Arm(&'static str),
    /// Of `qemu-system-riscv32`.
    Riscv32(&'static str),
}

impl Machine {
    /// QEMU's name for it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Arm(name) | Self::Riscv32(name) => name,
        }
    }

    const fn program(self) -> &'static str {
        match self {
            Self::Arm(_) => "qemu-system-arm",
            Self::Riscv32(_) => "qemu-system-riscv32",
        }
    }
}

const WANTED: Wanted = Wanted {
    name: "qemu",
    // Debian 13 has a package for RISC-V; before, it is among the rest.
    alternatives: &[
        &["qemu-system-arm", "qemu-system-riscv"],
        &["qemu-system-arm", "qemu-system-misc"],
    ],
    ignore_installed: &["qemu-"],
};

/// No image needs a tenth of it.
const LIMIT: Duration = Duration::from_secs(300);

/// Where QEMU is.
#[derive(Clone, Debug)]
pub enum Qemu {
    /// Installed.
    OnPath,
    /// From Debian's packages.
    Unpacked(Toolbox),
}

impl Qemu {
    /// QEMU for both families of processors: the machine's own, else Debian's.
    pub fn find() -> Result<Self, String> {
        let qemu = if ["qemu-system-arm", "qemu-system-riscv32"].into_iter().all(process::on_path) {
            Self::OnPath
        } else {
            let toolbox = Toolbox::open(&WANTED);
            Self::Unpacked(toolbox.map_err(|error| {
                format!("{error}\nremedy: put qemu-system-arm and qemu-system-riscv32 on the PATH, or let apt-get reach Debian")
            })?)
        };
        for machine in [Machine::Arm(""), Machine::Riscv32("")] {
            let version = process::capture(qemu.command(machine).arg("--version"))?;
            say!("   {}", version.lines().next().unwrap_or_default());
        }
        Ok(qemu)
    }

    /// Runs an image to its end: what it printed. An image that exits with another status than 0 is
    /// an error. The bytes of a file may lie in memory from an address on.
    pub fn run(
        &self,
        machine: Machine,
        image: &Path,
        loaded: Option<(&Path, u32)>,
    ) -> Result<String, String> {
        let mut command = self.command(machine);
        command.args(["-M", machine.name(), "-nographic", "-monitor", "none", "-serial", "none"]);
        // One nanosecond of the board's time an instruction: counters become instruction counts,
        // and runs repeat exactly. A processor that sleeps wakes at once.
        command.args(["-icount", "shift=0,sleep=off"]);
        command.args(["-semihosting-config", "enable=on,target=native"]);
        if matches!(machine, Machine::Riscv32(_)) {
            command.args(["-bios", "none"]);
        }
        if let Some((file, address)) = loaded {
            // A comma in a file's name is doubled.
            let file = file.to_string_lossy().replace(',', ",,");
            let loader = format!("loader,file={file},addr={address:#x},force-raw=on");
            command.args(["-device", &loader]);
        }
        process::capture_within(command.arg("-kernel").arg(image), LIMIT)
    }

    fn command(&self, machine: Machine) -> Command {
        match self {
            Self::OnPath => Command::new(machine.program()),
            Self::Unpacked(toolbox) => {
                let mut command = toolbox.command(machine.program());
                command.arg("-L").arg(toolbox.path("usr/share/qemu"));
                command
            }
        }
    }
}
