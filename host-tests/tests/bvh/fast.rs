//! Questions that are compiled for one kind of processor have the bits of all others, and an exact
//! answer does not depend on the order of the search.

use meshsweep::bvh::{FastBvh, TreeOptions, build};
use meshsweep::mesh::Mesh;
use meshsweep::progress::Watch;
use meshsweep_core::{
    Budget, Bvh, ClosestPoint, Decided, Ended, Facing, FirstHit, Hint, Hit, QueryError,
    ScratchEntry, Verdict,
};
use meshsweep_host_tests::generate::{Rng, Triangles, rough_sphere, scaled, torus};

/// Round and rough, tiny and huge, flat needles, with vertices on the grid and in f32.
fn blobs() -> Vec<(Vec<u8>, f32)> {
    let needles = |count: u32| -> Triangles {
        let mut rng = Rng::new(3);
        let mut positions = Vec::new();
        for _ in 0..count {
            let from = rng.point_in([-1.0; 3], [1.0; 3]);
            let to = rng.point_in([-1.0; 3], [1.0; 3]);
            positions.extend([from, to, to.map(|x| x + 1.0e-3)]);
        }
        (positions, (0..count).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect())
    };
    let meshes = [
        (torus(2.0, 0.75, 60, 40), 4.0),
        (rough_sphere(3, 0.3, 2), 2.0),
        (scaled(&rough_sphere(2, 0.3, 5), 1.0e30), 2.0e30),
        (scaled(&torus(2.0, 0.75, 20, 12), 1.0e-30), 4.0e-30),
        (needles(300), 1.5),
        (needles(1), 1.5),
    ];
    let options = [false, true].map(|is_f32| TreeOptions::default().with_f32(is_f32));
    let build = |(positions, triangles): &Triangles, options| {
        let mesh = Mesh::new(positions.clone(), triangles.clone());
        build(mesh.as_input(), options, Watch::NONE).expect("builds").0.to_bytes()
    };
    meshes
        .iter()
        .flat_map(|(mesh, size)| options.iter().map(move |options| (build(mesh, options), *size)))
        .collect()
}

/// Around and on the model, at places where many triangles are as near, far away.
fn points(tree: &Bvh<'_>, size: f32) -> Vec<[f32; 3]> {
    let mut rng = Rng::new(9);
    let mut points: Vec<_> =
        (0..400).map(|_| rng.point_in([-1.5 * size; 3], [1.5 * size; 3])).collect();
    let mut stack = vec![ScratchEntry::EMPTY; tree.scratch_entries()];
    let closest = |p: &[f32; 3]| tree.closest_point(*p, Budget::EXACT, &mut stack).unwrap().point;
    let on_surface: Vec<_> = points.iter().take(200).map(closest).collect();
    points.extend(on_surface);
    points.extend([[0.0; 3], [1.0e5 * size, 0.0, 0.0], [1.0e7 * size, -size, 0.0]]);
    points.extend([[f32::MAX, f32::MIN, 0.0], [f32::MIN_POSITIVE; 3]]);
    points
}

fn bits(answer: &ClosestPoint) -> ([u32; 5], Option<u32>, Ended) {
    let [x, y, z] = answer.point;
    let numbers = [answer.distance.lower, answer.distance.upper, x, y, z];
    (numbers.map(f32::to_bits), answer.triangle, answer.ended)
}

#[test]
fn a_processors_own_instructions_give_the_same_bits() {
    for (blob, size) in blobs() {
        let tree = Bvh::open(&blob).unwrap();
        let fast = FastBvh::new(tree);
        let enough = tree.scratch_entries();
        let budgets =
            [Budget::EXACT, Budget::EXACT.with_relative(0.1), Budget::EXACT.with_steps(3)];
        let [mut hint, mut fast_hint] = [Hint::NONE; 2];
        for (budget, entries) in
            budgets.into_iter().flat_map(|budget| [enough, 2 * enough, 3].map(|n| (budget, n)))
        {
            let mut stack = vec![ScratchEntry::EMPTY; entries];
            for p in points(&tree, size) {
                let plain = tree.closest_point(p, budget, &mut stack).unwrap();
                let own = fast.closest_point(p, budget, &mut stack).unwrap();
                assert_eq!(bits(&plain), bits(&own), "{p:?}, {budget:?}, {entries}");
                let plain = tree.closest_point_from(p, &mut hint, budget, &mut stack).unwrap();
                let own = fast.closest_point_from(p, &mut fast_hint, budget, &mut stack).unwrap();
                assert_eq!(bits(&plain), bits(&own), "{p:?}, {budget:?}, {entries}, from a hint");
                assert_eq!(hint, fast_hint, "{p:?}");
            }
        }
    }
}

#[test]
fn a_processors_own_instructions_do_the_same_work() {
    for (blob, size) in blobs() {
        let tree = Bvh::open(&blob).unwrap();
        let fast = FastBvh::new(tree);
        let mut stack = vec![ScratchEntry::EMPTY; tree.scratch_entries()];
        for p in points(&tree, size) {
            let plain = tree.closest_point(p, Budget::EXACT, &mut stack).unwrap();
            let own = fast.closest_point(p, Budget::EXACT, &mut stack).unwrap();
            assert_eq!(plain.work, own.work, "{p:?}");
        }
    }
}

/// Across the model and past it, from and to its surface, within it, along axes, of no length, out
/// of range.
fn segments(tree: &Bvh<'_>, size: f32) -> Vec<[[f32; 3]; 2]> {
    let places = points(tree, size);
    let mut rng = Rng::new(11);
    let mut segments: Vec<_> =
        (0..1500).map(|_| [0; 2].map(|_| places[rng.below(places.len())])).collect();
    for axis in 0..3 {
        for &from in &places[..100] {
            let mut to = from.map(|x| 0.5 * x);
            segments.push([from, to]);
            to = from;
            to[axis] = -from[axis];
            segments.push([from, to]);
        }
    }
    segments.extend(places[400..600].iter().map(|&place| [place; 2]));
    segments
}

fn hit_bits(
    answer: Result<FirstHit, QueryError>,
) -> Result<([u32; 6], Option<u32>, Ended), QueryError> {
    answer.map(|answer| {
        let Hit { t, point: [x, y, z], triangle } = answer.hit.unwrap_or(Hit::EMPTY);
        let numbers = [answer.t.lower, answer.t.upper, t, x, y, z];
        (numbers.map(f32::to_bits), triangle, answer.ended)
    })
}

#[test]
fn segments_with_a_processors_own_instructions_have_the_same_bits() {
    for (blob, size) in blobs() {
        let tree = Bvh::open(&blob).unwrap();
        let fast = FastBvh::new(tree);
        let enough = tree.scratch_entries();
        let (mut hits, mut meetings) = (0, 0);
        for (budget, entries) in [
            (Budget::EXACT, enough),
            (Budget::EXACT, 2 * enough),
            (Budget::EXACT, 3),
            (Budget::EXACT.with_steps(3), enough),
        ] {
            let mut stack = vec![ScratchEntry::EMPTY; entries];
            for [a, b] in segments(&tree, size) {
                for facing in [Facing::Both, Facing::Front, Facing::Back] {
                    let plain = hit_bits(tree.first_hit(a, b, facing, budget, &mut stack));
                    let own = hit_bits(fast.first_hit(a, b, facing, budget, &mut stack));
                    assert_eq!(plain, own, "{a:?} {b:?}, {facing:?}, {budget:?}, {entries}");
                    hits += u32::from(plain.is_ok_and(|(_, triangle, _)| triangle.is_some()));
                    let verdict = |found: Result<Decided<()>, _>| found.map(|found| found.verdict);
                    let plain = verdict(tree.any_hit(a, b, facing, budget, &mut stack));
                    let own = verdict(fast.any_hit(a, b, facing, budget, &mut stack));
                    assert_eq!(plain, own, "{a:?} {b:?}, {facing:?}, {budget:?}, {entries}");
                    meetings += u32::from(plain == Ok(Verdict::Yes));
                }
            }
        }
        assert!(hits > 10 && (meetings > 10 || tree.triangle_count() == 1), "{hits} {meetings}");
    }
}

/// With one entry less than the tree names, hosts search in the order of boards.
#[test]
fn an_exact_answer_does_not_depend_on_the_order_of_the_search() {
    for (blob, size) in blobs() {
        let tree = Bvh::open(&blob).unwrap();
        let enough = tree.scratch_entries();
        let [mut stack, mut short] =
            [enough, enough - 1].map(|entries| vec![ScratchEntry::EMPTY; entries]);
        for p in points(&tree, size) {
            let in_blocks = tree.closest_point(p, Budget::EXACT, &mut stack).unwrap();
            let in_entries = tree.closest_point(p, Budget::EXACT, &mut short).unwrap();
            assert_eq!(bits(&in_blocks), bits(&in_entries), "{p:?}");
        }
    }
}

/// A closest point may take other steps in another order. A question that goes on with the steps
/// that are left has to count them in one order: one entry less than `scratch_entries` forces the
/// order of boards, and no more than that.
#[test]
fn answers_after_a_closest_point_do_not_depend_on_its_order() {
    let (positions, triangles) = rough_sphere(3, 0.3, 2);
    let mesh = Mesh::new(positions, triangles);
    let options = TreeOptions::default().with_winding(true).with_f32(true);
    let blob = build(mesh.as_input(), &options, Watch::NONE).expect("builds").0.to_bytes();
    let tree = Bvh::open(&blob).unwrap();
    let nodes = tree.header().nodes;
    let entries = tree.scratch_entries();
    let mut stack = vec![ScratchEntry::EMPTY; entries];
    let mut rng = Rng::new(17);
    let mut other_orders = 0;
    for _ in 0..3000 {
        let point = rng.point_in([-1.5; 3], [1.5; 3]);
        let mut splits = |entries: usize| {
            let stack = &mut stack[..entries];
            tree.closest_point(point, Budget::EXACT, stack).unwrap().work.opened
        };
        if splits(entries) == splits(entries - 1) {
            continue;
        }
        other_orders += 1;
        for budget in (nodes..2 * nodes).map(|steps| Budget::EXACT.with_steps(steps)) {
            let mut of = |entries: usize| {
                let stack = &mut stack[..entries];
                let signed = tree.signed_distance_by_winding(point, budget, stack).unwrap();
                let precise = tree.closest_point_precise(point, budget, stack).unwrap();
                (signed.side, signed.closest.ended, bits(&precise))
            };
            assert_eq!(of(entries), of(entries - 1), "{point:?}, {budget:?}");
        }
    }
    let has_two_orders = cfg!(any(target_arch = "x86_64", target_arch = "aarch64"));
    assert_eq!(other_orders > 0, has_two_orders);
}
