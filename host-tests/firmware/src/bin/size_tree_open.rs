//! The size of an image that opens a box tree and asks nothing of it.
#![no_std]
#![no_main]

#[macro_use]
#[path = "../bare.rs"]
mod bare;

use meshsweep_suite::ask::tree;

ask! {
    ask_open: tree::Bvh<'t>, |tree, input, _scratch, fold| fold.point(tree::bounds(tree)[0]);
}
