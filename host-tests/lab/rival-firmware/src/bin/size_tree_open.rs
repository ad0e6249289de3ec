//! The size of an image that opens a blob's tree and asks nothing of it.
#![no_std]
#![no_main]

#[path = "../bare.rs"]
mod bare;
#[path = "../tree.rs"]
mod tree;

use bare::Input;
use tree::BoxTree;

#[unsafe(no_mangle)]
extern "C" fn ask_open(input: &Input<'static>, tree: &mut Option<BoxTree>) {
    *tree = BoxTree::open(input.blob).ok();
}
