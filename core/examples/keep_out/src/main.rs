//! Each linear move of a machine head is proved clear of clamps before it is made.
//!
//! The head is a cutter, which is a capsule, and a nose, which is a box. `solid_first_contact` asks
//! about the whole move, so a thin wall cannot be missed between two positions. Only a proof lets
//! the head go: a move that is undecided is refused as one that collides.

#![no_std]
#![no_main]

mod board;
mod clamps;

use cortex_m_rt::entry;
use meshsweep_core::{Budget, QueryError, Scratch, Side, Solid};
use semihosting::{println, process};

/// Distance to keep, mm.
const KEEP: f32 = 1.0;
/// The middle of the tip's ball is the place of the head.
const CUTTER: [[f32; 3]; 2] = [[0.0, 0.0, 0.0], [0.0, 0.0, 20.0]];
const CUTTER_RADIUS: f32 = 3.0;
const NOSE: [[f32; 3]; 8] = Solid::box_corners([-12.0, -12.0, 20.0], [12.0, 12.0, 80.0]);

/// Two clamps reach over the table, at x from 0 to 30 and from 70 to 100. Their tops are at 28.
const START: [f32; 3] = [50.0, 8.0, 60.0];
const MOVES: [[f32; 3]; 8] = [
    [50.0, 8.0, 5.0],  // Down between the clamps.
    [40.0, 8.0, 5.0],  // The cutter would pass below the left strap, the nose would not.
    [44.0, 8.0, 5.0],  // Not as far.
    [44.0, 8.0, 60.0], // Up.
    [20.0, 8.0, 60.0], // Over the left clamp.
    [20.0, 8.0, 33.0], // Down on it, to 2 above.
    [20.0, 8.0, 32.0], // To 1 above: neither clear nor not, so it is refused.
    [90.0, 8.0, 33.0], // Over both clamps.
];

type Entries = Scratch<{ clamps::SCRATCH_ENTRIES }>;

/// The part of a move, of 1, that is proved clear for all corners of a convex part of the head.
/// Infinite: all of it is.
fn clear_until<const N: usize>(
    corners: [[f32; 3]; N],
    radius: f32,
    [from, to]: [[f32; 3]; 2],
    scratch: &mut Entries,
) -> Result<f32, QueryError> {
    let at = |place: [f32; 3]| corners.map(|c| [0, 1, 2].map(|axis| c[axis] + place[axis]));
    let (from, to) = (at(from), at(to));
    let (from, to) = (Solid::new(&from, radius + KEEP)?, Solid::new(&to, radius + KEEP)?);
    Ok(clamps::TREE.solid_first_contact(&from, &to, Budget::EXACT, scratch)?.t.lower)
}

/// The same of the whole head.
fn head_clear_until(way: [[f32; 3]; 2], scratch: &mut Entries) -> Result<f32, QueryError> {
    let cutter = clear_until(CUTTER, CUTTER_RADIUS, way, scratch)?;
    Ok(cutter.min(clear_until(NOSE, 0.0, way, scratch)?))
}

fn run() -> Result<(), QueryError> {
    let mut scratch = clamps::scratch();
    board::start();
    // Moves are asked about surfaces. So the head must begin outside of the clamps, and clear. The
    // head is connected: where it is clear, the side of one point is the side of all.
    let side = clamps::TREE.signed_distance(START, Budget::EXACT, &mut scratch)?.side;
    let is_clear = head_clear_until([START; 2], &mut scratch)? == f32::INFINITY;
    let may_move = side == Side::Outside && is_clear;
    println!("the start is outside and clear: {}", u32::from(may_move));
    if !may_move {
        return Ok(());
    }
    let (mut place, mut worst) = (START, 0);
    for (number, to) in MOVES.into_iter().enumerate() {
        let (until, cost) = board::timed(|| head_clear_until([place, to], &mut scratch));
        let until = until?;
        worst = worst.max(cost);
        if until == f32::INFINITY {
            place = to; // Here the machine moves.
            println!("move {} is made", number + 1);
        } else {
            println!("move {} is refused", number + 1);
            println!("  thousandths of it that are clear: {}", (until * 1000.0) as i32);
        }
    }
    println!("cost: the worst move took {worst} instructions");
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
