//! The size of an image that opens a box tree and asks it for the first hit of a segment and
//! nothing else.
#![no_std]
#![no_main]

#[macro_use]
#[path = "../bare.rs"]
mod bare;

use meshsweep_suite::ask::{Asked, tree};

ask! {
    ask_first_hit: tree::Bvh<'t>, |tree, input, scratch, fold| {
        tree::first_hit(tree, [input.a, input.b], scratch, &mut Asked::new((), fold))
    };
}
