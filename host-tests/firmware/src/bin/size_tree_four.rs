//! The size of an image that opens a box tree and asks it the four questions that firmware asks
//! most: closest point, first hit, within and signed distance.
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
    ask_first_hit: tree::Bvh<'t>, |tree, input, scratch, fold| {
        tree::first_hit(tree, [input.a, input.b], scratch, &mut Asked::new((), fold))
    };
    ask_is_within: tree::Bvh<'t>, |tree, input, scratch, fold| {
        tree::is_within(tree, input.a, input.b[0], scratch, &mut Asked::new((), fold))
    };
    ask_signed: tree::Bvh<'t>, |tree, input, scratch, fold| {
        tree::signed(tree, input.a, scratch, &mut Asked::new((), fold))
    };
}
