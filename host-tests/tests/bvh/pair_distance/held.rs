//! Answers about motions, held to the true distance.

use meshsweep_core::{
    Budget, Bvh, Decided, Ended, Interval, PairDistance, Pose, ScratchEntry, Undecided, Verdict,
};
use meshsweep_host_tests::oracle::{
    Bounded, distance_of_meshes, distance_to_moved_mesh, distance_to_triangle,
};
use meshsweep_host_tests::scene::Scene;

pub fn ask(a: &Bvh<'_>, b: &Bvh<'_>, pose: &Pose, budget: Budget) -> PairDistance {
    let mut stack = [ScratchEntry::EMPTY; Bvh::DISTANCE_ENTRIES];
    a.distance_to(b, *pose, budget, &mut stack).expect("answers")
}

pub fn ask_within(a: &Bvh<'_>, b: &Bvh<'_>, pose: &Pose, distance: f32) -> Decided<[u32; 2]> {
    let mut stack = [ScratchEntry::EMPTY; Bvh::DISTANCE_ENTRIES];
    a.within_of(b, *pose, distance, Budget::EXACT, &mut stack).expect("answers")
}

pub fn truth(a: &Scene, b: &Scene, pose: &Pose) -> Bounded {
    let first = (a.positions.as_slice(), a.triangles.as_slice());
    let second = (b.positions.as_slice(), b.triangles.as_slice());
    distance_of_meshes(first, second, &pose.rotation, pose.translation)
}

pub fn contains(distance: Interval, truth: Bounded) -> bool {
    f64::from(distance.lower) <= truth.upper && truth.lower <= f64::from(distance.upper)
}

/// How many motions were apart, and how many in contact.
#[derive(Debug, Default)]
pub struct Tally {
    pub apart: usize,
    pub meets: usize,
}

/// Lengths from which the rounding of f32 is counted.
fn reach(a: &Scene, b: &Scene, pose: &Pose) -> f64 {
    let shift = pose.translation.iter().fold(0f64, |m, x| m.max(f64::from(x.abs())));
    a.reach() + 4.0 * b.reach() + shift
}

/// Holds every answer about two meshes to the truth, for each pair of their trees.
pub fn holds(name: &str, a: &Scene, b: &Scene, pose: &Pose, tally: &mut Tally) {
    let truth = truth(a, b, pose);
    if truth.upper > 0.0 {
        tally.apart += 1;
    } else {
        tally.meets += 1;
    }
    for number in 0..4 {
        let (first, second) = (a.trees()[number & 1], b.trees()[number >> 1]);
        let name = format!("{name}, trees {number}, {pose:?}");
        let found = ask(&first, &second, pose, Budget::EXACT);
        let width = distance_holds(&name, [a, b], [&first, &second], pose, &found, truth);
        thresholds(&name, [&first, &second], pose, truth, width + 1e-6 * truth.upper);
    }
}

/// Holds a distance to the truth, and its points to the triangles. Returns how wide it is.
pub fn distance_holds(
    name: &str,
    [a, b]: [&Scene; 2],
    [first, second]: [&Bvh<'_>; 2],
    pose: &Pose,
    found: &PairDistance,
    truth: Bounded,
) -> f64 {
    let rounding = 4e-7 * reach(a, b, pose);
    assert!(contains(found.distance, truth), "{name}: {found:?} {truth:?}");
    assert_eq!(found.ended, Ended::Exact, "{name}");
    let error = f64::from(first.surface_error() + 4.0 * second.surface_error());
    let Interval { lower, upper } = found.distance;
    let width = f64::from(upper) - f64::from(lower);
    let allowed = 2.0 * error + 1e-6 * truth.upper + 1e-7 * rounding;
    assert!(width <= allowed, "{name}: {found:?} {truth:?} {width:e} {allowed:e}");
    witness(name, [a, b], pose, found, error + rounding);
    width
}

/// Both points lie on the triangles that are named, and are as far from each other as was said.
fn witness(name: &str, [a, b]: [&Scene; 2], pose: &Pose, found: &PairDistance, allowed: f64) {
    let ([p, q], [first, second]) = (found.points, found.triangles);
    let here = distance_to_triangle(p, a.corners(first));
    assert!(here.lower <= allowed, "{name}: {found:?} {here:?} {allowed:e}");
    let one = [b.triangles[second as usize]];
    let moved = [b.positions.as_slice(), &pose.rotation];
    let there = distance_to_moved_mesh(q, moved, &one, pose.translation);
    assert!(there.lower <= allowed, "{name}: {found:?} {there:?} {allowed:e}");
    let squared: f64 = p.iter().zip(q).map(|(p, q)| (f64::from(*p) - f64::from(q)).powi(2)).sum();
    let between = squared.sqrt();
    assert!(between <= f64::from(found.distance.upper) + allowed, "{name}: {found:?} {between}");
}

/// No verdict is wrong, and none is open farther than `width` from the truth.
fn thresholds(name: &str, [a, b]: [&Bvh<'_>; 2], pose: &Pose, truth: Bounded, width: f64) {
    let near = [0.0, truth.lower - 1.01 * width, truth.lower, truth.upper + 1.01 * width];
    for distance in near.into_iter().chain([0.5, 0.99, 1.01, 3.0].map(|k| k * truth.upper)) {
        let distance = distance.max(0.0) as f32;
        verdict_holds(name, &ask_within(a, b, pose, distance), distance, truth, width);
    }
}

/// The verdict is not wrong, and not open farther than `width` from the truth.
pub fn verdict_holds(
    name: &str,
    found: &Decided<[u32; 2]>,
    distance: f32,
    truth: Bounded,
    width: f64,
) {
    let name = format!("{name}, {distance:e}: {found:?} {truth:?}");
    match found.verdict {
        Verdict::Yes => {
            assert!(truth.lower <= f64::from(distance) && found.witness.is_some(), "{name}");
        }
        Verdict::No => {
            assert!(truth.upper > f64::from(distance) && found.is_clear(), "{name}");
        }
        verdict => {
            assert_eq!(verdict, Verdict::Undecided(Undecided::Resolution), "{name}");
            let off = (f64::from(distance) - truth.lower).abs();
            assert!(off <= 1.1 * width, "{name}: open {off:e} away, beyond {width:e}");
        }
    }
}
