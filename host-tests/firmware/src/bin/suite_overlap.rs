//! Runs the suite on a split hierarchy and its moved copy.
#![no_std]
#![no_main]

#[macro_use]
#[path = "../suite.rs"]
mod suite;

use meshsweep_suite::ask::hull_overlap::{Overlapping, Scratch};

image!(Overlapping<'static>, Scratch);
