//! The size of closest points on a box tree that somebody else has opened.
#![no_std]
#![no_main]

#[path = "../bare.rs"]
mod bare;

use bare::Input;
use meshsweep_suite::ask::tree::{self, Bvh, Scratch};
use meshsweep_suite::fold::Fold;

#[unsafe(no_mangle)]
extern "C" fn ask_closest(
    tree: &Bvh<'_>,
    input: &Input<'_>,
    scratch: &mut Scratch<'_>,
    fold: &mut Fold,
) {
    tree::closest(tree, input.a, scratch, &mut (), fold);
}
