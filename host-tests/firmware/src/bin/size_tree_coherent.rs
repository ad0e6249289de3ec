//! The size of an image that opens a box tree and asks it for closest points by a coherent
//! query and nothing else.
#![no_std]
#![no_main]

#[macro_use]
#[path = "../bare.rs"]
mod bare;

use meshsweep_suite::ask::{Asked, tree};

ask! {
    ask_coherent: tree::Bvh<'t>, |tree, input, scratch, fold| {
        tree::coherent(tree, input.a, scratch, &mut Asked::new((), fold))
    };
}
