//! Triangles that no solid would have.

use super::scene::Scene;
use meshsweep_host_tests::generate::{Rng, Triangles};

fn separate(corners: impl IntoIterator<Item = [[f32; 3]; 3]>) -> Triangles {
    let positions: Vec<[f32; 3]> = corners.into_iter().flatten().collect();
    let triangles =
        (0..positions.len() as u32 / 3).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    (positions, triangles)
}

fn add(p: [f32; 3], d: [f32; 3], by: f32) -> [f32; 3] {
    std::array::from_fn(|k| p[k] + by * d[k])
}

/// Triangles of sizes from 1e-6 to 1, anywhere in a box.
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

/// What a distance has to be defined for, though nobody would call it a surface.
pub fn soups() -> Vec<(&'static str, Triangles)> {
    vec![
        ("mixed sizes", mixed(300, 1)),
        ("needles", slivers(200, 2, false)),
        ("slivers", slivers(200, 3, true)),
        ("flat fan", flat_fan(64)),
        ("degenerate", degenerate()),
        ("one triangle", separate([[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.5]]])),
        ("one point", separate([[[0.5, 0.25, 1.0]; 3]])),
        ("point at the origin", separate([[[0.0; 3]; 3]])),
        ("points far apart", separate([[[0.0; 3]; 3], [[1.0; 3]; 3], [[1.0, -1.0, 1e-20]; 3]])),
    ]
}

/// A random soup of one kind.
pub fn random(kind: usize, seed: u64, single: bool) -> Scene {
    let mesh = match kind {
        0 => mixed(60, seed),
        1 => slivers(60, seed, false),
        _ => slivers(60, seed, true),
    };
    Scene::new("soup", mesh, single)
}
