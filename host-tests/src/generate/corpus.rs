//! The meshes that every structure is tested on: closed solids, and soups that nobody would call a
//! surface.

use super::{
    Rng, Triangles, bracket, cube, groove_block, icosphere, joined, needle_comb, rough_sphere,
    scaled, torus, transformed, two_parts, uv_sphere,
};

type Point = [f32; 3];

/// The rotation that turns nothing.
pub const IDENTITY: [Point; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Closed solids whose winding number is 1 inside: smooth, sharp, thin, tiny, huge, and far from
/// the origin.
#[must_use]
pub fn solids() -> Vec<(&'static str, Triangles)> {
    let far = [1e6, -1.5e6, 2e6];
    vec![
        ("torus", torus(2.0, 0.75, 20, 10)),
        ("bracket", bracket()),
        ("rough sphere", rough_sphere(3, 0.2, 7)),
        ("spiky sphere", rough_sphere(2, 0.8, 3)),
        ("groove block", groove_block()),
        ("needle comb", needle_comb()),
        ("cube", cube(3)),
        ("box of twelve", cube(1)),
        ("icosphere", icosphere(3)),
        ("sphere of meridians", uv_sphere(24, 12)),
        ("two parts", two_parts()),
        ("torus × 1e-30", scaled(&torus(2.0, 0.75, 20, 10), 1e-30)),
        ("torus × 1e30", scaled(&torus(2.0, 0.75, 20, 10), 1e30)),
        ("spiky sphere × 1e30", scaled(&rough_sphere(2, 0.8, 3), 1e30)),
        ("groove block × 1e-30", scaled(&groove_block(), 1e-30)),
        ("cube far away", transformed(&cube(4), IDENTITY, far)),
        ("two parts × 64 far away", transformed(&scaled(&two_parts(), 64.0), IDENTITY, far)),
        ("spire", spire()),
        ("corner touch", corner_touch()),
    ]
}

/// Meshes that are no solid: queries are defined for them all the same.
#[must_use]
pub fn soups() -> Vec<(&'static str, Triangles)> {
    let slanted = [[1.0, 0.0, 0.25], [0.0, 1.0, 0.5], [0.0, 0.0, 1.0]];
    let upright = [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]];
    vec![
        ("mixed sizes", mixed(300, 1)),
        ("needles", slivers(200, 2, false)),
        ("slivers", slivers(200, 3, true)),
        ("unsteady sphere", unsteady(icosphere(2), 4)),
        ("unsteady cube", unsteady(cube(4), 5)),
        ("non-manifold", non_manifold()),
        ("flat fan", flat_fan(64)),
        ("sheet", sheet(6, 0.0)),
        ("sheet aloft", sheet(6, 0.7)),
        ("slanted sheet", transformed(&sheet(6, 0.0), slanted, [0.0; 3])),
        ("sheet upright", transformed(&sheet(5, 0.0), upright, [0.0; 3])),
        ("small sheet far away", transformed(&sheet(4, 0.0), IDENTITY, [1000.0, -700.0, 0.0])),
        ("degenerate", degenerate()),
        ("one triangle", separate([[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.5]]])),
        ("one point", separate([[[0.5, 0.25, 1.0]; 3]])),
        ("point at the origin", separate([[[0.0; 3]; 3]])),
        ("points far apart", separate([[[0.0; 3]; 3], [[1.0; 3]; 3], [[1.0, -1.0, 1e-20]; 3]])),
    ]
}

/// Triangles of sizes from 1e-6 to 1, anywhere in a box.
#[must_use]
pub fn mixed(count: usize, seed: u64) -> Triangles {
    let rng = &mut Rng::new(seed);
    separate((0..count).map(|_| {
        let at = rng.point_in([-1.0; 3], [1.0; 3]);
        let size = 10f32.powf(rng.range(-6.0, 0.0));
        [at, add(at, rng.direction(), size), add(at, rng.direction(), size)]
    }))
}

/// Triangles up to a million times as long as high, some of them flat; with `along` their long side
/// is cut anywhere.
#[must_use]
pub fn slivers(count: usize, seed: u64, along: bool) -> Triangles {
    let rng = &mut Rng::new(seed);
    separate((0..count).map(|i| {
        let at = rng.point_in([-1.0; 3], [1.0; 3]);
        let end = add(at, rng.direction(), rng.range(0.1, 1.0));
        let t = if along { rng.unit_f32() } else { 0.0 };
        let on = std::array::from_fn(|k| at[k] + t * (end[k] - at[k]));
        let height = if i % 5 == 0 { 0.0 } else { 10f32.powf(rng.range(-6.0, -2.0)) };
        [at, end, add(on, rng.direction(), height)]
    }))
}

/// `p + by * d`.
#[must_use]
pub fn add(p: Point, d: Point, by: f32) -> Point {
    std::array::from_fn(|k| p[k] + by * d[k])
}

/// A tetrahedron a thousand times as high as wide: acute at every edge and at its tip.
fn spire() -> Triangles {
    let positions =
        vec![[1.0, 0.0, 0.0], [-0.5, 0.75, 0.0], [-0.5, -0.75, 0.0], [0.25, 0.0, 1000.0]];
    (positions, vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
}

/// Two cubes that share one vertex, and a third that shares an edge with the first.
fn corner_touch() -> Triangles {
    let moved = |by| transformed(&cube(1), IDENTITY, by);
    joined(&joined(&cube(1), &moved([2.0, 2.0, 2.0])), &moved([-2.0, -2.0, 0.0]))
}

fn separate(corners: impl IntoIterator<Item = [[f32; 3]; 3]>) -> Triangles {
    let positions: Vec<[f32; 3]> = corners.into_iter().flatten().collect();
    let triangles =
        (0..positions.len() as u32 / 3).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    (positions, triangles)
}

/// A fan of coplanar triangles about one vertex, in a plane that is not an axis's.
fn flat_fan(count: usize) -> Triangles {
    let mut positions = vec![[0.125, 0.25, 0.5]];
    for i in 0..count {
        let angle = std::f64::consts::TAU * i as f64 / count as f64;
        let (c, s) = (libm::cos(angle) as f32, libm::sin(angle) as f32);
        positions.push([0.125 + c, 0.25 + s, 0.5 + 0.5 * c - 0.25 * s]);
    }
    let n = count as u32;
    (positions, (0..n).map(|i| [0, 1 + i, 1 + (i + 1) % n]).collect())
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
