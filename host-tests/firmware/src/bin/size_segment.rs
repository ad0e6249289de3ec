//! The size of an image that asks for the first hit of a segment and nothing else.
#![no_std]
#![no_main]

#[path = "../bare.rs"]
mod bare;

use bare::Input;
use meshsweep_suite::ask::{self, Scratch};
use meshsweep_suite::fold::Fold;

#[unsafe(no_mangle)]
extern "C" fn ask_first_hit(input: &Input<'_>, scratch: &mut Scratch, fold: &mut Fold) {
    if let Ok(subject) = ask::open(input.blob) {
        ask::first_hit(&subject, input.a, input.b, scratch, fold);
    }
}
