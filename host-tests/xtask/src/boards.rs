//! The boards that the images run on.

use crate::qemu::Machine;

/// A target, the machine that runs it, and what its counter counts.
#[derive(Clone, Copy, Debug)]
pub struct Board {
    /// The processor's name in tables.
    pub cpu: &'static str,
    /// The target triple.
    pub target: &'static str,
    /// The emulated machine.
    pub machine: Machine,
    /// Instructions a tick of the image's counter: the emulator takes 1 ns an instruction, SysTick
    /// runs at the board's clock.
    pub instructions_per_tick: f64,
    /// How big a blob it can hold.
    pub flash: Flash,
    /// Whether its processor computes with floats; else a product is fifty instructions.
    pub has_floats: bool,
    /// What the compiler is told beside the target.
    pub flags: &'static [&'static str],
    /// Where the images `ask` and `robot` find their questions: the board's external RAM.
    pub loaded: u32,
}

/// A processor with a unit for f64. No test asks it: `cargo xtask measure --robot DIR --cpu m7`.
pub const CORTEX_M7: Board = Board {
    cpu: "Cortex-M7",
    target: "thumbv7em-none-eabihf",
    machine: Machine::Arm("mps2-an500"),
    instructions_per_tick: 40.0,
    flash: Flash::Large,
    has_floats: true,
    flags: &["-Ctarget-cpu=cortex-m7", "--cfg=cortex_m7"],
    loaded: 0x6000_0000,
};

/// Of most boards: that of mps2-an385 and mps2-an386.
const LOADED: u32 = 0x2100_0000;

/// Sizes of flash that blobs are made for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flash {
    /// 256 KiB with the code.
    Small,
    /// 2 MiB with the code.
    Large,
}

/// All boards; the first has RAM enough for other engines' heaps too.
pub const BOARDS: [Board; 4] = [
    Board {
        cpu: "Cortex-M4F",
        target: "thumbv7em-none-eabihf",
        machine: Machine::Arm("mps2-an386"),
        instructions_per_tick: 40.0,
        flash: Flash::Large,
        has_floats: true,
        flags: &[],
        loaded: LOADED,
    },
    Board {
        cpu: "Cortex-M0",
        target: "thumbv6m-none-eabi",
        machine: Machine::Arm("microbit"),
        instructions_per_tick: 62.5,
        flash: Flash::Small,
        has_floats: false,
        flags: &[],
        loaded: LOADED,
    },
    Board {
        cpu: "Cortex-M33",
        target: "thumbv8m.main-none-eabihf",
        // Not the an521, whose first core has no floating-point unit.
        machine: Machine::Arm("mps2-an505"),
        instructions_per_tick: 50.0,
        flash: Flash::Large,
        has_floats: true,
        flags: &[],
        loaded: LOADED,
    },
    Board {
        cpu: "RV32IMAC",
        target: "riscv32imac-unknown-none-elf",
        machine: Machine::Riscv32("virt"),
        instructions_per_tick: 1.0,
        flash: Flash::Large,
        has_floats: false,
        flags: &[],
        loaded: LOADED,
    },
];
