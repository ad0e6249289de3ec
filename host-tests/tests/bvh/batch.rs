//! A batch gives the same bits as its queries one at a time, in any order and with any number of
//! threads.

use meshsweep::bvh::{self, RefusedPoint, TreeOptions, build};
use meshsweep::mesh::Mesh;
use meshsweep::progress::Watch;
use meshsweep_core::{Budget, Bvh, ClosestPoint, QueryError, ScratchEntry};
use meshsweep_host_tests::generate::{Rng, Triangles, rough_sphere, scaled, torus};

fn blob((positions, triangles): &Triangles) -> Vec<u8> {
    let mesh = Mesh::new(positions.clone(), triangles.clone());
    build(mesh.as_input(), &TreeOptions::default(), Watch::NONE).expect("builds").0.to_bytes()
}

fn random(count: usize, size: f32) -> Vec<[f32; 3]> {
    let mut rng = Rng::new(7);
    (0..count).map(|_| rng.point_in([-size; 3], [size; 3])).collect()
}

fn bits(answer: &ClosestPoint) -> ([u32; 5], Option<u32>, meshsweep_core::Ended) {
    let [x, y, z] = answer.point.map(f32::to_bits);
    (
        [answer.distance.lower.to_bits(), answer.distance.upper.to_bits(), x, y, z],
        answer.triangle,
        answer.ended,
    )
}

fn one_at_a_time(
    tree: &Bvh<'_>,
    points: &[[f32; 3]],
    stop: &Budget,
    stack: &mut [ScratchEntry],
) -> Vec<ClosestPoint> {
    points.iter().map(|&p| tree.closest_point(p, *stop, stack).unwrap()).collect()
}

#[test]
fn a_batch_has_the_bits_of_its_queries_in_any_order() {
    for (mesh, size) in
        [(torus(2.0, 0.75, 60, 40), 4.0), (scaled(&rough_sphere(3, 0.3, 2), 1.0e30), 2.0e30)]
    {
        let bytes = blob(&mesh);
        let tree = Bvh::open(&bytes).unwrap();
        let mut stack = vec![ScratchEntry::EMPTY; tree.scratch_entries()];
        let mut points = random(500, size);
        // Equal ones, one far away, one at the end of f32.
        points.extend([[0.25 * size; 3]; 20]);
        points.extend([[1.0e7 * size, 0.0, 0.0], [f32::MAX, f32::MIN, 0.0]]);
        for stop in [Budget::EXACT, Budget::EXACT.with_relative(0.1), Budget::EXACT.with_steps(3)] {
            let wanted = one_at_a_time(&tree, &points, &stop, &mut stack);
            let answers = bvh::closest_points(&tree, &points, &stop).unwrap();
            for (answer, wanted) in answers.iter().zip(&wanted) {
                assert_eq!(bits(answer), bits(wanted), "{stop:?}");
            }
        }
    }
}

/// The same in a pool of so many threads.
fn with_threads<T: Send>(threads: usize, ask: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool").install(ask)
}

#[test]
fn threads_do_not_change_a_bit() {
    let bytes = blob(&torus(2.0, 0.75, 60, 40));
    let tree = Bvh::open(&bytes).unwrap();
    let mut stack = vec![ScratchEntry::EMPTY; tree.header().stack_entries as usize];
    // The last are pieces for several threads.
    for count in [0, 1, 2, 5, 1000, 40_000] {
        let points = random(count, 4.0);
        let wanted = one_at_a_time(&tree, &points, &Budget::EXACT, &mut stack);
        let ask = || bvh::closest_points(&tree, &points, &Budget::EXACT).unwrap();
        let one = with_threads(1, ask);
        assert_eq!(one.len(), count);
        assert!(one.iter().zip(&wanted).all(|(answer, wanted)| bits(answer) == bits(wanted)));
        for threads in [2, 3, 7, 16] {
            // Work too.
            assert_eq!(with_threads(threads, ask), one);
        }
    }
}

#[test]
fn a_batch_in_order_takes_less_work() {
    let bytes = blob(&torus(2.0, 0.75, 120, 80));
    let tree = Bvh::open(&bytes).unwrap();
    let points = random(4000, 4.0);
    let mut stack = vec![ScratchEntry::EMPTY; tree.header().stack_entries as usize];
    let one = one_at_a_time(&tree, &points, &Budget::EXACT, &mut stack);
    let batch = bvh::closest_points(&tree, &points, &Budget::EXACT).unwrap();
    let total =
        |answers: &[ClosestPoint]| answers.iter().map(|a| u64::from(a.work.total())).sum::<u64>();
    assert!(total(&batch) < total(&one), "{} against {}", total(&batch), total(&one));
}

#[test]
fn a_refusal_names_the_first_point_and_why() {
    let bytes = blob(&torus(2.0, 0.75, 20, 12));
    let tree = Bvh::open(&bytes).unwrap();
    let mut points = random(50, 4.0);
    assert_eq!(bvh::closest_points(&tree, &[], &Budget::EXACT), Ok(Vec::new()));
    let wrong = Budget::EXACT.with_absolute(f32::NAN);
    let tolerance = RefusedPoint { index: 0, error: QueryError::Tolerance };
    assert_eq!(bvh::closest_points(&tree, &points, &wrong), Err(tolerance));
    (points[31][1], points[44][0]) = (f32::INFINITY, f32::NAN);
    let first = RefusedPoint { index: 31, error: QueryError::NotFinite };
    // The first and the second are in different pieces.
    let mut many = random(60_000, 4.0);
    (many[20_001][1], many[50_000][0]) = (f32::INFINITY, f32::NAN);
    let second = RefusedPoint { index: 20_001, ..first };
    for threads in [1, 2, 3, 50] {
        for (points, error) in [(&points, first), (&many, second)] {
            let refused =
                with_threads(threads, || bvh::closest_points(&tree, points, &Budget::EXACT));
            assert_eq!(refused.map(|a| a.len()), Err(error));
            let (before, refused) =
                bvh::closest_points_until_refused(&tree, points, &Budget::EXACT);
            assert_eq!((before.len(), refused), (error.index, Some(error)));
        }
    }
}
