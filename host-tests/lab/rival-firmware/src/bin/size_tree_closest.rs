//! The size of an image that opens a blob's tree and asks for closest points and nothing else.
#![no_std]
#![no_main]

#[path = "../bare.rs"]
mod bare;
#[path = "../tree.rs"]
mod tree;

use bare::Input;
use meshsweep_core::ClosestPoint;
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
