//! How far is the tip of a probe from a part, 1,000 times a second and in bounded time?
//!
//! The tip comes down on a slot 4 wide and keeps 2 away from the part, so it stops at the mouth.
//! It never moves farther than half of what the last answer proved free.

#![no_std]
#![no_main]

mod board;
mod groove;

use cortex_m_rt::entry;
use meshsweep_core::{Budget, Ended, QueryError};
use semihosting::{println, process};

/// Distance to keep, mm.
const KEEP: f32 = 2.0;
/// Cycles of a period of 1 ms.
const CYCLES: u32 = board::CLOCK_HZ / 1000;

/// Most motion in a period, mm: 40 mm a second.
const FEED: f32 = 0.04;
/// The slot is seen from above its middle.
const START: [f32; 3] = [20.0, 20.0, 60.0];

/// Comes down as far as answers prove that it may. A question opens at most so many nodes: that
/// bounds its time.
fn descend(steps: u32) -> Result<(), QueryError> {
    let budget = Budget::EXACT.with_steps(steps);
    let mut scratch = groove::scratch::<{ groove::SCRATCH_ENTRIES }>();
    let (mut tip, mut cut_short, mut late, mut worst) = (START, 0, 0, 0);
    let begun = board::periods();
    let mut period = begun;
    let near = loop {
        let ask = || groove::TREE.closest_point(tip, budget, &mut scratch);
        let (near, cost) = board::timed(ask);
        let near = near?;
        worst = worst.max(cost);
        // If the steps ended the search, the interval is wider. Its lower end still holds.
        cut_short += u32::from(near.ended != Ended::Exact);
        let free = near.distance.lower - KEEP;
        if free < 0.01 {
            break near;
        }
        tip[2] -= FEED.min(0.5 * free);
        // QEMU's clock runs slower than a processor: an instruction counts as a cycle.
        late += u32::from(cost > CYCLES || board::periods() != period);
        board::sleep_during(period);
        period = board::periods();
    };
    let um = |mm: f32| (mm * 1000.0) as i32;
    println!("at most {steps} nodes a question");
    println!("  stopped at a height of {} um", um(tip[2]));
    println!("  the part is from {} um", um(near.distance.lower));
    println!("  to {} um away", um(near.distance.upper) + 1);
    println!("  questions: {}", period - begun + 1);
    println!("  cut short by the budget: {cut_short}");
    println!("  longer than their period of 1 ms: {late}");
    println!("cost: the worst of them took {worst} instructions");
    Ok(())
}

fn run() -> Result<(), QueryError> {
    board::start();
    // Few steps prove less, so the tip stops earlier. It is never too near.
    descend(2)?;
    descend(16)?;
    println!("cost: a period has {CYCLES} cycles");
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
