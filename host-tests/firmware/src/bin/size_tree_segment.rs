//! The size of an image that opens a box tree and asks it for the first hit of a segment and
//! nothing else.
#![no_std]
#![no_main]

#[path = "../bare.rs"]
mod bare;

use bare::Input;
use meshsweep_suite::ask::tree::{self, Scratch};
use meshsweep_suite::fold::Fold;

#[unsafe(no_mangle)]
extern "C" fn ask_first_hit(input: &Input<'_>, scratch: &mut Scratch<'_>, fold: &mut Fold) {
    if let Ok(tree) = tree::open(input.blob) {
        tree::first_hit(&tree, [input.a, input.b], scratch, &mut (), fold);
    }
}
