//! Asks one question to one blob at many places, all of them in the board's external RAM, where the
//! emulator puts the host's file: blobs of any size fit.
//!
//! Prints the lines of the suite, for one kind of question with the name `asked`, and the ticks of
//! each query.
#![no_std]
#![no_main]

use core::ptr::addr_of_mut;

use meshsweep_firmware::{board, meter::Meter, stack};
use meshsweep_suite::Clock;
use meshsweep_suite::ask::placed::{self, Answer, Memory, Placed};
use meshsweep_suite::fold::Fold;
use semihosting::{println, process};

/// mps2-an385 and mps2-an386: 16 MiB. The host's file has the first half.
const LOADED: *const u8 = 0x2100_0000 as *const u8;
const BYTES: usize = 8 << 20;

/// The second half has the ticks of each query.
const TICKS: *mut u32 = 0x2180_0000 as *mut u32;

/// A meter that keeps the ticks of each query, for printing would take stack.
struct Kept {
    meter: Meter,
    queries: usize,
}

impl Clock for Kept {
    #[inline]
    fn query_begins(&mut self) {
        if self.queries == 0 {
            // The blob was opened since the last paint.
            stack::paint();
        }
        self.meter.query_begins();
    }

    #[inline]
    fn query_ends(&mut self) {
        self.meter.query_ends();
        // SAFETY: a place takes twelve bytes of the first half, its ticks four of the second.
        unsafe { TICKS.add(self.queries).write_volatile(self.meter.last()) };
        self.queries += 1;
    }
}

static mut MEMORY: Memory<'static> = Memory::new();

#[cfg_attr(target_arch = "arm", cortex_m_rt::entry)]
#[cfg_attr(target_arch = "riscv32", riscv_rt::entry)]
fn main() -> ! {
    board::start_counter();
    // SAFETY: memory that nothing writes.
    let bytes = unsafe { core::slice::from_raw_parts(LOADED, BYTES) };
    let Some(placed) = Placed::read(bytes) else {
        println!("refused 0");
        process::exit(1)
    };
    println!("blob {} {:016x}", placed.blob.len(), Fold::of_bytes(placed.blob));
    let (instructions, ticks) = board::calibrate();
    println!("calibration {instructions} {ticks}");
    // SAFETY: the entry runs once, so this is the only reference.
    let memory = unsafe { &mut *addr_of_mut!(MEMORY) };
    let (mut kept, mut fold) = (Kept { meter: Meter::new(), queries: 0 }, Fold::new());
    stack::paint();
    let told = |answer: &Answer| answer.told(&mut fold);
    let asked = placed::ask(&placed, usize::MAX, memory, &mut kept, told);
    let Kept { mut meter, queries } = kept;
    meter.block_of("asked", 0, fold.finish());
    match asked {
        Ok(bytes) => println!("scratch {bytes}"),
        Err(refused) => {
            println!("refused {}", refused.0);
            process::exit(1)
        }
    }
    meter.costs_of("asked");
    for query in 0..queries {
        // SAFETY: written above.
        println!("each {}", unsafe { TICKS.add(query).read_volatile() });
    }
    println!("done");
    process::exit(0)
}
