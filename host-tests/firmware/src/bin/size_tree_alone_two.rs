//! The size of closest points and first hits on a box tree that was opened elsewhere.
#![no_std]
#![no_main]

#[macro_use]
#[path = "../bare.rs"]
mod bare;

use meshsweep_suite::ask::{Asked, tree};

ask_opened! {
    ask_closest: |tree, input, scratch, fold| {
        tree::closest(tree, input.a, scratch, &mut Asked::new((), fold))
    };
    ask_first_hit: |tree, input, scratch, fold| {
        tree::first_hit(tree, [input.a, input.b], scratch, &mut Asked::new((), fold))
    };
}
