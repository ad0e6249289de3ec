//! The size of closest points on a box tree that was opened elsewhere.
#![no_std]
#![no_main]

#[path = "../bare.rs"]
mod bare;

use bare::Input;
use meshsweep_suite::ask::Asked;
use meshsweep_suite::ask::tree::{self, Bvh, Scratch};
use meshsweep_suite::fold::Fold;

#[unsafe(no_mangle)]
extern "C" fn ask_closest(tree: &Bvh<'_>, input: &Input<'_>, s: &mut Scratch<'_>, fold: &mut Fold) {
    tree::closest(tree, input.a, s, &mut Asked::new((), fold));
}
