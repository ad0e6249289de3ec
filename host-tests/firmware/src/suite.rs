//! What the suite images share: the caller's memory, and the lines that the host reads.
//!
//! One line a fact, words separated by one space, so that the reader on the host needs no grammar:
//! ```text
//! blob BYTES HASH
//! calibration INSTRUCTIONS TICKS
//! opening BYTES
//! scratch BYTES
//! block KIND INDEX HASH TICKS
//! ticks KIND QUERIES MIN SUM MAX
//! stack KIND BYTES
//! done
//! ```

use core::cell::UnsafeCell;

use meshsweep_firmware::{board, flash, meter::Meter};
use meshsweep_suite::fold::Fold;
use meshsweep_suite::{Subject, run};
use semihosting::{println, process};

/// The image's entry: runs the suite on a subject. The caller's memory lies outside of the stack,
/// so that the two are measured apart.
macro_rules! image {
    ($subject:ty, $scratch:ty) => {
        static SCRATCH: suite::Shared<$scratch> = suite::Shared::new(<$scratch>::new());

        #[cfg_attr(target_arch = "arm", cortex_m_rt::entry)]
        #[cfg_attr(target_arch = "riscv32", riscv_rt::entry)]
        fn main() -> ! {
            // SAFETY: the entry runs once.
            unsafe { suite::main::<$subject>(&SCRATCH) }
        }
    };
}

/// Memory that one owner takes.
pub struct Shared<T>(UnsafeCell<T>);
// SAFETY: one core, no interrupt handler touches it.
unsafe impl<T> Sync for Shared<T> {}

impl<T> Shared<T> {
    /// Memory with a value in it.
    pub const fn new(value: T) -> Self {
        Self(UnsafeCell::new(value))
    }
}

/// Runs the suite on the board and prints what the host compares: hashes, ticks and stack depths.
///
/// # Safety
/// To be called once.
pub unsafe fn main<S: Subject<'static>>(scratch: &'static Shared<S::Scratch>) -> ! {
    board::start_counter();
    let blob = flash::blob();
    println!("blob {} {:016x}", blob.len(), Fold::of_bytes(blob));
    let (instructions, ticks) = board::calibrate();
    println!("calibration {instructions} {ticks}");
    // SAFETY: called once, so this is the only reference.
    let scratch = unsafe { &mut *scratch.0.get() };
    if let Err(refused) = run::<S>(blob, flash::plan(), scratch, &mut Meter::new()) {
        println!("refused {}", refused.0);
        process::exit(1)
    }
    println!("done");
    process::exit(0)
}
