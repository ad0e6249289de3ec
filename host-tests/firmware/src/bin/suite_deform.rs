//! Runs the suite on a hull hierarchy that deforms.
#![no_std]
#![no_main]

#[macro_use]
#[path = "../suite.rs"]
mod suite;

use meshsweep_suite::ask::deform::{DeformableHull, Scratch};

image!(DeformableHull<'static>, Scratch);
