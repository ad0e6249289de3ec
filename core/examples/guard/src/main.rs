//! An arm guards itself 1,000 times a second: seven links, a table and a machine, 21 pairs, each
//! with a distance to keep. It stops before the machine.
//!
//! A tick computes where the links are, tells the scene, and asks. What the links may be off by is
//! in the distances: see README.md.

#![no_std]
#![no_main]

mod arm;
mod board;
mod groove;
mod link;
mod table;

use arm::{LINKS, MACHINE, TABLE};
use cortex_m_rt::entry;
use meshsweep_core::{
    Budget, Bvh, CoherentScene, KeptPair, PlacedModel, Pose, QueryError, Scratch, Verdict,
};
use semihosting::{println, process};

/// Distances to keep, mm: of two links, and of a link from what stands around.
const KEEP: [f32; 2] = [5.0, 10.0];
/// No point of a link is farther than this from the place that is computed, mm. Each tick checks
/// it.
const MOST_OFF: f32 = 0.25;
/// No point of a link moves farther in a tick, mm. So the distances are kept between ticks too.
const MOST_PER_TICK: f32 = 0.5;
/// Pairs of nodes that a tick may open: what bounds its time. With fewer it stops too early.
const STEPS: u32 = 2000;
const TICKS: u32 = 1200;

/// Two links. Of a link and the next but one joints of 90 degrees keep the distance.
const fn links(a: u16, b: u16) -> KeptPair {
    KeptPair { models: [a, b], distance: KEEP[0] + 2.0 * (MOST_OFF + MOST_PER_TICK) }
}

/// A link and what does not move.
const fn around(a: u16, b: u16) -> KeptPair {
    KeptPair { models: [a, b], distance: KEEP[1] + MOST_OFF + MOST_PER_TICK }
}

#[rustfmt::skip]
const PAIRS: [KeptPair; 21] = [
    links(0, 3), links(0, 4), links(0, 5), links(0, 6), links(1, 4),
    links(1, 5), links(1, 6), links(2, 5), links(2, 6), links(3, 6),
    around(1, TABLE), around(2, TABLE), around(3, TABLE), around(4, TABLE), around(5, TABLE),
    around(6, TABLE), around(2, MACHINE), around(3, MACHINE), around(4, MACHINE),
    around(5, MACHINE), around(6, MACHINE),
];

type Guard = CoherentScene<'static, { LINKS + 2 }, { PAIRS.len() }>;

/// The models at their first places.
fn begin() -> Result<Guard, QueryError> {
    let [a, b, c, d, e, f, g] = arm::places(0)?.map(|link| PlacedModel::new(link::TREE, link.pose));
    let still = |tree, translation| PlacedModel::new(tree, Pose { translation, ..Pose::IDENTITY });
    let table = still(table::TREE, [-100.0, -100.0, -28.0]);
    let machine = still(groove::TREE, [210.0, -16.0, -8.0]);
    CoherentScene::new([a?, b?, c?, d?, e?, f?, g?, table?, machine?], PAIRS)
}

fn run() -> Result<(), QueryError> {
    let mut guard = begin()?;
    let mut scratch = Scratch::<{ Bvh::DISTANCE_ENTRIES }>::new();
    let budget = Budget::EXACT.with_steps(STEPS);
    let (mut sum, mut most, mut most_before, mut ticks) = (0u64, 0, 0, 0);
    board::start();
    for tick in 0..TICKS {
        let (places, cost_before) = board::timed(|| arm::places(tick));
        let places = places?;
        if places.iter().any(|link| !(link.motion(arm::RADIUS) <= MOST_OFF)) {
            println!("the links are farther off than the distances allow for");
            break;
        }
        let (near, cost) = board::timed(|| {
            for (link, place) in places.iter().enumerate() {
                guard.move_to(link, place.pose)?;
            }
            guard.within(budget, &mut scratch)
        });
        let near = near?;
        ticks += 1;
        sum += u64::from(cost);
        (most, most_before) = (cost.max(most), cost_before.max(most_before));
        if near.verdict != Verdict::No {
            println!("stopped before tick {tick}");
            if let Some([a, b]) = near.witness {
                println!("  model {a}");
                println!("  and model {b} may be too near");
            }
            break;
        }
        // Here the arm moves.
    }
    println!("cost: a tick takes {} instructions in mean", sum / ticks.max(1));
    println!("cost: the costliest tick takes {most} instructions");
    println!("cost: places of the links take {most_before} instructions");
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
