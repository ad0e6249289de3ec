//! The size of an image that opens triboxes and asks whether they are apart and nothing else.
#![no_std]
#![no_main]

#[path = "../bare.rs"]
mod bare;

use bare::Input;
use meshsweep_suite::ask::triboxes::{self, Scratch};
use meshsweep_suite::fold::Fold;

#[unsafe(no_mangle)]
extern "C" fn ask_apart(input: &Input<'_>, scratch: &mut Scratch, fold: &mut Fold) {
    if let Ok(opened) = triboxes::open(input.blob) {
        triboxes::reject(&opened, &([input.a, input.b, input.a], input.b), scratch, &mut (), fold);
    }
}
