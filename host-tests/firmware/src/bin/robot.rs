//! Guards an arm, tick after tick, and asks about pairs of its models. Blobs and poses are in the
//! board's external RAM, where the emulator puts the host's file.
//!
//! Prints the lines of the suite for two kinds of questions, `ticks` and `pairs`, and the ticks of
//! the counter for each question.
#![no_std]
#![no_main]

use core::ptr::addr_of_mut;

use meshsweep_firmware::board;
use meshsweep_firmware::kept::{Kept, loaded};
use meshsweep_suite::ask::robot::{self, Answer, Laid, Memory};
use meshsweep_suite::fold::Fold;
use semihosting::{println, process};

static mut MEMORY: Memory = Memory::new();

#[cfg_attr(target_arch = "arm", cortex_m_rt::entry)]
#[cfg_attr(target_arch = "riscv32", riscv_rt::entry)]
fn main() -> ! {
    board::start_counter();
    let (laid, bytes) = match Laid::read(loaded()) {
        Ok(laid) => laid,
        Err(refused) => {
            println!("refused {}", refused.0);
            process::exit(1)
        }
    };
    let bytes = loaded().get(..bytes).unwrap_or_default();
    println!("blob {} {:016x}", bytes.len(), Fold::of_bytes(bytes));
    let (instructions, ticks) = board::calibrate();
    println!("calibration {instructions} {ticks}");
    // SAFETY: the entry runs once, so this is the only reference.
    let memory = unsafe { &mut *addr_of_mut!(MEMORY) };
    let (mut kept, mut fold) = (Kept::new(), Fold::new());
    let scratch = robot::ticks(&laid, memory, &mut kept, |verdict| robot::told(&mut fold, verdict));
    println!("scratch {scratch}");
    kept.print("ticks", fold.finish());
    let mut fold = Fold::new();
    robot::pairs(&laid, memory, &mut kept, |answer: &Answer| answer.told(&mut fold));
    kept.print("pairs", fold.finish());
    println!("done");
    process::exit(0)
}
