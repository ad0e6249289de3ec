//! A fingertip feels a part: a force pushes it out where it is inside.
//!
//! The tip moves in small steps. A coherent query keeps what earlier answers ruled out, and gives
//! the bits of a fresh query for less work. This program asks both, to show the difference.
//!
//! A pad over the part pushes before the tip is inside. It is asked at each tick of a faster loop:
//! a distance field gives the distance and the direction of the push, for a look-up.

#![no_std]
#![no_main]

mod board;
mod groove;
mod groove_pad;

use cortex_m_rt::entry;
use meshsweep_core::{Budget, CoherentQuery, QueryError, Side};
use semihosting::{println, process};

// Without sides no force would push the finger out.
const _: () = assert!(groove::TREE.has_sides(), "the part has no sides");

/// Length of a step, mm.
const STEP: f32 = 0.015625;
/// mN for a mm.
const STIFFNESS: f32 = 500.0;
/// Thickness of the pad, mm. The margin of its field is three times as much.
const PAD: f32 = 1.0;
/// mN for a mm into the pad.
const SOFTNESS: f32 = 100.0;
/// From 1 above the top, which is at 30, to half a mm inside, along it over the slot, and out.
const START: [f32; 3] = [8.0, 20.0, 31.0];
const LEGS: [([f32; 3], u32); 3] =
    [([0.0, 0.0, -STEP], 96), ([STEP, 0.0, 0.0], 1024), ([0.0, 0.0, STEP], 96)];

fn run() -> Result<(), QueryError> {
    let mut scratch = groove::scratch::<{ groove::SCRATCH_ENTRIES }>();
    let mut moving = CoherentQuery::<128>::new();
    let (mut finger, mut is_inside) = (START, false);
    let (mut questions, mut same, mut largest) = (0, 0, 0.0_f32);
    let (mut work, mut fresh_work) = ([0; 2], [0; 2]);
    let (mut cost, mut fresh_cost, mut pad_cost) = (0, 0, 0);
    let (mut agree, mut push) = (0, 0.0_f32);
    board::start();
    for (step, count) in LEGS {
        for _ in 0..count {
            finger = [0, 1, 2].map(|axis| finger[axis] + step[axis]);
            let tree = &groove::TREE;
            let ask = || moving.closest_point(tree, finger, Budget::EXACT, &mut scratch);
            let (near, took) = board::timed(ask);
            let near = near?.closest;
            cost += took;
            // Farther than some steps from the surface the finger is on the side where it was.
            if near.distance.lower <= 4.0 * STEP {
                match tree.signed_distance(finger, Budget::EXACT, &mut scratch)?.side {
                    Side::Inside => is_inside = true,
                    Side::Outside => is_inside = false,
                    _ => {} // Undecided: as before.
                }
            }
            let force = if is_inside { STIFFNESS * near.distance.lower } else { 0.0 };
            largest = largest.max(force);

            let (felt, took) = board::timed(|| groove_pad::FIELD.distance_and_gradient(finger));
            let (felt, uphill) = felt?;
            let felt = felt.distance;
            pad_cost += took;
            let depth = (PAD - felt.lower).clamp(0.0, PAD);
            push = push.max(SOFTNESS * depth * uphill[2]);
            let [low, high] = if is_inside {
                [-near.distance.upper, -near.distance.lower]
            } else {
                [near.distance.lower, near.distance.upper]
            };
            agree += u32::from(felt.lower <= high && low <= felt.upper);

            let ask = || tree.closest_point(finger, Budget::EXACT, &mut scratch);
            let (fresh, took) = board::timed(ask);
            let fresh = fresh?;
            fresh_cost += took;
            questions += 1;
            same += u32::from(near.distance == fresh.distance && near.point == fresh.point);
            work = [work[0] + near.work.bounds, work[1] + near.work.triangles];
            fresh_work = [fresh_work[0] + fresh.work.bounds, fresh_work[1] + fresh.work.triangles];
        }
    }
    println!("questions: {questions}");
    println!("answers with the bits of a fresh query: {same}");
    println!("largest force: {} mN", largest as i32);
    println!("intervals of the field that share a distance with the tree's: {agree}");
    println!("largest push of the pad upwards: {} mN", push as i32);
    println!("boxes tested: {}", work[0]);
    println!("triangles tested: {}", work[1]);
    println!("cost: fresh queries tested {} boxes", fresh_work[0]);
    println!("cost: and {} triangles", fresh_work[1]);
    println!("cost: a question took {} instructions", cost / questions);
    println!("cost: a fresh one took {} instructions", fresh_cost / questions);
    println!("cost: one of the field took {} instructions", pad_cost / questions);
    Ok(())
}

#[entry]
fn main() -> ! {
    match run() {
        Ok(()) => process::exit(0),
        Err(error) => {
            println!("{error}");
            process::exit(1)
        }
    }
}
