//! Counters of the two processor families. In the emulator, where each instruction takes one
//! nanosecond of the board's time, they count instructions.

#[cfg(target_arch = "arm")]
mod cortex_m;
#[cfg(target_arch = "riscv32")]
mod riscv;

#[cfg(target_arch = "arm")]
pub use cortex_m::{calibrate, elapsed, now, stack_pointer, start_counter};
#[cfg(target_arch = "riscv32")]
pub use riscv::{calibrate, elapsed, now, stack_pointer, start_counter};

/// Rounds of the calibration loop, two instructions each: long enough that the call around it does
/// not show.
const CALIBRATION_ROUNDS: u32 = 1_000_000;
