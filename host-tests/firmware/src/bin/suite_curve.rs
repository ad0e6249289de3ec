//! Runs the suite on curves.
#![no_std]
#![no_main]

#[path = "../suite.rs"]
mod suite;

use meshsweep_suite::ask::curve::{Curve, Scratch};
use suite::Shared;

static SCRATCH: Shared<Scratch> = Shared::new(Scratch::new());

#[cfg_attr(target_arch = "arm", cortex_m_rt::entry)]
#[cfg_attr(target_arch = "riscv32", riscv_rt::entry)]
fn main() -> ! {
    // SAFETY: the entry runs once.
    unsafe { suite::main::<Curve<'static>>(&SCRATCH) }
}
