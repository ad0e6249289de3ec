//! The size of an image that opens a blob's tree and asks for closest points and first hits.
#![no_std]
#![no_main]

#[path = "../bare.rs"]
mod bare;
#[path = "../tree.rs"]
mod tree;

use bare::Input;
use meshsweep_core::{ClosestPoint, FirstHit};
use tree::BoxTree;

#[unsafe(no_mangle)]
extern "C" fn ask_open(input: &Input<'static>, tree: &mut Option<BoxTree>) {
    *tree = BoxTree::open(input.blob).ok();
}

#[unsafe(no_mangle)]
extern "C" fn ask_closest(
    input: &Input<'_>,
    tree: &mut BoxTree,
    closest: &mut Option<ClosestPoint>,
) {
    *closest = tree.closest(input.a);
}

#[unsafe(no_mangle)]
extern "C" fn ask_first_hit(input: &Input<'_>, tree: &mut BoxTree, hit: &mut Option<FirstHit>) {
    *hit = tree.first_hit(input.a, input.b);
}
