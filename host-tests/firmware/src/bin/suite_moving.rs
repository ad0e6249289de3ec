//! Runs the suite on a hull hierarchy that moves.
#![no_std]
#![no_main]

#[macro_use]
#[path = "../suite.rs"]
mod suite;

use meshsweep_suite::ask::hull_moving::{Moving, Scratch};

image!(Moving<'static>, Scratch);
