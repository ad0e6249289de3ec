//! The size of an image that opens triboxes and asks whether they are apart and nothing else.
#![no_std]
#![no_main]

#[macro_use]
#[path = "../bare.rs"]
mod bare;

use meshsweep_suite::ask::{Asked, tree, triboxes};

ask! {
    ask_apart: triboxes::Triboxes<'t>, |all, input, scratch, fold| {
        let pose = tree::pose(([input.a, input.b, input.a], input.b));
        triboxes::reject(all, pose, scratch, &mut Asked::new((), fold))
    };
}
