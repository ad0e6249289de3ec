//! The size of an image that asks for a segment's hits on the refined hull and nothing else.
#![no_std]
#![no_main]

#[path = "../bare.rs"]
mod bare;

use bare::Input;
use meshsweep_suite::ask::{self, Scratch};
use meshsweep_suite::fold::Fold;

#[unsafe(no_mangle)]
extern "C" fn ask_outer_hits(input: &Input<'_>, scratch: &mut Scratch, fold: &mut Fold) {
    if let Ok(subject) = ask::open(input.blob) {
        ask::outer_hits(&subject, input.a, input.b, scratch, fold);
    }
}
