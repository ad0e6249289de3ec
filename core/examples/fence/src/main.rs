//! An autopilot asks its geofence 50 times a second: is it inside, and how far is the line?
//!
//! The fence is a field with two exclusion zones, a house and a mast. While the distance to the
//! nearest line is proved to be larger than the way of braking, the vehicle flies on. An undecided
//! side brakes too.

#![no_std]
#![no_main]

mod board;
mod zones;

use cortex_m_rt::entry;
use meshsweep_core::{Budget, Curve, QueryError, Side};
use semihosting::{println, process};

/// From tick to tick, ms: 50 Hz.
const PERIOD: u32 = 20;
/// Nodes that a question may open: it bounds the time. An answer that is cut short holds.
const STEPS: u32 = 64;
/// Distance to keep, m: 24.4 to brake from 15.6 m/s by 5 m/s², 0.3 until the next tick, 2.5 for the
/// receiver of positions, and some room.
const KEEP: f32 = 28.0;

/// A straight leg: its start and its way from tick to tick, in 64ths of a metre, and its ticks.
struct Leg {
    start: [i32; 2],
    step: [i32; 2],
    ticks: u32,
}

const LEGS: [Leg; 5] = [
    Leg { start: [60 * 64, 120 * 64], step: [20, 0], ticks: 900 }, // East, to the mast.
    Leg { start: [200 * 64, 60 * 64], step: [0, -20], ticks: 900 }, // South, to the line.
    Leg { start: [370 * 64, 120 * 64], step: [0, 16], ticks: 900 }, // Along the line, to a corner.
    Leg { start: [300 * 64, 150 * 64], step: [-20, 0], ticks: 900 }, // From the mast.
    Leg { start: [200 * 64, 180 * 64], step: [-12, -16], ticks: 250 }, // Across the field.
];

/// Flies a leg, and prints what it comes to. Returns the instructions of its costliest question.
fn fly(fence: &Curve<'_>, number: usize, leg: &Leg) -> Result<u32, QueryError> {
    let budget = Budget::EXACT.with_steps(STEPS);
    let mut scratch = zones::scratch::<{ zones::SCRATCH_ENTRIES }>();
    let mut worst = 0;
    let [mut x, mut y] = leg.start;
    println!("leg {number}");
    for tick in 0..leg.ticks {
        let place = [x as f32 / 64.0, y as f32 / 64.0];
        let (found, cost) = board::timed(|| fence.signed_distance(place, budget, &mut scratch));
        let found = found?;
        worst = worst.max(cost);
        if found.side != Side::Inside {
            println!("  is not proved to be inside after ms: {}", tick * PERIOD);
            return Ok(worst);
        }
        // Negative inside: no line is nearer than this.
        let left = -found.distance.upper;
        if left < KEEP {
            println!("  brakes after ms: {}", tick * PERIOD);
            println!("  millimetres left, for certain: {}", (left * 1000.0) as u32);
            println!("  the nearest line is of zone {}", found.closest.segment.polyline);
            return Ok(worst);
        }
        [x, y] = [x + leg.step[0], y + leg.step[1]];
    }
    println!("  is flown to its end in ms: {}", leg.ticks * PERIOD);
    Ok(worst)
}

fn run() -> Result<(), QueryError> {
    board::start();
    // It checks every byte. The image may check them once more before each flight.
    let Ok(fence) = Curve::open(&zones::BYTES.0) else {
        println!("the fence is damaged: no start");
        return Ok(());
    };
    fence.check_fence()?;
    let mut worst = 0;
    for (number, leg) in (1..).zip(&LEGS) {
        worst = worst.max(fly(&fence, number, leg)?);
    }
    println!("cost: the worst question took {worst} instructions");
    println!("cost: a period has {} instructions", board::CLOCK_HZ / 1000 * PERIOD);
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
