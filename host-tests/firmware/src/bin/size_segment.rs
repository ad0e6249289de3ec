//! The size of an image that asks a split hierarchy for the first hit of a segment and nothing
//! else.
#![no_std]
#![no_main]

#[path = "../bare.rs"]
mod bare;

use bare::Input;
use meshsweep_suite::ask::hull::{self, Scratch};
use meshsweep_suite::fold::Fold;

#[unsafe(no_mangle)]
extern "C" fn ask_first_hit(input: &Input<'_>, scratch: &mut Scratch<'_>, fold: &mut Fold) {
    if let Ok(model) = hull::open(input.blob) {
        hull::first_hit(&model, [input.a, input.b], scratch, &mut (), fold);
    }
}
