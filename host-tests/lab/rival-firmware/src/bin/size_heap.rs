//! The size of a heap and a vector: what any engine that allocates brings along.
#![no_std]
#![no_main]

extern crate alloc;

#[path = "../bare.rs"]
mod bare;
#[path = "../heap.rs"]
mod heap;

use alloc::vec::Vec;
use bare::Input;

#[unsafe(no_mangle)]
extern "C" fn ask_heap(input: &Input<'_>, out: &mut Vec<[f32; 3]>) {
    // SAFETY: as if this were the image's first call.
    unsafe { heap::begin() };
    *out = input.vertices.to_vec();
}
