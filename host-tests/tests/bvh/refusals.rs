//! Every question refuses in the same way: a tolerance that no interval can meet, scratch memory
//! without entries, and a tree without the boxes that the question needs.

use meshsweep::bvh::{TreeOptions, build};
use meshsweep::mesh::Mesh;
use meshsweep::progress::Watch;
use meshsweep_core::{
    Budget, BuildFor, Bvh, CoherentQuery, Facing, Hint, Neighbor, Pose, QueryError, ScratchEntry,
    TriangleHit, TrianglePair,
};
use meshsweep_host_tests::generate::cube;

fn blob(segments: bool, closest: bool) -> Vec<u8> {
    let mesh = Mesh::new(cube(1).0, cube(1).1);
    let options = TreeOptions::default().with_segments(segments).with_closest(closest);
    build(mesh.as_input(), &options, Watch::NONE).expect("builds").0.to_bytes()
}

/// What each question about `point` answers.
fn about_a_point(
    tree: &Bvh<'_>,
    point: [f32; 3],
    budget: Budget,
    scratch: &mut [ScratchEntry],
) -> [(&'static str, Result<(), QueryError>); 8] {
    let (mut hint, mut near) = (Hint::NONE, [Neighbor::EMPTY; 2]);
    let mut coherent = CoherentQuery::<16>::new();
    [
        ("closest_point", tree.closest_point(point, budget, scratch).map(drop)),
        ("from", tree.closest_point_from(point, &mut hint, budget, scratch).map(drop)),
        ("coherent", coherent.closest_point(tree, point, budget, scratch).map(drop)),
        ("within", tree.within(point, 1.0, budget, scratch).map(drop)),
        ("all_within", tree.all_within(point, 1.0, &mut near, budget, scratch).map(drop)),
        ("nearest", tree.nearest(point, &mut near, budget, scratch).map(drop)),
        ("nearest of none", tree.nearest(point, &mut [], budget, scratch).map(drop)),
        ("signed_distance", tree.signed_distance(point, budget, scratch).map(drop)),
    ]
}

/// What each question about a segment or another tree answers.
fn about_segments(
    tree: &Bvh<'_>,
    budget: Budget,
    scratch: &mut [ScratchEntry],
) -> [(&'static str, Result<(), QueryError>); 5] {
    let (a, b, both) = ([0.0, 0.0, 9.0], [0.0, 0.0, -9.0], Facing::Both);
    let (mut hits, mut pairs, pose) =
        ([TriangleHit::EMPTY; 4], [TrianglePair::EMPTY; 4], Pose::IDENTITY);
    [
        ("first_hit", tree.first_hit(a, b, both, budget, scratch).map(drop)),
        ("any_hit", tree.any_hit(a, b, both, budget, scratch).map(drop)),
        ("all_hits", tree.all_hits(a, b, both, &mut hits, budget, scratch).map(drop)),
        ("overlap", tree.overlap(tree, pose, budget, scratch).map(drop)),
        ("overlaps", tree.all_overlaps(tree, pose, &mut pairs, budget, scratch).map(drop)),
    ]
}

/// Points in the model, beside it, and so far away that its box answers.
const POINTS: [[f32; 3]; 3] = [[0.1; 3], [3.0, 0.0, 4.0], [1e20, 0.0, 0.0]];

#[test]
fn every_question_refuses_a_tolerance_that_no_interval_meets() {
    let bytes = blob(true, true);
    let tree = Bvh::open(&bytes).expect("opens");
    let mut scratch = [ScratchEntry::EMPTY; Bvh::OVERLAP_ENTRIES];
    for bad in [-1.0, -f32::MIN_POSITIVE, f32::NAN, -f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for budget in [Budget::EXACT.with_relative(bad), Budget::EXACT.with_absolute(bad)] {
            let of_points = POINTS.map(|p| about_a_point(&tree, p, budget, &mut scratch));
            let of_segments = about_segments(&tree, budget, &mut scratch);
            for (name, answer) in of_points.into_iter().flatten().chain(of_segments) {
                assert_eq!(answer, Err(QueryError::Tolerance), "{name} {budget:?}");
            }
        }
    }
    for good in [0.0, -0.0, f32::MIN_POSITIVE, 0.5, f32::MAX] {
        let budget = Budget::EXACT.with_relative(good).with_absolute(good);
        let of_points = POINTS.map(|p| about_a_point(&tree, p, budget, &mut scratch));
        let of_segments = about_segments(&tree, budget, &mut scratch);
        for (name, answer) in of_points.into_iter().flatten().chain(of_segments) {
            assert_eq!(answer, Ok(()), "{name} {budget:?}");
        }
    }
}

#[test]
fn every_question_refuses_scratch_memory_without_entries() {
    let bytes = blob(true, true);
    let tree = Bvh::open(&bytes).expect("opens");
    let of_points = POINTS.map(|p| about_a_point(&tree, p, Budget::EXACT, &mut []));
    let of_segments = about_segments(&tree, Budget::EXACT, &mut []);
    for (name, answer) in of_points.into_iter().flatten().chain(of_segments) {
        assert_eq!(answer, Err(QueryError::NoScratch), "{name}");
    }
}

#[test]
fn every_question_names_the_boxes_that_its_tree_lacks() {
    let mut scratch = [ScratchEntry::EMPTY; Bvh::OVERLAP_ENTRIES];
    let bytes = blob(true, false);
    let for_segments = Bvh::open(&bytes).expect("opens");
    let refusal = Err(QueryError::NotServed { build_for: BuildFor::Closest });
    for point in POINTS {
        for (name, answer) in about_a_point(&for_segments, point, Budget::EXACT, &mut scratch) {
            assert_eq!(answer, refusal, "{name} {point:?}");
        }
    }
    for (name, answer) in about_segments(&for_segments, Budget::EXACT, &mut scratch) {
        assert_eq!(answer, Ok(()), "{name}");
    }
    let bytes = blob(false, true);
    let for_distances = Bvh::open(&bytes).expect("opens");
    let refusal = Err(QueryError::NotServed { build_for: BuildFor::Segment });
    for (name, answer) in about_segments(&for_distances, Budget::EXACT, &mut scratch) {
        assert_eq!(answer, refusal, "{name}");
    }
}
