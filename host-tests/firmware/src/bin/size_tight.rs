//! The size of an image that opens tight hulls and asks whether the mesh within is nearer than a
//! distance, and nothing else.
#![no_std]
#![no_main]

#[macro_use]
#[path = "../bare.rs"]
mod bare;

use meshsweep_suite::ask::{Asked, tight};

ask! {
    ask_is_within: tight::Hulls<'t>, |hulls, input, scratch, fold| {
        tight::is_within(hulls, input.a, input.b[0], scratch, &mut Asked::new((), fold))
    };
}
