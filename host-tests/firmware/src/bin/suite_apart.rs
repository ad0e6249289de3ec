//! Runs the suite's questions about other bodies on a box tree.
#![no_std]
#![no_main]

#[macro_use]
#[path = "../suite.rs"]
mod suite;

use meshsweep_suite::ask::apart::{Apart, Scratch};

image!(Apart<'static>, Scratch);
