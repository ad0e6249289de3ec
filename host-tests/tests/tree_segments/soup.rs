//! Triangles that no solid would have.

use super::scene::{IDENTITY, Point, add};
use meshsweep_host_tests::generate::{Rng, Triangles, cube, icosphere, transformed};

fn separate(corners: impl IntoIterator<Item = [Point; 3]>) -> Triangles {
    let positions: Vec<Point> = corners.into_iter().flatten().collect();
    let triangles =
        (0..positions.len() as u32 / 3).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    (positions, triangles)
}

/// Triangles of sizes from 1e-6 to 1, anywhere in a box.
fn mixed(count: usize, seed: u64) -> Triangles {
    let rng = &mut Rng::new(seed);
    separate((0..count).map(|_| {
        let at = rng.point_in([-1.0; 3], [1.0; 3]);
        let size = 10f32.powf(rng.range(-6.0, 0.0));
        [at, add(at, rng.direction(), size), add(at, rng.direction(), size)]
    }))
}

/// Triangles up to a million times as long as high, some of them flat.
fn slivers(count: usize, seed: u64) -> Triangles {
    let rng = &mut Rng::new(seed);
    separate((0..count).map(|i| {
        let at = rng.point_in([-1.0; 3], [1.0; 3]);
        let end = add(at, rng.direction(), rng.range(0.1, 1.0));
        let t = rng.unit_f32();
        let on = std::array::from_fn(|k| at[k] + t * (end[k] - at[k]));
        let height = if i % 5 == 0 { 0.0 } else { 10f32.powf(rng.range(-6.0, -2.0)) };
        [at, end, add(on, rng.direction(), height)]
    }))
}

/// A solid whose triangles run this way and that: fans end where winding changes, or pair up with
/// one that is reversed.
fn unsteady((positions, mut triangles): Triangles, seed: u64) -> Triangles {
    let rng = &mut Rng::new(seed);
    for triangle in &mut triangles {
        if rng.below(2) == 0 {
            triangle.swap(1, 2);
        }
    }
    (positions, triangles)
}

/// Edges of three triangles, repeated triangles, and some without area, among a sphere's.
fn non_manifold() -> Triangles {
    let (mut positions, mut triangles) = icosphere(2);
    triangles.extend_from_within(..20);
    triangles.extend([
        [0, 1, 9],
        [1, 0, 11],
        [0, 0, 1],
        [2, 2, 2],
        [3, 4, 3],
        [5, 6, 7],
        [7, 6, 5],
    ]);
    let centre = positions.len() as u32;
    positions.push([0.0; 3]);
    triangles.extend((0..30).map(|i| [centre, i, i + 1]));
    (positions, triangles)
}

/// A flat sheet of `n` by `n` squares in a plane of constant `z`.
fn sheet(n: u32, z: f32) -> Triangles {
    let at = |i: u32, j: u32| i * (n + 1) + j;
    let positions = (0..=n).flat_map(|i| (0..=n).map(move |j| [i as f32, j as f32, z])).collect();
    let squares = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
    let triangles = squares.flat_map(|(i, j)| {
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        [[a, b, c], [a, c, d]]
    });
    (positions, triangles.collect())
}

/// Points, segments, and repeated triangles among others.
fn degenerate() -> Triangles {
    let (a, b, c, d) = ([0.0; 3], [1.0, 0.5, 0.25], [0.5, 0.25, 0.125], [-1.0, 0.75, 0.0]);
    separate([
        [a, a, a],
        [b, b, d],
        [a, b, c],
        [a, b, d],
        [d, b, a],
        [a, b, d],
        [c, c, c],
        [d, d, d],
    ])
}

/// What a segment's hit has to be defined for, though nobody would call it a surface.
pub fn soups() -> Vec<(&'static str, Triangles)> {
    vec![
        ("mixed sizes", mixed(200, 1)),
        ("slivers", slivers(150, 3)),
        ("unsteady sphere", unsteady(icosphere(2), 4)),
        ("unsteady cube", unsteady(cube(4), 5)),
        ("non-manifold", non_manifold()),
        ("sheet", sheet(6, 0.0)),
        ("sheet aloft", sheet(6, 0.7)),
        (
            "slanted sheet",
            transformed(
                &sheet(6, 0.0),
                [[1.0, 0.0, 0.25], [0.0, 1.0, 0.5], [0.0, 0.0, 1.0]],
                [0.0; 3],
            ),
        ),
        (
            "sheet upright",
            transformed(
                &sheet(5, 0.0),
                [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]],
                [0.0; 3],
            ),
        ),
        ("small sheet far away", transformed(&sheet(4, 0.0), IDENTITY, [1000.0, -700.0, 0.0])),
        ("degenerate", degenerate()),
        ("one triangle", separate([[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.5]]])),
        ("one point", separate([[[0.5, 0.25, 1.0]; 3]])),
        ("points far apart", separate([[[0.0; 3]; 3], [[1.0; 3]; 3], [[1.0, -1.0, 1e-20]; 3]])),
    ]
}
