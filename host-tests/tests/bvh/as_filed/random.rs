//! Random files: soups with copies, opposite copies and triangles without area, and solids whose
//! triangles are wound anyhow.

use super::{File, exact_winding, first, minus, side, stack, views, winding};
use meshsweep::bvh::TreeOptions;
use meshsweep_core::{Budget, Facing, Side, TriangleHit};
use meshsweep_host_tests::generate::{Rng, Triangles, cube, icosphere, rough_sphere, torus};
use meshsweep_host_tests::oracle::distance_to_triangle;
use proptest::prelude::*;
use robust::{Coord3D, orient3d};

/// A soup of a few vertices, on a coarse lattice or anywhere, with some of them almost twice.
fn soup(seed: u64) -> File {
    let mut rng = Rng::new(seed);
    let (count, on_lattice) = (5 + rng.below(8), rng.below(2) == 0);
    let mut positions: Vec<[f64; 3]> = (0..count)
        .map(|_| {
            let p = [rng.unit_f64(), rng.unit_f64(), rng.unit_f64()].map(|x| 2.0 * x - 1.0);
            if on_lattice { p.map(|x| (3.0 * x).round() / 3.0) } else { p }
        })
        .collect();
    for _ in 0..2 {
        let near = positions[rng.below(count)];
        positions.push(near.map(|x| x * (1.0 + 1e-9 * (rng.unit_f64() - 0.5))));
    }
    let mut triangles = Vec::new();
    for _ in 0..3 + rng.below(20) {
        let any = [0; 3].map(|_| rng.below(positions.len()) as u32);
        triangles.push(any);
        let [a, b, c] = triangles[rng.below(triangles.len())];
        match rng.below(6) {
            0 => triangles.push([b, c, a]),
            1 => triangles.push([a, c, b]),
            2 => {
                // An edge in two parts.
                let [p, q] = [a, b].map(|v| positions[v as usize]);
                positions.push([0, 1, 2].map(|k| 0.5 * (p[k] + q[k])));
                triangles.push([a, b, positions.len() as u32 - 1]);
            }
            _ => {}
        }
    }
    // At least one with an area.
    let first = positions.len() as u32;
    positions.extend([[0.0; 3], [1.0, 0.1, 0.2], [0.1, 1.0, 0.3]]);
    triangles.push([first, first + 1, first + 2]);
    File { positions, triangles }
}

/// The least distance of a point from the file's triangles.
fn distance(file: &File, p: [f32; 3]) -> f64 {
    let corners = |t: u32| file.corners(t).map(|v| v.map(|x| x as f32));
    let to = |t: u32| distance_to_triangle(p, corners(t)).lower;
    (0..file.triangles.len() as u32).map(to).fold(f64::INFINITY, f64::min)
}

/// On which side of the triangle's plane a place is: 1 in front. 0 on the plane, exactly.
fn in_front(p: [f64; 3], corners: [[f64; 3]; 3]) -> i32 {
    let at = |[x, y, z]: [f64; 3]| Coord3D { x, y, z };
    let [a, b, c] = corners.map(at);
    // Positive if the place sees the corners run clockwise.
    let turn = orient3d(a, b, c, at(p));
    if turn < 0.0 { 1 } else { -i32::from(turn > 0.0) }
}

/// Whether a segment crosses a triangle from its front, or from its back, by far more than vertices
/// move: its ends and the edges are clear of where they meet.
fn crossing(file: &File, triangle: u32, [a, b]: [[f64; 3]; 2]) -> Option<Facing> {
    let corners = file.corners(triangle);
    let clear = 1e-3;
    let volume = |p: [f64; 3], q: [f64; 3], r: [f64; 3]| {
        p[0] * (q[1] * r[2] - q[2] * r[1])
            + p[1] * (q[2] * r[0] - q[0] * r[2])
            + p[2] * (q[0] * r[1] - q[1] * r[0])
    };
    let [p, q, r] = corners.map(|v| minus(v, a));
    let d = minus(b, a);
    let edges = [volume(d, p, q), volume(d, q, r), volume(d, r, p)];
    let is_through = edges.iter().all(|&x| x > clear) || edges.iter().all(|&x| x < -clear);
    let heights = [a, b].map(|end| {
        let [p, q, r] = corners.map(|v| minus(v, end));
        volume(p, q, r)
    });
    let is_across = heights[0] * heights[1] < 0.0 && heights.iter().all(|x| x.abs() > clear);
    if !(is_through && is_across) {
        return None;
    }
    match in_front(a, corners) {
        1 => Some(Facing::Front),
        _ => Some(Facing::Back),
    }
}

/// The first triangle of the file on the same places in the same winding.
fn first_copy(file: &File, triangle: u32) -> u32 {
    let places = |t: u32| file.corners(t).map(|v| v.map(|x| (x as f32 + 0.0).to_bits()));
    let [a, b, c] = places(triangle);
    let is_copy = |t: &u32| [[a, b, c], [b, c, a], [c, a, b]].contains(&places(*t));
    (0..triangle).find(is_copy).unwrap_or(triangle)
}

/// All triangles that a segment meets, as a tree lists them.
fn all_hits(tree: &meshsweep_core::Bvh<'_>, [a, b]: [[f32; 3]; 2], facing: Facing) -> Vec<u32> {
    let mut hits = vec![TriangleHit::EMPTY; 256];
    let found = tree.all_hits(a, b, facing, &mut hits, Budget::EXACT, &mut stack(tree));
    let stored = found.expect("answers").stored;
    hits.truncate(stored);
    hits.iter().filter_map(|of| of.hit.triangle).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_winding_interval_contains_the_sum_over_all_triangles_of_the_file(seed in any::<u64>()) {
        let file = soup(seed);
        let blobs = file.trees(TreeOptions::default().with_winding(true));
        let mut rng = Rng::new(seed ^ 1);
        for tree in views(&blobs) {
            prop_assert_eq!(tree.triangle_count() as usize, file.triangles.len());
            for _ in 0..12 {
                let point = rng.point_in([-1.5; 3], [1.5; 3]);
                let away = distance(&file, point);
                if away < 1e-3 {
                    continue;
                }
                let (number, found) = winding(&tree, point);
                let truth = exact_winding(&file, point.map(f64::from));
                let error = 1e-12 + 1e-13 / (away * away);
                let [lower, upper] = [number.lower, number.upper].map(f64::from);
                prop_assert!(
                    lower <= truth + error && truth - error <= upper,
                    "{point:?}: {truth} is not in {lower} {upper}: {file:?}"
                );
                let is_wrong = match found {
                    Side::Inside => truth < 0.5 - error,
                    Side::Outside => truth > 0.5 + error,
                    _ => false,
                };
                prop_assert!(!is_wrong, "{point:?}: {truth}: {found:?}");
            }
        }
    }

    #[test]
    fn the_facing_of_every_hit_is_that_of_the_file_s_triangle(
        seed in any::<u64>(),
        winding in any::<bool>(),
    ) {
        let file = soup(seed);
        let blobs = file.trees(TreeOptions::default().with_winding(winding));
        let mut rng = Rng::new(seed ^ 2);
        for tree in views(&blobs) {
            for _ in 0..12 {
                let beam = [0; 2].map(|_| rng.point_in([-1.5; 3], [1.5; 3]));
                let exactly = beam.map(|p| p.map(f64::from));
                for facing in [Facing::Front, Facing::Back] {
                    let listed = all_hits(&tree, beam, facing);
                    for triangle in 0..file.triangles.len() as u32 {
                        let Some(wanted) = crossing(&file, triangle, exactly) else { continue };
                        let stored = if winding { triangle } else { first_copy(&file, triangle) };
                        prop_assert_eq!(
                            listed.contains(&stored), facing == wanted,
                            "{:?} of {:?}, triangle {}: {:?}", facing, beam, triangle, file
                        );
                    }
                    let is_met = (0..file.triangles.len() as u32)
                        .any(|t| crossing(&file, t, exactly) == Some(facing));
                    prop_assert!(!is_met || first(&tree, beam, facing).is_some());
                }
            }
        }
    }

    #[test]
    fn sides_of_a_solid_are_right_however_its_triangles_are_wound(
        seed in any::<u64>(),
        shape in 0..4usize,
        wrong in 0..4usize,
    ) {
        let shapes: [fn(u64) -> Triangles; 4] = [
            |_| cube(2),
            |_| icosphere(1),
            |seed| rough_sphere(2, 0.4, seed),
            |_| torus(2.0, 0.75, 12, 8),
        ];
        let mut rng = Rng::new(seed);
        let mut solid = File::of(&shapes[shape](seed));
        // No coordinate is an f32.
        for x in solid.positions.iter_mut().flatten() {
            *x *= 1.0 + 1e-9;
        }
        let mut file = solid.clone();
        let turn_all = rng.below(2) == 0;
        for triangle in &mut file.triangles {
            if turn_all != (rng.below(8) < wrong) {
                triangle.swap(1, 2);
            }
        }
        let blobs = file.trees(TreeOptions::default());
        let mut decided = 0;
        for tree in views(&blobs) {
            for _ in 0..24 {
                let point = rng.point_in([-3.0; 3], [3.0; 3]);
                let truth = exact_winding(&solid, point.map(f64::from));
                let found = side(&tree, point);
                let wanted = if truth > 0.5 { Side::Inside } else { Side::Outside };
                prop_assert!(
                    found == wanted || matches!(found, Side::Undecided(_)),
                    "{point:?}: {found:?}, {truth}"
                );
                decided += usize::from(found == wanted);
            }
        }
        prop_assert!(decided > 80, "{decided} of 96");
    }
}
