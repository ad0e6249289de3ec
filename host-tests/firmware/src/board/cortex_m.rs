//! Cortex-M: SysTick, the only counter that all of them have. It counts the processor's clock down
//! over 24 bits.

use super::CALIBRATION_ROUNDS;

const CONTROL: *mut u32 = 0xE000_E010 as *mut u32;
const RELOAD: *mut u32 = 0xE000_E014 as *mut u32;
const CURRENT: *mut u32 = 0xE000_E018 as *mut u32;
const MASK: u32 = 0x00ff_ffff;
/// Processor clock, no interrupt, running.
const PROCESSOR_CLOCK_ENABLE: u32 = 0b101;

/// Starts the counter.
pub fn start_counter() {
    // SAFETY: SysTick's registers, which nothing else in the image uses.
    unsafe {
        RELOAD.write_volatile(MASK);
        CURRENT.write_volatile(0);
        CONTROL.write_volatile(PROCESSOR_CLOCK_ENABLE);
    }
}

/// The counter.
#[inline(always)]
pub fn now() -> u32 {
    // SAFETY: reading the count has no effect but on a flag that nothing reads.
    unsafe { CURRENT.read_volatile() }
}

/// Ticks from one reading to a later one, less than 2²⁴ of them.
#[inline(always)]
pub const fn elapsed(from: u32, to: u32) -> u32 {
    from.wrapping_sub(to) & MASK
}

/// The stack pointer.
#[inline(always)]
pub fn stack_pointer() -> usize {
    let pointer: usize;
    // SAFETY: reads a register.
    unsafe {
        core::arch::asm!("mov {}, sp", out(reg) pointer, options(nomem, nostack, preserves_flags))
    };
    pointer
}

/// Runs a known number of instructions: that number, and the ticks it took.
pub fn calibrate() -> (u32, u32) {
    let from = now();
    // SAFETY: counts a register down.
    unsafe {
        core::arch::asm!("2: subs {0}, {0}, #1", "bne 2b", inout(reg) CALIBRATION_ROUNDS => _, options(nomem, nostack));
    }
    (2 * CALIBRATION_ROUNDS, elapsed(from, now()))
}
