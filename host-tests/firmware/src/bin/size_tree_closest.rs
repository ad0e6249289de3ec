//! The size of an image that opens a box tree and asks it for closest points and nothing else.
#![no_std]
#![no_main]

#[macro_use]
#[path = "../bare.rs"]
mod bare;

use meshsweep_suite::ask::{Asked, tree};

ask! {
    ask_closest: tree::Bvh<'t>, |tree, input, scratch, fold| {
        tree::closest(tree, input.a, scratch, &mut Asked::new((), fold))
    };
}
