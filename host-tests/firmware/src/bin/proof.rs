//! The no-panic proof: every entry of the core on opaque inputs. It links, or a panic is left in the core.
#![no_std]
#![no_main]

#[path = "../bare.rs"]
mod bare;

use bare::Input;
use meshsweep_suite::ask::{self, Scratch};
use meshsweep_suite::fold::Fold;

#[unsafe(no_mangle)]
extern "C" fn ask_open(input: &Input<'_>, fold: &mut Fold) {
    match ask::open(input.blob) {
        Ok(subject) => {
            fold.point(ask::bounds(&subject)[0]);
            ask::contents(&subject, fold);
        }
        Err(refused) => fold.word(refused.0),
    }
}

#[unsafe(no_mangle)]
extern "C" fn ask_closest(input: &Input<'_>, scratch: &mut Scratch, fold: &mut Fold) {
    #[cfg(feature = "inject_panic")]
    fold.byte([1, 2, 3][input.any]);
    if let Ok(subject) = ask::open(input.blob) {
        ask::closest(&subject, input.a, scratch, fold);
    }
}

#[unsafe(no_mangle)]
extern "C" fn ask_first_hit(input: &Input<'_>, scratch: &mut Scratch, fold: &mut Fold) {
    if let Ok(subject) = ask::open(input.blob) {
        ask::first_hit(&subject, input.a, input.b, scratch, fold);
    }
}

#[unsafe(no_mangle)]
extern "C" fn ask_all_hits(input: &Input<'_>, scratch: &mut Scratch, fold: &mut Fold) {
    if let Ok(subject) = ask::open(input.blob) {
        ask::all_hits(&subject, input.a, input.b, scratch, fold);
    }
}

#[unsafe(no_mangle)]
extern "C" fn ask_outer_hits(input: &Input<'_>, scratch: &mut Scratch, fold: &mut Fold) {
    if let Ok(subject) = ask::open(input.blob) {
        ask::outer_hits(&subject, input.a, input.b, scratch, fold);
    }
}
