//! The Hausdorff distance of two meshes against brute force in 106 bits, and against numbers that
//! are known.

use meshsweep::hausdorff::{
    Attained, Direction, Ended, Hausdorff, Precision, Profile, hausdorff, profile,
};
use meshsweep::mesh::{Mesh, RawMesh, repair};
use meshsweep_host_tests::generate::corpus::{mixed, slivers};
use meshsweep_host_tests::generate::{
    Rng, Triangles, cube, icosphere, needle_comb, rough_sphere, scaled, torus, transformed,
};
use meshsweep_host_tests::oracle::{distance_to_mesh, distance_to_triangle};

const FINE: Precision = Precision { relative: 1e-6, absolute: 0.0, at_most: None };

fn repaired((positions, triangles): &Triangles) -> Mesh {
    repair(RawMesh::from_f32(positions, triangles)).expect("a mesh").0
}

fn of(a: &Triangles, b: &Triangles, direction: Direction, precision: &Precision) -> Hausdorff {
    hausdorff(&repaired(a), &repaired(b), direction, precision, &mut |_, _| ()).expect("two meshes")
}

/// Largest coordinate.
fn size(meshes: [&Triangles; 2]) -> f64 {
    let all = meshes.into_iter().flat_map(|(positions, _)| positions.iter().flatten());
    all.fold(0.0, |most: f64, x| most.max(f64::from(x.abs())))
}

fn pairs() -> Vec<(&'static str, Triangles, Triangles)> {
    let turn = [[0.8, -0.6, 0.0], [0.6, 0.8, 0.0], [0.0, 0.0, 1.0]];
    vec![
        ("soups", mixed(60, 1), mixed(50, 2)),
        ("slivers along", slivers(40, 3, true), mixed(40, 4)),
        ("slivers across", mixed(40, 5), slivers(40, 6, false)),
        ("fine and coarse", icosphere(3), icosphere(1)),
        ("rough and round", rough_sphere(2, 0.3, 7), icosphere(2)),
        ("turned", needle_comb(), transformed(&needle_comb(), turn, [0.1, 0.0, 0.2])),
        ("far apart", torus(2.0, 0.5, 12, 8), transformed(&cube(2), turn, [40.0, -7.0, 3.0])),
    ]
}

#[test]
fn no_sampled_point_is_farther_than_the_upper_bound_and_the_lower_bound_is_attained() {
    let mut rng = Rng::new(9);
    for (name, a, b) in pairs() {
        let rounded = 4e-7 * size([&a, &b]);
        for (from, to) in [(&a, &b), (&b, &a)] {
            let found = of(from, to, Direction::Forward, &FINE);
            assert!(found.upper <= found.lower * (1.0 + 2e-6) + 1e-9, "{name}: {found:?}");
            let (positions, triangles) = from;
            let mut most = 0f64;
            for k in 0..3000 {
                let corners = triangles[k % triangles.len()].map(|v| positions[v as usize]);
                let (u, v) = (rng.unit_f32(), rng.unit_f32());
                let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
                let weights =
                    if k < triangles.len() { [1.0, 0.0, 0.0] } else { [1.0 - u - v, u, v] };
                let point = [0, 1, 2]
                    .map(|axis| (0..3).map(|c| corners[c][axis] * weights[c]).sum::<f32>());
                most = most.max(distance_to_mesh(point, &to.0, &to.1).lower - rounded);
            }
            assert!(most <= found.upper, "{name}: a sample is {most} away, {found:?}");
            // 3,000 samples come near the farthest point.
            assert!(most > 0.5 * found.lower - rounded, "{name}: {most} {found:?}");
            check_attained(name, [from, to], &found, rounded);
        }
    }
}

/// The farthest point lies on its triangle, the closest on its own, and nothing is closer.
fn check_attained(name: &str, [from, to]: [&Triangles; 2], found: &Hausdorff, rounded: f64) {
    let at: Attained = found.attained.expect("the meshes differ");
    let point = at.from.map(|x| x as f32);
    let corners =
        |mesh: &Triangles, triangle: u32| mesh.1[triangle as usize].map(|v| mesh.0[v as usize]);
    let off = distance_to_triangle(point, corners(from, at.from_triangle)).upper;
    assert!(off <= rounded, "{name}: {off} off the first mesh");
    let off = distance_to_triangle(at.to.map(|x| x as f32), corners(to, at.to_triangle)).upper;
    assert!(off <= rounded, "{name}: {off} off the second mesh");
    let true_distance = distance_to_mesh(point, &to.0, &to.1);
    assert!(true_distance.upper >= found.lower - rounded, "{name}: {true_distance:?} {found:?}");
    let way: f64 = (0..3).map(|k| (at.from[k] - at.to[k]).powi(2)).sum();
    assert!((way.sqrt() - found.lower).abs() <= 1e-9 * (1.0 + found.lower), "{name}: {found:?}");
}

#[test]
fn both_directions_are_the_larger_of_each() {
    for (name, a, b) in pairs() {
        let both = of(&a, &b, Direction::Both, &FINE);
        let sides = [(&a, &b), (&b, &a)].map(|(from, to)| of(from, to, Direction::Forward, &FINE));
        let (lower, upper) =
            (sides[0].lower.max(sides[1].lower), sides[0].upper.max(sides[1].upper));
        assert!(both.lower <= upper && lower <= both.upper, "{name}: {both:?} {sides:?}");
    }
}

/// A cube in a cube twice as large about the same centre: half a side for its own surface, and half
/// a diagonal for the other's.
#[test]
fn cubes_are_as_far_apart_as_their_corners() {
    let small = cube(3);
    let (low, high) = small
        .0
        .iter()
        .flatten()
        .fold((f32::MAX, f32::MIN), |(low, high), &x| (low.min(x), high.max(x)));
    let (side, centre) = (f64::from(high - low), f64::from(low + high) / 2.0);
    let large =
        (small.0.iter().map(|p| p.map(|x| 2.0 * x - centre as f32)).collect(), small.1.clone());
    let fine = Precision { relative: 1e-12, ..FINE };
    for (a, b, distance) in
        [(&small, &large, side / 2.0), (&large, &small, side / 2.0 * 3f64.sqrt())]
    {
        let found = of(a, b, Direction::Forward, &fine);
        let Hausdorff { lower, upper, .. } = found;
        assert!(lower <= distance && distance <= upper, "{distance} {found:?}");
        assert!(upper - lower <= 1e-9 * distance, "{found:?}");
    }
}

/// The farthest point of a triangle from its own corners is the centre of its circle: no vertex
/// and no point of an edge.
#[test]
fn the_farthest_point_may_lie_inside_a_triangle() {
    let corners = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [1.0, 3.0, 0.0]];
    let plate: Triangles = (corners.to_vec(), vec![[0, 1, 2]]);
    let spikes =
        corners.iter().flat_map(|&[x, y, z]| [[x, y, z], [x, y, z - 1.0], [x, y + 1e-9, z - 1.0]]);
    let spikes: Triangles = (spikes.collect(), vec![[0, 1, 2], [3, 4, 5], [6, 7, 8]]);
    let found = of(&plate, &spikes, Direction::Forward, &FINE);
    // The circle's centre is (2, 1).
    let distance = 5f64.sqrt();
    assert!(found.lower <= distance && distance <= found.upper, "{found:?}");
    let [x, y, _] = found.attained.expect("apart").from;
    assert!((x - 2.0).abs() < 1e-2 && (y - 1.0).abs() < 1e-2, "{found:?}");
}

#[test]
fn the_distance_of_a_mesh_from_itself_is_nothing_but_rounding() {
    for (name, a, _) in pairs() {
        let found = of(&a, &a, Direction::Both, &FINE);
        assert!(found.lower == 0.0 && found.upper <= 1e-10 * size([&a, &a]), "{name}: {found:?}");
    }
}

#[test]
fn scaling_both_meshes_scales_the_bounds() {
    for exponent in [-99, 96] {
        let factor = 2f32.powi(exponent);
        for (name, a, b) in pairs() {
            let once = of(&a, &b, Direction::Both, &FINE);
            let scaled = of(&scaled(&a, factor), &scaled(&b, factor), Direction::Both, &FINE);
            let factor = f64::from(factor);
            assert!(
                scaled.lower <= once.upper * factor && once.lower * factor <= scaled.upper,
                "{name}: {once:?} {scaled:?}"
            );
        }
    }
}

#[test]
fn a_limit_is_decided_on_both_of_its_sides() {
    for (name, a, b) in pairs() {
        let exact = of(&a, &b, Direction::Both, &FINE);
        for factor in [0.5, 0.999, 1.001, 2.0] {
            let most = exact.upper * factor;
            let limit = Precision { at_most: Some(most), ..FINE };
            let found = of(&a, &b, Direction::Both, &limit);
            let is_within = found.upper <= most;
            assert_eq!(is_within, factor > 1.0, "{name}: {factor} {found:?} {exact:?}");
            assert!(is_within || found.lower > most, "{name}: {found:?}");
        }
    }
}

#[test]
fn the_answer_does_not_depend_on_the_number_of_threads() {
    for (name, a, b) in pairs() {
        let on = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("pool");
            pool.install(|| of(&a, &b, Direction::Both, &FINE))
        };
        assert_eq!(on(1), on(3), "{name}");
    }
}

/// A unit plate of `n` by `n` squares.
fn plate(n: u32, height: f32) -> Triangles {
    let at = |i: u32| i as f32 / n as f32;
    let vertices = (0..=n).flat_map(|i| (0..=n).map(move |j| [at(i), at(j), height]));
    let squares = (0..n * n).map(|k| k / n * (n + 1) + k % n);
    let triangles = squares.flat_map(|v| [[v, v + 1, v + n + 2], [v, v + n + 2, v + n + 1]]);
    (vertices.collect(), triangles.collect())
}

/// All points of both plates are as far as the farthest, so all triangles have to be cut.
#[test]
fn plates_that_are_equally_far_apart_are_bounded_on_both_sides() {
    let (a, b) = (plate(12, 0.0), plate(9, 0.25));
    for relative in [1e-3, 1e-4, 1e-5] {
        let found = of(&a, &b, Direction::Both, &Precision { relative, ..FINE });
        assert_eq!(found.ended, Ended::Precision, "{relative}: {found:?}");
        assert!(found.lower <= 0.25 && 0.25 <= found.upper, "{found:?}");
        assert!(found.upper <= found.lower * (1.0 + relative), "{relative}: {found:?}");
    }
}

#[test]
fn a_precision_that_rounding_forbids_is_told() {
    // Alike, so that nothing has to be cut.
    let (a, b) = (plate(2, 0.0), plate(2, 0.25));
    let found = of(&a, &b, Direction::Both, &Precision { relative: 0.0, ..FINE });
    assert_eq!(found.ended, Ended::Rounding, "{found:?}");
    assert!(found.upper - found.lower < 1e-10, "{found:?}");
    // Exactly the distance: no rounding can decide it.
    let limit = Precision { at_most: Some(0.25), ..FINE };
    let found = of(&a, &b, Direction::Both, &limit);
    assert_eq!(found.ended, Ended::Rounding, "{found:?}");
    assert!(found.lower <= 0.25 && 0.25 < found.upper, "{found:?}");
}

/// One part in two formats: f32, and decimals that are rounded to f32. Next to each other f32 does
/// not tell which triangle is the nearest.
#[test]
fn two_roundings_of_a_mesh_end_at_their_rounding() {
    use std::f64::consts::TAU;
    let (_, triangles) = torus(10.0, 3.0, 16, 8);
    let exact = (0..16 * 8).map(|k| {
        let (a, b) = (f64::from(k / 8) * TAU / 16.0, f64::from(k % 8) * TAU / 8.0);
        let out = 10.0 + 3.0 * b.cos();
        [out * a.cos(), out * a.sin(), 3.0 * b.sin()]
    });
    let exact: Vec<[f64; 3]> = exact.collect();
    let single: Vec<[f32; 3]> = exact.iter().map(|p| p.map(|x| x as f32)).collect();
    let first = RawMesh::from_f32(&single, &triangles);
    let mut second = RawMesh::from_f32(&single, &triangles);
    second.positions = exact.iter().map(|p| p.map(|x| (x * 1e8).round() / 1e8)).collect();
    second.decimal = true;
    let [first, second] = [first, second].map(|raw| repair(raw).expect("a mesh").0);
    let precision = Precision { relative: 1e-4, ..FINE };
    let found =
        hausdorff(&first, &second, Direction::Both, &precision, &mut |_, _| ()).expect("meshes");
    assert_eq!(found.ended, Ended::Rounding, "{found:?}");
    assert!(found.pieces < 30_000, "{found:?}");
    let rounding = first.rounding + second.rounding;
    assert!(rounding > 1e-7 && found.upper - found.lower <= 2.5 * rounding, "{found:?}");
    // A vertex is off by both roundings at most.
    let off = exact.iter().zip(&single).flat_map(|(p, q)| (0..3).map(|k| p[k] - f64::from(q[k])));
    let off = off.fold(0.0, |most: f64, x| most.max(x.abs()));
    assert!(found.lower <= 2.0 * off + 2e-8, "{off} {found:?}");
}

#[test]
fn a_search_that_ends_at_once_names_a_point() {
    let (a, b) = (plate(2, 0.0), plate(3, 0.25));
    for precision in
        [Precision { absolute: 10.0, ..FINE }, Precision { at_most: Some(10.0), ..FINE }]
    {
        let found = of(&a, &b, Direction::Both, &precision);
        assert!(found.attained.is_some() && found.lower > 0.0, "{found:?}");
    }
}

fn profile_of(a: &Triangles, b: &Triangles, relative: f64) -> Profile {
    profile(&repaired(a), &repaired(b), &[0.25, 0.5, 0.9], relative, &mut |_, _| ())
        .expect("meshes")
}

fn holds([lower, upper]: [f64; 2], truth: f64, slack: f64) -> bool {
    lower <= truth + slack && truth - slack <= upper
}

#[test]
fn mean_and_quantiles_of_a_ramp_over_a_plate_are_those_of_a_line() {
    let plate = |heights: [f32; 4]| {
        let [a, b, c, d] = heights;
        let corners = vec![[0.0, 0.0, a], [4.0, 0.0, b], [4.0, 4.0, c], [0.0, 4.0, d]];
        (corners, vec![[0, 1, 2], [0, 2, 3]])
    };
    let found = profile_of(&plate([1.0, 3.0, 3.0, 1.0]), &plate([0.0; 4]), 0.01);
    assert!(found.is_close && found.mean[1] - found.mean[0] <= 0.021, "{found:?}");
    assert!(holds(found.mean, 2.0, 0.0), "{found:?}");
    for (bounds, truth) in found.quantiles.iter().zip([1.5, 2.0, 2.8]) {
        assert!(holds(*bounds, truth, 0.0), "{found:?}");
        assert!(bounds[1] - bounds[0] < 0.5, "{found:?}");
    }
    for (bounds, truth) in found.vertices.iter().zip([1.0, 3.0, 3.0, 1.0]) {
        assert!(holds(*bounds, truth, 0.0), "{found:?}");
    }
}

#[test]
fn mean_and_quantiles_hold_for_samples_of_every_pair() {
    let mut rng = Rng::new(21);
    for (name, a, b) in pairs() {
        let mesh = repaired(&a);
        let found = profile_of(&a, &b, 0.05);
        for (vertex, bounds) in mesh.positions.iter().zip(&found.vertices) {
            let truth = distance_to_mesh(*vertex, &b.0, &b.1);
            assert!(bounds[0] <= truth.upper && truth.lower <= bounds[1], "{name} {bounds:?}");
        }
        // By area, with the same number of points in each part of it.
        let corners: Vec<[[f64; 3]; 3]> = (0..mesh.triangles.len())
            .map(|t| mesh.corners(t).expect("a triangle").map(|p| p.map(f64::from)))
            .collect();
        let area = |[a, b, c]: &[[f64; 3]; 3]| {
            let way = |p: &[f64; 3]| [0, 1, 2].map(|k| p[k] - a[k]);
            let (e, g) = (way(b), way(c));
            let n = [0, 1, 2].map(|k| {
                let (i, j) = ((k + 1) % 3, (k + 2) % 3);
                e[i] * g[j] - e[j] * g[i]
            });
            n.iter().map(|x| x * x).sum::<f64>().sqrt()
        };
        let areas: Vec<f64> = corners.iter().map(area).collect();
        let whole: f64 = areas.iter().sum();
        let count = 2000;
        let mut distances = Vec::new();
        let (mut triangle, mut before) = (0, 0.0);
        for number in 0..count {
            let at = whole * (f64::from(number) + rng.unit_f64()) / f64::from(count);
            while before + areas[triangle] < at && triangle + 1 < areas.len() {
                before += areas[triangle];
                triangle += 1;
            }
            let (mut u, mut v) = (rng.unit_f64(), rng.unit_f64());
            if u + v > 1.0 {
                (u, v) = (1.0 - u, 1.0 - v);
            }
            let [a, b_, c] = corners[triangle];
            let p = [0, 1, 2].map(|k| (a[k] + u * (b_[k] - a[k]) + v * (c[k] - a[k])) as f32);
            distances.push(distance_to_mesh(p, &b.0, &b.1).upper);
        }
        distances.sort_by(f64::total_cmp);
        let mean = distances.iter().sum::<f64>() / f64::from(count);
        let spread = distances[distances.len() - 1] - distances[0];
        assert!(holds(found.mean, mean, 0.02 * spread), "{name} {found:?} {mean}");
        for (bounds, part) in found.quantiles.iter().zip([0.25, 0.5, 0.9]) {
            // A sample's rank is off by some roots of the number of points.
            let rank = |shift: f64| {
                let at = (f64::from(count) * part + shift).clamp(0.0, f64::from(count - 1));
                distances[at as usize]
            };
            let off = 3.0 * f64::from(count).sqrt();
            assert!(bounds[0] <= rank(off) && rank(-off) <= bounds[1], "{name} {bounds:?}");
        }
    }
}
