//! The size of an image that opens a box tree and asks nothing of it.
#![no_std]
#![no_main]

#[path = "../bare.rs"]
mod bare;

use bare::Input;
use meshsweep_suite::ask::tree;
use meshsweep_suite::fold::Fold;

#[unsafe(no_mangle)]
extern "C" fn ask_open(input: &Input<'_>, fold: &mut Fold) {
    if let Ok(tree) = tree::open(input.blob) {
        fold.point(tree::bounds(&tree)[0]);
    }
}
