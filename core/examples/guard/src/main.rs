//! A robot's arm stops before it comes near a third link that stands in its way.
//!
//! A tight hull of 40 faces stands for each link of 284 triangles. It encloses the link: where
//! hulls are apart, links are. Each pose is proved clear before the arm goes there.

#![no_std]
#![no_main]

mod board;
mod link;

use cortex_m_rt::entry;
use meshsweep_core::{Budget, Bvh, PlacedModel, Pose, QueryError, Scene, Scratch};
use semihosting::{println, process};

/// Distance to keep, mm.
const KEEP: f32 = 5.0;
/// No point of the arm moves farther from one pose to the next. So the distance is kept between
/// them too.
const MOST_PER_POSE: f32 = 1.5;
/// Pairs of nodes that the question about a pose may open.
const STEPS: u32 = 2000;
const POSES: u32 = 128;
/// From axis to axis of a link.
const LENGTH: f32 = 60.0;

/// A link whose first axis is at x and z, turned about it. `half` is the tangent of half the angle:
/// a rotation without sines.
fn turned(half: f32, x: f32, z: f32) -> Pose {
    let cosine = (1.0 - half * half) / (1.0 + half * half);
    let sine = 2.0 * half / (1.0 + half * half);
    Pose {
        rotation: [[cosine, 0.0, -sine], [0.0, 1.0, 0.0], [sine, 0.0, cosine]],
        translation: [x, 0.0, z],
    }
}

/// Upper arm, forearm, and the link in the way.
fn poses(number: u32) -> [Pose; 3] {
    let half = 0.25 - number as f32 / 256.0;
    let upper = turned(half, 0.0, 0.0);
    let [[cosine, ..], _, [sine, ..]] = upper.rotation;
    let forearm = turned(1.5 * half, LENGTH * cosine, LENGTH * sine);
    [upper, forearm, turned(0.0, 40.0, -50.0)]
}

fn run() -> Result<(), QueryError> {
    let tree = *link::FINEST_HULL.bvh();
    let mut scratch = Scratch::<{ Bvh::DISTANCE_ENTRIES }>::new();
    let not_a_joint = |a: usize, b: usize| [a, b] != [0, 1];
    let budget = Budget::EXACT.with_steps(STEPS);
    let (mut most_pairs, mut worst) = (0, 0);
    board::start();
    for number in 0..POSES {
        let [upper, forearm, table] = poses(number).map(|pose| PlacedModel::new(tree, pose));
        let links = [upper?, forearm?, table?];
        let scene = Scene::new(&links);
        let distance = KEEP + MOST_PER_POSE;
        let ask = || scene.within(distance, not_a_joint, budget, &mut scratch);
        let (near, cost) = board::timed(ask);
        let near = near?;
        most_pairs = most_pairs.max(near.work.opened);
        worst = worst.max(cost);
        if !near.is_clear() {
            println!("stopped before pose {number}");
            if let Some([a, b]) = near.witness {
                println!("  link {a}");
                println!("  and link {b} may be too near");
            } else {
                println!("  it is not known which links may be too near");
            }
            break;
        }
        // Here the arm moves.
    }
    println!("most pairs of nodes that a pose opened: {most_pairs}");
    println!("cost: the worst pose took {worst} instructions");
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
