//! Runs the suite on a box tree with a distance field.
#![no_std]
#![no_main]

#[macro_use]
#[path = "../suite.rs"]
mod suite;

use meshsweep_suite::ask::both::{BvhWithSdf, Scratch};

image!(BvhWithSdf<'static>, Scratch);
