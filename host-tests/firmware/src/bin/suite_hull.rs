//! Runs the suite on a hull hierarchy.
#![no_std]
#![no_main]

#[macro_use]
#[path = "../suite.rs"]
mod suite;

use meshsweep_suite::ask::hull::{Model, Scratch};

image!(Model<'static>, Scratch);
