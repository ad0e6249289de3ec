//! Runs the suite on a distance field.
#![no_std]
#![no_main]

#[macro_use]
#[path = "../suite.rs"]
mod suite;

use meshsweep_suite::ask::sdf::{Scratch, Sdf};

image!(Sdf<'static>, Scratch);
