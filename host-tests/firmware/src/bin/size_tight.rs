//! The size of an image that opens tight hulls and asks whether the mesh within is nearer than a
//! distance, and nothing else.
#![no_std]
#![no_main]

#[path = "../bare.rs"]
mod bare;

use bare::Input;
use meshsweep_suite::ask::tight::{self, Scratch};
use meshsweep_suite::fold::Fold;

#[unsafe(no_mangle)]
extern "C" fn ask_is_within(input: &Input<'_>, scratch: &mut Scratch, fold: &mut Fold) {
    if let Ok(opened) = tight::open(input.blob) {
        tight::is_within(&opened, input.a, input.b[0], scratch, &mut (), fold);
    }
}
