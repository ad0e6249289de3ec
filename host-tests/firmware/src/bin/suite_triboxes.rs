//! Runs the suite on triboxes.
#![no_std]
#![no_main]

#[macro_use]
#[path = "../suite.rs"]
mod suite;

use meshsweep_suite::ask::triboxes::{Scratch, Triboxes};

image!(Triboxes<'static>, Scratch);
