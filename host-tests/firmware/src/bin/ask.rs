//! Asks one question to one blob at many places, all of them in the board's external RAM, where the
//! emulator puts the host's file: blobs of any size fit.
//!
//! Prints the lines of the suite, for one kind of question with the name `asked`, and the ticks of
//! each query.
#![no_std]
#![no_main]

use core::ptr::addr_of_mut;

use meshsweep_firmware::kept::{Kept, loaded};
use meshsweep_firmware::{board, stack};
use meshsweep_suite::ask::placed::{self, Answer, Memory, Placed};
use meshsweep_suite::fold::Fold;
use semihosting::{println, process};

static mut MEMORY: Memory<'static> = Memory::new();

#[cfg_attr(target_arch = "arm", cortex_m_rt::entry)]
#[cfg_attr(target_arch = "riscv32", riscv_rt::entry)]
fn main() -> ! {
    board::start_counter();
    let Some(placed) = Placed::read(loaded()) else {
        println!("refused 0");
        process::exit(1)
    };
    println!("blob {} {:016x}", placed.blob.len(), Fold::of_bytes(placed.blob));
    let (instructions, ticks) = board::calibrate();
    println!("calibration {instructions} {ticks}");
    // SAFETY: the entry runs once, so this is the only reference.
    let memory = unsafe { &mut *addr_of_mut!(MEMORY) };
    let (mut kept, mut fold) = (Kept::new(), Fold::new());
    stack::paint();
    let told = |answer: &Answer| answer.told(&mut fold);
    match placed::ask(&placed, usize::MAX, memory, &mut kept, told) {
        Ok(bytes) => println!("scratch {bytes}"),
        Err(refused) => {
            println!("refused {}", refused.0);
            process::exit(1)
        }
    }
    kept.print("asked", fold.finish());
    println!("done");
    process::exit(0)
}
