//! Runs the suite on a tight hull.
#![no_std]
#![no_main]

#[macro_use]
#[path = "../suite.rs"]
mod suite;

use meshsweep_suite::ask::tight::{Hulls, Scratch};

image!(Hulls<'static>, Scratch);
