//! Runs the suite on the board and prints what the host compares: hashes, ticks and stack depths.
//!
//! One line a fact, words separated by one space, so that the reader on the host needs no grammar:
//! ```text
//! blob BYTES HASH
//! calibration INSTRUCTIONS TICKS
//! scratch BYTES
//! block KIND INDEX HASH
//! ticks KIND QUERIES MIN SUM MAX
//! stack KIND BYTES
//! done
//! ```
#![no_std]
#![no_main]

use core::cell::UnsafeCell;

use meshsweep_firmware::{board, meter::Meter};
use meshsweep_suite::fold::Fold;
use meshsweep_suite::{Plan, Scratch, run};
use semihosting::{println, process};

/// In flash, where the core reads it in place. Aligned as a linker script would align a section for it.
#[repr(C, align(16))]
struct Flash<T: ?Sized>(T);

#[unsafe(link_section = ".rodata.meshsweep_blob")]
static BLOB: &Flash<[u8]> = &Flash(*include_bytes!(env!("MESHSWEEP_BLOB")));

/// The caller's memory, outside of the stack so that the two are measured apart.
struct Shared(UnsafeCell<Scratch<'static>>);
// SAFETY: one core, no interrupt handler touches it.
unsafe impl Sync for Shared {}
static SCRATCH: Shared = Shared(UnsafeCell::new(Scratch::new()));

#[cfg_attr(target_arch = "arm", cortex_m_rt::entry)]
#[cfg_attr(target_arch = "riscv32", riscv_rt::entry)]
fn main() -> ! {
    board::start_counter();
    println!("blob {} {:016x}", BLOB.0.len(), Fold::of_bytes(&BLOB.0));
    let (instructions, ticks) = board::calibrate();
    println!("calibration {instructions} {ticks}");
    // SAFETY: the entry runs once, so this is the only reference.
    let scratch = unsafe { &mut *SCRATCH.0.get() };
    if let Err(refused) = run(&BLOB.0, Plan::STANDARD, scratch, &mut Meter::new()) {
        println!("refused {}", refused.0);
        process::exit(1)
    }
    println!("done");
    process::exit(0)
}
