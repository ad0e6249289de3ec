//! Motions of one scene's mesh beside another's, and which of their triangles meet.

use std::fmt::Debug;

use glam::DVec3;
use meshsweep_core::{Decided, Pose, Undecided, Verdict};

use crate::generate::Rng;
use crate::oracle::moved::{Place, meeting_pairs};
use crate::scene::Scene;

/// A place.
pub type Point = [f32; 3];

fn places(scene: &Scene, at: impl Fn(Point) -> Place) -> Vec<[Place; 3]> {
    let places: Vec<Place> = scene.positions.iter().map(|&p| at(p)).collect();
    scene.triangles.iter().map(|t| t.map(|v| places[v as usize].clone())).collect()
}

/// Pairs of triangles that meet, by exact predicates.
#[must_use]
pub fn truth(a: &Scene, b: &Scene, pose: &Pose) -> Vec<[u32; 2]> {
    let moved = |p: Point| Place::moved(p, &pose.rotation, pose.translation);
    meeting_pairs(&places(a, Place::of), &places(b, moved))
}

/// How often each answer was given.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// No pair meets.
    pub apart: usize,
    /// A pair meets.
    pub meets: usize,
    /// Rounding decides.
    pub open: usize,
}

impl Tally {
    /// Holds an answer to the pairs that meet, and counts the answer.
    ///
    /// # Panics
    /// The answer is wrong, or names no pair.
    pub fn hold<W: Copy + Debug + PartialEq>(
        &mut self,
        answer: &Decided<W>,
        truth: &[W],
        name: &str,
    ) {
        match answer.verdict {
            Verdict::No => {
                self.apart += 1;
                assert!(truth.is_empty(), "{name}: wrongly apart: {} pairs meet", truth.len());
                assert_eq!(answer.witness, None, "{name}");
            }
            Verdict::Yes => {
                self.meets += 1;
                let pair = answer.witness.expect("a pair");
                assert!(truth.contains(&pair), "{name}: {pair:?} do not meet");
            }
            verdict => {
                self.open += 1;
                assert_eq!(verdict, Verdict::Undecided(Undecided::Resolution), "{name}");
                assert!(answer.witness.is_some(), "{name}: which pair is open");
            }
        }
    }
}

/// A rotation up to rounding.
pub fn rotation(rng: &mut Rng) -> [Point; 3] {
    let [x, other] = [(); 2].map(|()| DVec3::from(rng.direction().map(f64::from)));
    let z = x.cross(other);
    // Not `normalize`, which multiplies by the inverse: other bits.
    let z = z / z.length();
    [x, z.cross(x), z].map(|row| row.to_array().map(|x| x as f32))
}

/// A motion that brings the middle of `b` to `place`, with any rotation.
#[must_use]
pub fn placed(b: &Scene, rotation: [Point; 3], place: Point) -> Pose {
    let (low, high) = b.bounds();
    let middle: [f64; 3] = std::array::from_fn(|k| 0.5 * (f64::from(low[k]) + f64::from(high[k])));
    let translation = std::array::from_fn(|k| {
        let turned: f64 = (0..3).map(|j| f64::from(rotation[k][j]) * middle[j]).sum();
        (f64::from(place[k]) - turned) as f32
    });
    Pose::rigid(rotation, translation)
}

/// Random motions that leave the one now inside, now across, now beside the other.
#[must_use]
pub fn motions(a: &Scene, b: &Scene, count: usize, seed: u64) -> Vec<Pose> {
    let mut rng = Rng::new(seed);
    let ((low, high), (from, to)) = (a.bounds(), b.bounds());
    let size = |low: Point, high: Point| (0..3).map(|k| high[k] - low[k]).fold(0f32, f32::max);
    let grown = 0.7 * size(from, to);
    let (low, high) = (low.map(|x| x - grown), high.map(|x| x + grown));
    (0..count)
        .map(|_| {
            let rotation = rotation(&mut rng);
            placed(b, rotation, rng.point_in(low, high))
        })
        .collect()
}
