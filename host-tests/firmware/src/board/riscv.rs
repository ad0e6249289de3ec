//! RISC-V: the counter of retired instructions.

use super::CALIBRATION_ROUNDS;

/// Starts the counter: it runs from reset.
pub const fn start_counter() {}

/// The counter's lower half.
#[inline(always)]
pub fn now() -> u32 {
    let count: u32;
    // SAFETY: reads a counter; machine mode may.
    unsafe { core::arch::asm!("csrr {}, minstret", out(reg) count, options(nomem, nostack)) };
    count
}

/// Ticks from one reading to a later one, less than 2³² of them.
#[inline(always)]
pub const fn elapsed(from: u32, to: u32) -> u32 {
    to.wrapping_sub(from)
}

/// The stack pointer.
#[inline(always)]
pub fn stack_pointer() -> usize {
    let pointer: usize;
    // SAFETY: reads a register.
    unsafe { core::arch::asm!("mv {}, sp", out(reg) pointer, options(nomem, nostack)) };
    pointer
}

/// Runs a known number of instructions: that number, and the ticks it took.
pub fn calibrate() -> (u32, u32) {
    let from = now();
    // SAFETY: counts a register down.
    unsafe {
        core::arch::asm!("2: addi {0}, {0}, -1", "bnez {0}, 2b", inout(reg) CALIBRATION_ROUNDS => _, options(nomem, nostack));
    }
    (2 * CALIBRATION_ROUNDS, elapsed(from, now()))
}
