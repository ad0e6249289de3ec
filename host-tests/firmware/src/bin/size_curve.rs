//! The size of an image that opens curves and asks for the closest point, and nothing else.
#![no_std]
#![no_main]

#[macro_use]
#[path = "../bare.rs"]
mod bare;

use meshsweep_suite::ask::{Asked, curve};

ask! {
    ask_closest: curve::Curve<'t>, |curves, input, scratch, fold| {
        curve::closest(curves, input.a, scratch, &mut Asked::new((), fold))
    };
}
