//! A coherent query answers with the bits of the plain query, wherever the query goes, and its safe
//! radius is safe.

use meshsweep::bvh::{TreeOptions, build};
use meshsweep::mesh::Mesh;
use meshsweep::progress::Watch;
use meshsweep_core::{
    Budget, Bvh, ClosestPoint, CoherentClosest, CoherentQuery, Ended, QueryError, ScratchEntry,
};
use meshsweep_host_tests::generate::{
    Rng, Triangles, bracket, cube, icosphere, joined, needle_comb, rough_sphere, scaled, torus,
    transformed,
};
use meshsweep_host_tests::oracle::rough_distance_sq;

fn blob((positions, triangles): &Triangles, single: bool) -> Vec<u8> {
    let mesh = Mesh::new(positions.clone(), triangles.clone());
    let options = TreeOptions::default().with_segments(false).with_f32(single);
    build(mesh.as_input(), &options, Watch::NONE).expect("builds").0.to_bytes()
}

fn stack(tree: &Bvh<'_>) -> Vec<ScratchEntry> {
    vec![ScratchEntry::EMPTY; tree.header().stack_entries as usize]
}

/// A closed part, a rough one, needles, a soup with repeats and triangles without area, one far
/// from its origin, small ones.
fn meshes() -> Vec<(&'static str, Triangles)> {
    let (positions, mut triangles) = rough_sphere(3, 0.3, 9);
    triangles.extend_from_within(..40);
    triangles.extend([[0, 0, 1], [2, 2, 2], [3, 4, 3], [0, 1, 9]]);
    let tenth = [[0.1, 0.0, 0.0], [0.0, 0.1, 0.0], [0.0, 0.0, 0.1]];
    vec![
        ("torus", torus(2.0, 0.75, 60, 40)),
        ("soup", (positions, triangles)),
        ("needles", needle_comb()),
        ("bracket", bracket()),
        ("flat faces", cube(12)),
        ("far from its origin", transformed(&bracket(), tenth, [900.0, -7.0, 0.5])),
        ("tiny", scaled(&icosphere(3), 1.0e-30)),
        (
            "two triangles",
            (
                vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.5]],
                vec![[0, 1, 2], [1, 3, 2]],
            ),
        ),
    ]
}

fn extent((positions, _): &Triangles) -> ([f32; 3], [f32; 3], f32) {
    let (mut low, mut high) = ([f32::MAX; 3], [f32::MIN; 3]);
    for p in positions {
        for axis in 0..3 {
            low[axis] = low[axis].min(p[axis]);
            high[axis] = high[axis].max(p[axis]);
        }
    }
    let diagonal = (0..3).map(|k| f64::from(high[k] - low[k]).powi(2)).sum::<f64>().sqrt();
    (low, high, diagonal as f32)
}

/// A walk with steps of a part of the diagonal, kept within a box of twice the mesh's.
fn walk(mesh: &Triangles, step: f32, count: usize, rng: &mut Rng) -> Vec<[f32; 3]> {
    let (low, high, diagonal) = extent(mesh);
    let mut p = rng.point_in(low, high);
    let mut way = rng.direction();
    (0..count)
        .map(|_| {
            let turn = rng.direction();
            for axis in 0..3 {
                way[axis] += 0.05 * turn[axis];
                let (middle, half) =
                    (low[axis] / 2.0 + high[axis] / 2.0, high[axis] - low[axis] + 0.1 * diagonal);
                if (p[axis] - middle).abs() > half {
                    way[axis] = (middle - p[axis]) / half;
                }
            }
            let length = way.iter().map(|x| x * x).sum::<f32>().sqrt();
            for axis in 0..3 {
                way[axis] /= length;
                p[axis] += way[axis] * step * diagonal;
            }
            p
        })
        .collect()
}

fn jumps(mesh: &Triangles, count: usize, rng: &mut Rng) -> Vec<[f32; 3]> {
    let (low, high, diagonal) = extent(mesh);
    let wide = |x: [f32; 3], by: f32| x.map(|x| x + by * diagonal);
    (0..count).map(|_| rng.point_in(wide(low, -0.5), wide(high, 0.5))).collect()
}

/// Walks, pauses, jumps, points of the surface and points far away, one after the other.
fn journey(mesh: &Triangles, count: usize, seed: u64) -> Vec<[f32; 3]> {
    let mut rng = Rng::new(seed);
    let mut points = Vec::new();
    for step in [1.0e-6, 1.0e-5, 1.0e-4, 3.0e-4, 1.0e-3, 1.0e-2] {
        points.extend(walk(mesh, step, count, &mut rng));
        points.extend_from_within(points.len() - 3..);
        points.extend(jumps(mesh, 40, &mut rng));
    }
    points.extend(mesh.0.iter().take(60));
    let (_, _, diagonal) = extent(mesh);
    points.extend(
        [1.0e3, 1.0e7, 1.0e9].map(|far| [far * diagonal, -far * diagonal, 0.5 * far * diagonal]),
    );
    points.extend(walk(mesh, 1.0e-4, count, &mut rng));
    points
}

fn bits(answer: &ClosestPoint) -> (u32, u32, [u32; 3], Option<u32>, Ended) {
    (
        answer.distance.lower.to_bits(),
        answer.distance.upper.to_bits(),
        answer.point.map(f32::to_bits),
        answer.triangle,
        answer.ended,
    )
}

fn same_bits<'t, const N: usize>(
    name: &str,
    query: &mut CoherentQuery<'t, N>,
    tree: &Bvh<'t>,
    points: &[[f32; 3]],
) -> Vec<CoherentClosest> {
    let mut stack = stack(tree);
    points
        .iter()
        .map(|&p| {
            let plain = tree.closest_point(p, Budget::EXACT, &mut stack).unwrap();
            let followed = query.closest_point(tree, p, Budget::EXACT, &mut stack).unwrap();
            assert_eq!(
                bits(&followed.closest),
                bits(&plain),
                "{name}, {p:?}: {followed:?}, {plain:?}"
            );
            followed
        })
        .collect()
}

#[test]
fn a_coherent_query_has_the_bits_of_the_plain_query() {
    for (name, mesh) in meshes() {
        for single in [false, true] {
            let bytes = blob(&mesh, single);
            let tree = Bvh::open(&bytes).unwrap();
            same_bits(name, &mut CoherentQuery::<128>::new(), &tree, &journey(&mesh, 400, 5));
        }
    }
}

#[test]
fn a_front_of_any_size_will_do() {
    for (name, mesh) in meshes() {
        let bytes = blob(&mesh, false);
        let tree = Bvh::open(&bytes).unwrap();
        let points = journey(&mesh, 120, 8);
        same_bits(name, &mut CoherentQuery::<0>::new(), &tree, &points);
        same_bits(name, &mut CoherentQuery::<1>::new(), &tree, &points);
        same_bits(name, &mut CoherentQuery::<7>::new(), &tree, &points);
        same_bits(name, &mut CoherentQuery::<9>::new(), &tree, &points);
        same_bits(name, &mut CoherentQuery::<24>::new(), &tree, &points);
        same_bits(name, &mut CoherentQuery::<2048>::new(), &tree, &points);
    }
}

#[test]
fn a_coherent_query_may_change_trees_and_be_reset() {
    let (one, other) = (torus(2.0, 0.75, 60, 40), rough_sphere(3, 0.3, 9));
    let (first, second) = (blob(&one, false), blob(&other, false));
    let trees = [Bvh::open(&first).unwrap(), Bvh::open(&second).unwrap()];
    let mut query = CoherentQuery::<64>::new();
    let points = walk(&one, 1.0e-4, 600, &mut Rng::new(3));
    for (turn, points) in points.chunks(50).enumerate() {
        same_bits("changing", &mut query, &trees[turn % 2], points);
        if turn % 3 == 0 {
            query.reset();
        }
    }
}

#[test]
fn a_walk_around_is_followed_with_little_work() {
    let mesh = torus(2.0, 0.75, 120, 80);
    let bytes = blob(&mesh, false);
    let tree = Bvh::open(&bytes).unwrap();
    let points = walk(&mesh, 1.0e-4, 3000, &mut Rng::new(1));
    let mut query = CoherentQuery::<128>::new();
    let followed = same_bits("torus", &mut query, &tree, &points);
    let opened: u32 = followed.iter().map(|f| f.closest.work.opened).sum();
    let mut stack = stack(&tree);
    let plain: u32 = points
        .iter()
        .map(|&p| tree.closest_point(p, Budget::EXACT, &mut stack).unwrap().work.opened)
        .sum();
    assert!(opened < plain / 10, "{opened} nodes against {plain}");
}

#[test]
fn jumps_cost_hardly_more_than_plain_queries() {
    let mesh = torus(2.0, 0.75, 120, 80);
    let bytes = blob(&mesh, false);
    let tree = Bvh::open(&bytes).unwrap();
    let mut stack = stack(&tree);
    let points = jumps(&mesh, 4000, &mut Rng::new(1));
    let mut query = CoherentQuery::<128>::new();
    let (mut with, mut without) = (0, 0);
    for p in points {
        let cost = |answer: &ClosestPoint| answer.work.opened + answer.work.triangles / 3;
        with += cost(&query.closest_point(&tree, p, Budget::EXACT, &mut stack).unwrap().closest);
        without += cost(&tree.closest_point(p, Budget::EXACT, &mut stack).unwrap());
    }
    assert!(with < without + without / 10, "{with} against {without}");
}

#[test]
fn a_long_rest_ends_when_steps_get_short() {
    let mesh = torus(2.0, 0.75, 120, 80);
    let bytes = blob(&mesh, false);
    let tree = Bvh::open(&bytes).unwrap();
    let mut rng = Rng::new(4);
    let mut query = CoherentQuery::<128>::new();
    same_bits("jumps", &mut query, &tree, &jumps(&mesh, 3000, &mut rng));
    let followed = same_bits("walk", &mut query, &tree, &walk(&mesh, 1.0e-5, 60, &mut rng));
    let opened: u32 = followed[20..].iter().map(|f| f.closest.work.opened).sum();
    assert!(opened < 40, "{opened} nodes");
}

#[test]
fn a_very_long_path_stays_cheap_and_has_the_same_bits() {
    let mesh = icosphere(3);
    let bytes = blob(&mesh, false);
    let tree = Bvh::open(&bytes).unwrap();
    let mut stack = stack(&tree);
    let mut query = CoherentQuery::<64>::new();
    let (mut late, mut early) = (0, 0);
    for i in 0..400_000u32 {
        let t = f64::from(i) * 1.0e-3;
        let p = [1.3 * t.cos(), 1.3 * t.sin(), 0.4 * (0.1 * t).sin()].map(|x| x as f32);
        let followed = query.closest_point(&tree, p, Budget::EXACT, &mut stack).unwrap();
        let tested = followed.closest.work.triangles;
        match i {
            0..50_000 => early += tested,
            350_000.. => late += tested,
            _ => {}
        }
        if i % 97 == 0 {
            let plain = tree.closest_point(p, Budget::EXACT, &mut stack).unwrap();
            assert_eq!(bits(&followed.closest), bits(&plain), "{p:?}");
        }
    }
    assert!(late < early + early / 5, "{late} triangles at the end, {early} at the start");
}

#[test]
fn tolerances_and_budgets_are_kept() {
    let mesh = torus(2.0, 0.75, 60, 40);
    let bytes = blob(&mesh, false);
    let tree = Bvh::open(&bytes).unwrap();
    let mut stack = stack(&tree);
    let mut query = CoherentQuery::<128>::new();
    let mut rng = Rng::new(2);
    for p in walk(&mesh, 1.0e-4, 200, &mut rng).into_iter().chain(jumps(&mesh, 200, &mut rng)) {
        for stop in [Budget::EXACT.with_relative(0.1), Budget::EXACT.with_absolute(0.05)] {
            let followed = query.closest_point(&tree, p, stop, &mut stack).unwrap();
            let plain = tree.closest_point(p, stop, &mut stack).unwrap();
            assert_eq!(bits(&followed.closest), bits(&plain));
        }
        let exact = tree.closest_point(p, Budget::EXACT, &mut stack).unwrap();
        for steps in [0, 1, 2, 5] {
            let stop = Budget::EXACT.with_steps(steps);
            let closest = query.closest_point(&tree, p, stop, &mut stack).unwrap().closest;
            assert!(closest.work.opened <= 2 * steps, "{closest:?}");
            assert!(
                closest.distance.lower <= exact.distance.upper
                    && closest.distance.upper >= exact.distance.lower,
                "{closest:?}"
            );
            if closest.ended == Ended::Exact {
                assert_eq!(bits(&closest), bits(&exact));
            }
        }
    }
}

#[test]
fn what_is_refused_leaves_the_query_as_it_was() {
    let mesh = torus(2.0, 0.75, 20, 12);
    let bytes = blob(&mesh, false);
    let tree = Bvh::open(&bytes).unwrap();
    let mut stack = stack(&tree);
    let mut query = CoherentQuery::<32>::new();
    for p in walk(&mesh, 1.0e-4, 100, &mut Rng::new(2)) {
        let nan = query.closest_point(&tree, [f32::NAN, 0.0, 0.0], Budget::EXACT, &mut stack);
        assert_eq!(nan, Err(QueryError::NotFinite));
        assert_eq!(
            query.closest_point(&tree, p, Budget::EXACT, &mut []),
            Err(QueryError::NoScratch)
        );
        let wrong = Budget::EXACT.with_relative(-1.0);
        assert_eq!(query.closest_point(&tree, p, wrong, &mut stack), Err(QueryError::Tolerance));
        same_bits("after errors", &mut query, &tree, &[p]);
    }
}

/// Against every triangle of the input in f64.
#[test]
fn within_the_safe_radius_the_triangle_stays_the_closest() {
    let mut found = 0;
    let parts = joined(
        &torus(2.0, 0.75, 24, 16),
        &transformed(
            &cube(2),
            [[0.7, 0.0, 0.0], [0.0, 0.7, 0.0], [0.0, 0.0, 0.7]],
            [4.0, 1.0, 0.2],
        ),
    );
    for (mesh, single) in
        [(parts, false), (rough_sphere(2, 0.3, 9), false), (rough_sphere(2, 0.3, 9), true)]
    {
        let bytes = blob(&mesh, single);
        let tree = Bvh::open(&bytes).unwrap();
        let mut rng = Rng::new(6);
        let corners = |triangle: usize| mesh.1[triangle].map(|v| mesh.0[v as usize]);
        for step in [1.0e-6, 1.0e-4, 1.0e-3] {
            let mut points = walk(&mesh, step, 300, &mut rng);
            points.extend(jumps(&mesh, 60, &mut rng));
            points.extend(walk(&mesh, step, 100, &mut rng));
            let followed = same_bits("safe", &mut CoherentQuery::<128>::new(), &tree, &points);
            for (p, followed) in points.iter().zip(followed) {
                let radius = f64::from(followed.safe_radius);
                if radius == 0.0 {
                    continue;
                }
                found += 1;
                let triangle = followed.closest.triangle.unwrap() as usize;
                for _ in 0..4 {
                    let way = rng.direction();
                    let moved: [f32; 3] = core::array::from_fn(|k| {
                        (f64::from(p[k]) + f64::from(way[k]) * radius * 0.9999) as f32
                    });
                    let distance_sq: f64 =
                        (0..3).map(|k| (f64::from(moved[k]) - f64::from(p[k])).powi(2)).sum();
                    if distance_sq > radius * radius {
                        continue;
                    }
                    let own = rough_distance_sq(moved, corners(triangle));
                    let least = (0..mesh.1.len())
                        .map(|other| rough_distance_sq(moved, corners(other)))
                        .fold(f64::INFINITY, f64::min);
                    assert!(
                        own <= least * (1.0 + 1.0e-12),
                        "{p:?} {followed:?}, {moved:?}: {own} {least}"
                    );
                }
            }
        }
    }
    assert!(found > 300, "{found}");
}
