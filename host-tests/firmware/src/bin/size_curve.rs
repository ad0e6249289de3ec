//! The size of an image that opens curves and asks for the closest point, and nothing else.
#![no_std]
#![no_main]

#[path = "../bare.rs"]
mod bare;

use bare::Input;
use meshsweep_suite::ask::curve::{self, Scratch};
use meshsweep_suite::fold::Fold;

#[unsafe(no_mangle)]
extern "C" fn ask_closest(input: &Input<'_>, scratch: &mut Scratch, fold: &mut Fold) {
    if let Ok(opened) = curve::open(input.blob) {
        curve::closest(&opened, input.a, scratch, &mut (), fold);
    }
}
