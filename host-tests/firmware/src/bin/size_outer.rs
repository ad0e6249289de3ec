//! The size of an image that asks for a segment's hits on the refined hull and nothing else.
#![no_std]
#![no_main]

#[path = "../bare.rs"]
mod bare;

use bare::Input;
use meshsweep_suite::ask::hull::{self, Scratch};
use meshsweep_suite::fold::Fold;

#[unsafe(no_mangle)]
extern "C" fn ask_outer_hits<'t>(input: &Input<'t>, scratch: &mut Scratch<'t>, fold: &mut Fold) {
    if let Ok(model) = hull::open(input.blob) {
        hull::outer_hits(&model, [input.a, input.b], scratch, &mut (), fold);
    }
}
