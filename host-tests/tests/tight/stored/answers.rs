//! Intervals and verdicts against every triangle of the mesh, in 106 bits.

use super::{mesh, of, options};
use meshsweep::mesh::Mesh;
use meshsweep::surface::VertexBits;
use meshsweep::tight::{HullReport, hull_mesh};
use meshsweep_core::{
    Blob, Budget, BuildFor, Ended, QueryError, ScratchEntry, TightHull, TightHulls, Verdict,
};
use meshsweep_host_tests::generate::{
    Rng, Triangles, bracket, groove_block, icosphere, rough_sphere, scaled, torus, transformed,
    two_parts,
};
use meshsweep_host_tests::oracle::{distance_to_mesh, distance_to_triangle, winding_number};
use std::sync::LazyLock;

/// Points everywhere: far, around, on the surface of mesh and hull, at corners of both, and within.
fn points(of: &Mesh, hull: &Mesh, count: usize, rng: &mut Rng) -> Vec<[f32; 3]> {
    let bound = |pick: fn(f32, f32) -> f32, axis: usize| {
        hull.positions.iter().map(|p| p[axis]).reduce(pick).expect("a vertex")
    };
    let low = [0, 1, 2].map(|axis| bound(f32::min, axis));
    let high = [0, 1, 2].map(|axis| bound(f32::max, axis));
    let size = (0..3).map(|axis| high[axis] - low[axis]).fold(0.0, f32::max);
    (0..count)
        .map(|index| {
            let surface = if index % 2 == 0 { of } else { hull };
            let corners = surface.corners(rng.below(surface.triangles.len())).expect("a triangle");
            let (mut u, mut v) = (rng.unit_f32(), rng.unit_f32());
            if u + v > 1.0 {
                (u, v) = (1.0 - u, 1.0 - v);
            }
            let [a, b, c] = corners;
            let on = [0, 1, 2].map(|k| a[k] + u * (b[k] - a[k]) + v * (c[k] - a[k]));
            match index / 2 % 6 {
                0 => rng.point_in(low.map(|x| x - size), high.map(|x| x + size)),
                1 => rng.point_in(low, high),
                2 => on,
                3 => a,
                4 => {
                    let way = rng.direction();
                    [0, 1, 2].map(|k| on[k] + 0.02 * size * way[k])
                }
                _ => {
                    let way = rng.direction();
                    [0, 1, 2].map(|k| 3e5 * size * way[k])
                }
            }
        })
        .collect()
}

/// Every answer of the hull about the triangles holds; returns how many distances were said to be
/// greater, and smaller, than half and twice them.
fn check(
    name: &str,
    hull: &TightHull<'_>,
    truth: &Triangles,
    points: &[[f32; 3]],
    moved: f64,
) -> [usize; 2] {
    let mut stack = vec![ScratchEntry::EMPTY; hull.bvh().header().stack_entries as usize];
    let (mut clear, mut near) = (0, 0);
    for &p in points {
        let real = distance_to_mesh(p, &truth.0, &truth.1);
        let answer =
            hull.closest_point(p, Budget::EXACT, &mut stack).expect("asked of an opened hull");
        let (lower, upper) = (f64::from(answer.distance.lower), f64::from(answer.distance.upper));
        assert!(lower <= real.upper && upper >= real.lower, "{name}: {p:?}: {answer:?}, {real:?}");
        assert!(
            lower >= 0.0 && answer.triangle.is_none() && answer.ended == Ended::Resolution,
            "{name}: {answer:?}"
        );
        // Not an interval that says nothing: no wider than hull and mesh are apart.
        let record = hull.record();
        // Slivers widen the tree's own interval.
        let extent = truth.0.iter().flatten().fold(0f32, |most, x| most.max(x.abs()));
        let slop = 1e-3 * (upper + f64::from(extent)) + 4.0 * moved;
        assert!(
            upper - lower <= f64::from(record.slack) + f64::from(record.depth) + slop,
            "{name}: {answer:?}"
        );
        for distance in [0.0, 0.5 * real.lower, real.lower, real.upper, 2.0 * real.upper, upper] {
            let distance = distance as f32;
            let within = hull.within(p, distance, Budget::EXACT, &mut stack).expect("a distance");
            match within.verdict {
                Verdict::Yes => {
                    assert!(f64::from(distance) >= real.lower, "{name}: {p:?} {distance}")
                }
                Verdict::No => {
                    assert!(f64::from(distance) < real.upper, "{name}: {p:?} {distance}")
                }
                _ => {}
            }
            clear += usize::from(within.is_clear());
            near += usize::from(within.verdict == Verdict::Yes);
            assert!(within.witness.is_none(), "{name}: a hull knows no triangles");
        }
    }
    [clear, near]
}

/// A shape, and a blob of its hulls of 64 and of 90 faces.
struct Solid {
    name: &'static str,
    shape: Triangles,
    bytes: Vec<u8>,
    reports: Vec<HullReport>,
}

/// With vertices as they come: to build them takes most of the time of what asks them.
static SOLIDS: LazyLock<Vec<Solid>> = LazyLock::new(|| {
    let solid = |(name, shape): (&'static str, Triangles)| {
        let (bytes, reports) = of(&mesh(&shape), 0.0, &options(&[64, 90]));
        Solid { name, shape, bytes, reports }
    };
    shapes().into_iter().map(solid).collect()
});

fn shapes() -> Vec<(&'static str, Triangles)> {
    let mut open = rough_sphere(2, 0.4, 9);
    open.1.truncate(200);
    let shear = [[1.0, 0.5, 0.0], [0.0, 1e-3, 0.0], [0.0, 0.3, 1.0]];
    vec![
        ("torus", torus(2.0, 0.75, 16, 10)),
        ("bracket", bracket()),
        ("groove", groove_block()),
        ("an open sphere", open),
        ("two parts", two_parts()),
        ("a sheared plate of slivers", transformed(&rough_sphere(2, 0.2, 3), shear, [0.0; 3])),
        ("far from the origin", transformed(&icosphere(2), IDENTITY, [3000.0, -2000.0, 100.0])),
    ]
}

const IDENTITY: [[f32; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

#[test]
fn intervals_and_verdicts_hold_for_the_mesh_within() {
    let (mut clear, mut near) = (0, 0);
    let mut ask = |name: &str, shape: &Triangles, bytes: &[u8]| {
        let hulls = TightHulls::open(bytes).expect("opens");
        for index in 0..hulls.count() {
            let hull = hulls.get(index).expect("a hull");
            let points =
                points(&mesh(shape), &hull_mesh(&hull), 120, &mut Rng::new(7 + u64::from(index)));
            let [no, yes] = check(name, &hull, shape, &points, 0.0);
            (clear, near) = (clear + no, near + yes);
        }
    };
    for Solid { name, shape, bytes, .. } in &*SOLIDS {
        ask(name, shape, bytes);
    }
    // How vertices are stored has nothing to do with how a hull begins, which takes long where a
    // mesh is open or has parts. Round, flat and sliver faces, and what is far away, are left.
    let is_slow = |name: &str| ["an open sphere", "groove", "two parts"].contains(&name);
    for (name, shape) in shapes().into_iter().filter(|(name, _)| !is_slow(name)) {
        let options = options(&[64]).with_vertex_bits(VertexBits::F32);
        ask(name, &shape, &of(&mesh(&shape), 0.0, &options).0);
    }
    // The hulls do tell: of 12,960 verdicts two in six can be no, and three yes.
    assert!(clear > 1575 && near > 2565, "{clear} {near}");
}

#[test]
fn answers_hold_at_the_ends_of_single_precision() {
    for scale in [1e-30, 1e30] {
        let shape = scaled(&torus(2.0, 0.75, 12, 8), scale);
        let mesh = mesh(&shape);
        let (bytes, _) = of(&mesh, 0.0, &options(&[64]));
        let hull = TightHulls::open(&bytes).expect("opens").finest().expect("a hull");
        let points = points(&mesh, &hull_mesh(&hull), 150, &mut Rng::new(3));
        let [clear, near] = check("at an end", &hull, &shape, &points, 0.0);
        assert!(clear > 100 && near > 100, "{scale}: {clear} {near}");
    }
}

#[test]
fn answers_hold_for_the_mesh_before_its_vertices_were_moved() {
    let shape = rough_sphere(2, 0.3, 4);
    let rng = &mut Rng::new(12);
    let by = 0.02f32;
    let mut stored = shape.clone();
    for p in &mut stored.0 {
        let way = rng.direction();
        *p = [0, 1, 2].map(|k| p[k] + 0.99 * by * way[k]);
    }
    let mesh = mesh(&stored);
    let (bytes, _) = of(&mesh, f64::from(by), &options(&[70]));
    let hull = TightHulls::open(&bytes).expect("opens").finest().expect("a hull");
    let points = points(&mesh, &hull_mesh(&hull), 300, rng);
    check("moved", &hull, &shape, &points, f64::from(by));
}

#[test]
fn no_point_of_a_face_is_farther_from_the_mesh_than_the_face_says() {
    for Solid { name, shape, bytes, reports } in &*SOLIDS {
        let hull = TightHulls::open(bytes).expect("opens").get(0).expect("a hull");
        let faces = hull_mesh(&hull);
        let rng = &mut Rng::new(2);
        let (mut most, mut said) = (0f64, 0f32);
        for face in 0..faces.triangles.len() {
            let slack = hull.slack(face as u32).expect("a face");
            said = said.max(slack);
            let [a, b, c] = faces.corners(face).expect("a face");
            for sample in 0..6 {
                let (u, v) = (rng.unit_f32(), rng.unit_f32());
                let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
                // Rounded, and with that beside the face by less than is allowed for below.
                let p = if sample == 0 {
                    a
                } else {
                    [0, 1, 2].map(|k| a[k] + u * (b[k] - a[k]) + v * (c[k] - a[k]))
                };
                let beside = distance_to_triangle(p, [a, b, c]).upper;
                let real = distance_to_mesh(p, &shape.0, &shape.1);
                assert!(
                    real.lower - beside <= f64::from(slack),
                    "{name}, face {face}: {p:?} {real:?} {slack}"
                );
                most = most.max(real.upper);
            }
        }
        let record = hull.record();
        // Next to walls that the hull all but touches, the search for the bound ends before it is
        // within a twentieth.
        let extent = shape.0.iter().flatten().fold(0f32, |most, x| most.max(x.abs()));
        let found = 1.06 * reports[0].distances.slack.lower + 1e-3 * f64::from(extent);
        assert!(
            said <= record.slack && f64::from(record.slack) <= found,
            "{name}: {record:?} {found}"
        );
        assert!(most > 0.3 * reports[0].distances.slack.lower, "{name}: {most} of {record:?}");
        // Vertices that no triangle has are not the mesh's.
        for p in shape.1.iter().flatten().map(|&v| &shape.0[v as usize]) {
            let real = distance_to_mesh(*p, &faces.positions, &faces.triangles);
            assert!(real.lower <= f64::from(record.depth), "{name}: {p:?}");
        }
    }
}

/// Off the surface a side is always told: outside the lower end is the hull's distance, inside it
/// is less by the hull's depth. Half of the points have coordinates of the hull's vertices.
#[test]
fn within_the_box_the_side_is_that_of_the_winding_number() {
    let shapes = [torus(2.0, 0.75, 16, 10), bracket(), two_parts()];
    let mut sides = [0; 2];
    for (round, shape) in shapes.iter().enumerate() {
        let kinds = [VertexBits::Grid16, VertexBits::F32];
        for (bits, segments) in kinds.into_iter().flat_map(|bits| [(bits, true), (bits, false)]) {
            let options = options(&[90]).with_vertex_bits(bits).with_boxes(true, segments);
            let (bytes, _) = of(&mesh(shape), 0.0, &options);
            let hull = TightHulls::open(&bytes).expect("opens").finest().expect("a hull");
            assert_eq!(hull.bvh().header().is_f32(), bits == VertexBits::F32);
            let (surface, depth) = (hull_mesh(&hull), hull.record().depth);
            let [low, high] = hull.bvh().bounds();
            let size = (0..3).map(|axis| high[axis] - low[axis]).fold(0.0, f32::max);
            let rng = &mut Rng::new(31 + round as u64);
            let mut stack = [ScratchEntry::EMPTY; 128];
            for index in 0..400 {
                let mut p = rng.point_in(low, high);
                if index % 2 == 0 {
                    p = [0, 1, 2].map(|k| surface.positions[rng.below(surface.positions.len())][k]);
                }
                let near = hull.bvh().closest_point(p, Budget::EXACT, &mut stack).expect("asked");
                let lower = near.distance.lower;
                if lower < 1e-4 * size {
                    continue;
                }
                let number = winding_number(
                    p.map(f64::from),
                    &surface.positions,
                    &surface.triangles,
                    f64::from(size),
                );
                assert!((number - number.round()).abs() < 1e-6, "{number}");
                let answer = hull.closest_point(p, Budget::EXACT, &mut stack).expect("asked");
                let is_outside = number.round() == 0.0;
                let inside = (f64::from(lower) - f64::from(depth)).max(0.0);
                let wanted = if is_outside { f64::from(lower) } else { inside };
                let found = f64::from(answer.distance.lower);
                assert!((found - wanted).abs() <= 1e-6 * f64::from(size), "{bits:?} {p:?}");
                // Half of the distance, for the mesh is as near as the hull or nearer.
                let within = hull.within(p, 0.5 * lower, Budget::EXACT, &mut stack).expect("asked");
                assert_eq!(within.is_clear(), is_outside, "{bits:?} {p:?}");
                sides[usize::from(is_outside)] += 1;
            }
        }
    }
    assert!(sides.iter().all(|&count| count > 500), "{sides:?}");
}

#[test]
fn within_the_part_the_answer_is_never_that_it_is_clear() {
    let shape = torus(2.0, 0.75, 24, 16);
    let mesh = mesh(&shape);
    let (bytes, _) = of(&mesh, 0.0, &options(&[64, 200]));
    let hulls = TightHulls::open(&bytes).expect("opens");
    let rng = &mut Rng::new(21);
    for index in 0..hulls.count() {
        let hull = hulls.get(index).expect("a hull");
        let mut stack = vec![ScratchEntry::EMPTY; hull.bvh().header().stack_entries as usize];
        let mut asked = 0;
        while asked < 500 {
            let [x, y, z] = rng.point_in([-3.0; 3], [3.0; 3]);
            // Well within the polygons' tube.
            if ((x * x + y * y).sqrt() - 2.0).powi(2) + z * z > 0.36 {
                continue;
            }
            asked += 1;
            for distance in [0.0, 1e-3, 0.1, 10.0] {
                let answer = hull
                    .within([x, y, z], distance, Budget::EXACT, &mut stack)
                    .expect("a distance");
                assert!(!answer.is_clear(), "{x} {y} {z}: {distance}");
            }
        }
    }
}

#[test]
fn short_searches_say_so_and_their_intervals_hold() {
    let shape = bracket();
    let mesh = mesh(&shape);
    let (bytes, _) = of(&mesh, 0.0, &options(&[200]));
    let hull = TightHulls::open(&bytes).expect("opens").finest().expect("a hull");
    let points = points(&mesh, &hull_mesh(&hull), 150, &mut Rng::new(8));
    let mut ended = [0; 2];
    for p in points {
        let real = distance_to_mesh(p, &shape.0, &shape.1);
        for (stop, entries) in [(Budget::EXACT.with_steps(1), 64), (Budget::EXACT, 2)] {
            let mut stack = vec![ScratchEntry::EMPTY; entries];
            let answer = hull.closest_point(p, stop, &mut stack).expect("asked");
            assert!(
                f64::from(answer.distance.lower) <= real.upper
                    && f64::from(answer.distance.upper) >= real.lower,
                "{p:?}"
            );
            ended[0] += usize::from(answer.ended == Ended::Steps);
            ended[1] += usize::from(answer.ended == Ended::Scratch);
            let distance = (real.upper * 0.9) as f32;
            let within = hull.within(p, distance, stop, &mut stack).expect("asked");
            assert!(!matches!(within.verdict, Verdict::Yes), "{p:?}");
        }
    }
    assert!(ended[0] > 100 && ended[1] > 100, "{ended:?}");
}

#[test]
fn a_tolerance_is_met_or_the_level_is_said_to_decide() {
    let shape = icosphere(3);
    let mesh = mesh(&shape);
    let (bytes, _) = of(&mesh, 0.0, &options(&[100]));
    let hull = TightHulls::open(&bytes).expect("opens").finest().expect("a hull");
    let mut stack = vec![ScratchEntry::EMPTY; 64];
    let mut ask =
        |p: [f32; 3], stop: Budget| hull.closest_point(p, stop, &mut stack).expect("asked");
    let far = ask([50.0, 3.0, 1.0], Budget::EXACT.with_relative(0.1));
    assert!(far.ended == Ended::Tolerance && far.distance.upper <= 1.1 * far.distance.lower);
    let near = ask([1.3, 0.1, 0.1], Budget::EXACT.with_absolute(1e-6));
    assert!(near.ended == Ended::Resolution && near.distance.upper - near.distance.lower > 1e-6);
    assert_eq!(ask([1.3, 0.1, 0.1], Budget::EXACT.with_absolute(1.0)).ended, Ended::Tolerance);
}

#[test]
fn what_cannot_be_answered_is_refused() {
    let (bytes, _) = of(&mesh(&icosphere(1)), 0.0, &options(&[64]));
    let hull = TightHulls::open(&bytes).expect("opens").finest().expect("a hull");
    let stack = &mut [ScratchEntry::EMPTY; 64];
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        assert_eq!(
            hull.closest_point([0.0, bad, 0.0], Budget::EXACT, stack),
            Err(QueryError::NotFinite)
        );
        assert_eq!(
            hull.within([bad, 0.0, 0.0], 1.0, Budget::EXACT, stack),
            Err(QueryError::NotFinite)
        );
        assert_eq!(hull.within([0.0; 3], bad, Budget::EXACT, stack), Err(QueryError::Tolerance));
        let stop = Budget::EXACT.with_absolute(bad);
        assert_eq!(hull.closest_point([0.0; 3], stop, stack), Err(QueryError::Tolerance));
    }
    assert_eq!(hull.within([0.0; 3], -1.0, Budget::EXACT, stack), Err(QueryError::Tolerance));
    assert_eq!(hull.closest_point([0.0; 3], Budget::EXACT, &mut []), Err(QueryError::NoScratch));
    let segments = options(&[64]).with_boxes(false, true);
    let (bytes, _) = of(&mesh(&icosphere(1)), 0.0, &segments);
    let hull = TightHulls::open(&bytes).expect("opens").finest().expect("a hull");
    let refusal = Err(QueryError::NotServed { build_for: BuildFor::Closest });
    assert_eq!(hull.closest_point([0.0; 3], Budget::EXACT, stack), refusal);
    let refusal = Err(QueryError::NotServed { build_for: BuildFor::Closest });
    assert_eq!(hull.within([0.0; 3], 1.0, Budget::EXACT, stack), refusal);
}

#[test]
fn a_hull_answers_as_a_blob_of_its_own() {
    let (bytes, _) = of(&mesh(&torus(2.0, 0.75, 16, 10)), 0.0, &options(&[64, 90]));
    let blob = Blob::open(&bytes).expect("opens");
    let hulls = blob.tight_hulls().expect("there");
    let stack = &mut [ScratchEntry::EMPTY; 64];
    for index in 0..hulls.count() {
        let hull = hulls.get(index).expect("a hull");
        let alone = Blob::open(hull.bytes()).expect("a blob");
        let by_itself = alone.bvh().expect("a box tree");
        for p in [[0.1, 0.2, 0.3], [3.0, 1.0, -2.0], [0.0; 3]] {
            let ours = hull.bvh().closest_point(p, Budget::EXACT, stack).expect("asked");
            assert_eq!(ours, by_itself.closest_point(p, Budget::EXACT, stack).expect("asked"));
        }
    }
    assert!(hulls.get(hulls.count()).is_none());
    assert_eq!(hulls.records().count() as u32, hulls.count());
}
