//! The size of an image that opens a distance field and asks for a distance, and nothing else.
#![no_std]
#![no_main]

#[macro_use]
#[path = "../bare.rs"]
mod bare;

use meshsweep_suite::ask::{Asked, sdf};

ask! {
    ask_distance: sdf::Sdf<'t>, |field, input, scratch, fold| {
        let sdf::Scratch = scratch;
        sdf::distance(field, input.a, &mut Asked::new((), fold))
    };
}
