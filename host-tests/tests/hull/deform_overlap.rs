//! A hull hierarchy that deforms against a rigid one: the exact predicates on the moved mesh.

use super::deform::{build, memory, motion, place};
use super::scenes::options;
use meshsweep_core::{
    Budget, Decided, DeformableHull, QueryError, ScratchEntry, Undecided, Verdict,
};
use meshsweep_host_tests::generate::{Triangles, cube, icosphere, rough_sphere, torus};
use meshsweep_host_tests::motion::{Tally, motions};
use meshsweep_host_tests::oracle::moved::{Place, meeting_pairs};
use meshsweep_host_tests::scene::Scene;

/// With coordinates that are multiples of 2^-14, so that those between two frames are exact too.
pub fn coarse(positions: &[[f32; 3]]) -> Vec<[f32; 3]> {
    positions.iter().map(|p| p.map(|x| (x * 16384.0).round() / 16384.0)).collect()
}

fn places(
    positions: &[[f32; 3]],
    triangles: &[[u32; 3]],
    at: impl Fn([f32; 3]) -> Place,
) -> Vec<[Place; 3]> {
    triangles.iter().map(|t| t.map(|v| at(positions[v as usize]))).collect()
}

/// Poses of `other` beside a mesh whose vertices are at `positions`, each answered by `ask`.
pub fn check(
    rest: &Scene,
    other: &Scene,
    seed: u64,
    positions: &[[f32; 3]],
    tally: &mut Tally,
    mut ask: impl FnMut(meshsweep_core::Pose) -> Decided<[u32; 2]>,
) {
    let first = places(positions, &rest.triangles, Place::of);
    for pose in motions(rest, other, 4, seed) {
        let moved = |p: [f32; 3]| Place::moved(p, &pose.rotation, pose.translation);
        let truth = meeting_pairs(&first, &places(&other.positions, &other.triangles, moved));
        tally.hold(&ask(pose), &truth, &format!("{pose:?}"));
    }
}

fn meshes() -> [Triangles; 3] {
    [torus(0.8, 0.3, 20, 10), icosphere(2), rough_sphere(2, 0.3, 5)]
        .map(|(positions, triangles)| (coarse(&positions), triangles))
}

fn scratch(hull: &DeformableHull<'_>, other: &Scene) -> Vec<ScratchEntry> {
    vec![ScratchEntry::EMPTY; hull.rest().overlap_entries(&other.model())]
}

#[test]
fn a_freely_moved_mesh_meets_exactly_what_its_vertices_say() {
    let other = Scene::hull("cube", cube(3), &options(12));
    let mut tally = Tally::default();
    for mesh in meshes() {
        let rest = Scene::hull("rest", mesh.clone(), &options(40));
        let built = build(&mesh, &[]);
        let hull = DeformableHull::open(&built).expect("just built");
        let (mut memory, mut scratch) = (memory(&hull), scratch(&hull, &other));
        let mut moved = hull.moved(&mut memory).expect("enough records");
        for frame in 0u32..12 {
            let positions = coarse(&motion(&mesh.0, 0.15 * f64::from(frame)));
            place(&mut moved, &positions);
            check(&rest, &other, u64::from(frame), &positions, &mut tally, |pose| {
                moved.overlap(&other.model(), pose, Budget::EXACT, &mut scratch).expect("answers")
            });
        }
    }
    assert!(tally.apart > 20 && tally.meets > 20 && tally.open <= 2, "{tally:?}");
}

#[test]
fn a_mesh_at_and_between_key_frames_meets_what_its_frame_says() {
    let other = Scene::hull("cube", cube(3), &options(12));
    let mut tally = Tally::default();
    for mesh in meshes() {
        let frames: Vec<Vec<[f32; 3]>> =
            (0..4).map(|k| coarse(&motion(&mesh.0, 0.25 * f64::from(k)))).collect();
        let rest = Scene::hull("rest", mesh.clone(), &options(40));
        let built = build(&mesh, &frames[1..]);
        let hull = DeformableHull::open(&built).expect("just built");
        let mut scratch = scratch(&hull, &other);
        for half in 0..7 {
            let (before, after) = (&frames[half / 2], &frames[half.div_ceil(2)]);
            let middle =
                |(a, b): (&[f32; 3], &[f32; 3])| std::array::from_fn(|k| 0.5 * (a[k] + b[k]));
            let positions: Vec<[f32; 3]> = before.iter().zip(after).map(middle).collect();
            let bent = hull.at_frame(half as f32 * 0.5).expect("a frame");
            check(&rest, &other, half as u64, &positions, &mut tally, |pose| {
                bent.overlap(&other.model(), pose, Budget::EXACT, &mut scratch).expect("answers")
            });
        }
    }
    assert!(tally.apart > 15 && tally.meets > 15 && tally.open <= 4, "{tally:?}");
}

#[test]
fn without_a_pose_or_with_too_little_memory_no_verdict_is_given() {
    let (mesh, other) = (icosphere(2), Scene::hull("cube", cube(3), &options(12)));
    let built = build(&mesh, &[]);
    let hull = DeformableHull::open(&built).expect("just built");
    let mut memory = memory(&hull);
    let mut moved = hull.moved(&mut memory).expect("enough records");
    let pose = meshsweep_core::Pose::IDENTITY;
    let mut few = [ScratchEntry::EMPTY; 2];
    let short = moved.overlap(&other.model(), pose, Budget::EXACT, &mut few).expect("answers");
    assert_eq!(short.verdict, Verdict::Undecided(Undecided::Scratch));
    let none = moved.overlap(&other.model(), pose, Budget::EXACT, &mut []);
    assert_eq!(none, Err(QueryError::NoScratch));
    assert!(moved.update(|_| [f32::NAN; 3]).is_err());
    let refused = moved.overlap(&other.model(), pose, Budget::EXACT, &mut few);
    assert_eq!(refused, Err(QueryError::NoPose));
}
