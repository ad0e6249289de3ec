//! Runs the suite on a box tree.
#![no_std]
#![no_main]

#[macro_use]
#[path = "../suite.rs"]
mod suite;

use meshsweep_suite::ask::tree::{Bvh, Scratch};

image!(Bvh<'static>, Scratch<'static>);
