//! Runs the suite on a split hierarchy.
#![no_std]
#![no_main]

#[path = "../suite.rs"]
mod suite;

use meshsweep_suite::ask::hull::{Model, Scratch};
use suite::Shared;

static SCRATCH: Shared<Scratch<'static>> = Shared::new(Scratch::new());

#[cfg_attr(target_arch = "arm", cortex_m_rt::entry)]
#[cfg_attr(target_arch = "riscv32", riscv_rt::entry)]
fn main() -> ! {
    // SAFETY: the entry runs once.
    unsafe { suite::main::<Model<'static>>(&SCRATCH) }
}
