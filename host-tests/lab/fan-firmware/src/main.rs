//! Asks triangle fans, by what they store, and prints what that took.
//!
//! One line a fact, words separated by one space:
//! ```text
//! calibration INSTRUCTIONS TICKS
//! asked distance|segment KERNEL QUESTIONS TICKS BITS
//! done
//! ```
//! The kernel of the largest number asks nothing: its ticks are those of the loop.
#![no_std]
#![no_main]

#[path = "../../src/measure/paper/fan_kernel.rs"]
mod fan_kernel;

/// What the host wrote: fans, and questions about them.
mod carried {
    include!(concat!(env!("MESHSWEEP_FANS"), "/fans.rs"));
}

use carried::{CENTRES, DISTANCES, EDGES, HITS, LENGTHS, NORMALS, RIMS, STARTS};
use core::hint::black_box;
use fan_kernel::{Fan, NOTHING, distance_sq, folded, hit};
use meshsweep_firmware::board;
use semihosting::{println, process};

/// A fan by its number.
#[inline(always)]
fn fan(number: u16) -> Fan<'static> {
    let number = usize::from(number);
    let rim = usize::from(STARTS[number])..usize::from(STARTS[number + 1]);
    Fan {
        centre: CENTRES[number],
        rim: &RIMS[rim.clone()],
        edges: &EDGES[rim.clone()],
        lengths: &LENGTHS[rim.clone()],
        normals: &NORMALS[rim],
    }
}

#[inline(never)]
fn distances<const KIND: u8>() {
    let begun = board::now();
    let mut bits = 0;
    for &(number, p) in black_box(&DISTANCES) {
        bits = folded(bits, asked_distance::<KIND>(p, &fan(number)));
    }
    let ticks = board::elapsed(begun, board::now());
    println!("asked distance {KIND} {} {ticks} {bits}", DISTANCES.len());
}

#[inline(never)]
fn hits<const KIND: u8>() {
    let begun = board::now();
    let mut bits = 0;
    for &(number, from, way) in black_box(&HITS) {
        bits = folded(bits, asked_hit::<KIND>(from, way, &fan(number)));
    }
    let ticks = board::elapsed(begun, board::now());
    println!("asked segment {KIND} {} {ticks} {bits}", HITS.len());
}

/// A call of its own, so that loops differ by their kernels alone.
#[inline(never)]
fn asked_distance<const KIND: u8>(p: [f32; 3], fan: &Fan<'_>) -> f32 {
    distance_sq::<KIND>(p, fan)
}

#[inline(never)]
fn asked_hit<const KIND: u8>(from: [f32; 3], way: [f32; 3], fan: &Fan<'_>) -> f32 {
    hit::<KIND>(from, way, fan)
}

#[cortex_m_rt::entry]
fn main() -> ! {
    board::start_counter();
    let (instructions, ticks) = board::calibrate();
    println!("calibration {instructions} {ticks}");
    distances::<0>();
    distances::<1>();
    distances::<2>();
    distances::<3>();
    distances::<NOTHING>();
    hits::<0>();
    hits::<1>();
    hits::<2>();
    hits::<3>();
    hits::<NOTHING>();
    println!("done");
    process::exit(0)
}
