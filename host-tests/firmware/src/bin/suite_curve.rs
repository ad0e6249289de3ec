//! Runs the suite on curves.
#![no_std]
#![no_main]

#[macro_use]
#[path = "../suite.rs"]
mod suite;

use meshsweep_suite::ask::curve::{Curve, Scratch};

image!(Curve<'static>, Scratch);
