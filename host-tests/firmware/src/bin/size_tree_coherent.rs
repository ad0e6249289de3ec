//! The size of an image that opens a box tree and asks it for closest points by a session and
//! nothing else.
#![no_std]
#![no_main]

#[path = "../bare.rs"]
mod bare;

use bare::Input;
use meshsweep_suite::ask::tree::{self, Scratch};
use meshsweep_suite::fold::Fold;

#[unsafe(no_mangle)]
extern "C" fn ask_session<'t>(input: &Input<'t>, scratch: &mut Scratch<'t>, fold: &mut Fold) {
    if let Ok(tree) = tree::open(input.blob) {
        tree::session(&tree, input.a, scratch, &mut (), fold);
    }
}
