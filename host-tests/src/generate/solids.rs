//! Smooth and flat solids about the origin.

use super::builder::Builder;
use super::{Rng, Triangles};

/// The point of the unit circle `step` of `steps` around, computed in f64.
fn turn(step: usize, steps: usize) -> [f64; 2] {
    let angle = std::f64::consts::TAU * step as f64 / steps as f64;
    [libm::cos(angle), libm::sin(angle)]
}

/// A torus around the z axis, genus 1: `n` steps around the axis, `m` around the tube, 2·n·m
/// triangles. `n`, `m` ≥ 3, `minor` < `major`.
#[must_use]
pub fn torus(major: f32, minor: f32, n: usize, m: usize) -> Triangles {
    let mut positions = Vec::with_capacity(n * m);
    for i in 0..n {
        let [ci, si] = turn(i, n);
        for j in 0..m {
            let [cj, sj] = turn(j, m);
            let r = f64::from(major) + f64::from(minor) * cj;
            positions.push([(r * ci) as f32, (r * si) as f32, (f64::from(minor) * sj) as f32]);
        }
    }
    let at = |i: usize, j: usize| ((i % n) * m + j % m) as u32;
    let mut triangles = Vec::with_capacity(2 * n * m);
    for i in 0..n {
        for j in 0..m {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    (positions, triangles)
}

/// A unit sphere of `n` meridians and `m` bands, slivers at the poles: 2·n·(m − 1) triangles. `n` ≥
/// 3, `m` ≥ 2.
#[must_use]
pub fn uv_sphere(n: usize, m: usize) -> Triangles {
    let mut positions = vec![[0.0, 0.0, 1.0]];
    for j in 1..m {
        let [z, r] = turn(j, 2 * m);
        for i in 0..n {
            let [c, s] = turn(i, n);
            positions.push([(r * c) as f32, (r * s) as f32, z as f32]);
        }
    }
    positions.push([0.0, 0.0, -1.0]);
    let south = positions.len() as u32 - 1;
    let at = |i: usize, j: usize| (1 + (j - 1) * n + i % n) as u32;
    let mut triangles = Vec::with_capacity(2 * n * m.saturating_sub(1));
    for i in 0..n {
        triangles.push([0, at(i, 1), at(i + 1, 1)]);
        for j in 1..m - 1 {
            let [a, b, c, d] = [at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
        triangles.push([south, at(i + 1, m - 1), at(i, m - 1)]);
    }
    (positions, triangles)
}

/// A unit sphere: an icosahedron whose triangles are split into four, `level` times; 20·4^`level`
/// triangles.
#[must_use]
pub fn icosphere(level: u32) -> Triangles {
    let (positions, triangles) = icosphere_f64(level);
    (positions.into_iter().map(|p| p.map(|x| x as f32)).collect(), triangles)
}

/// An icosphere whose vertices are moved in or out by up to `amplitude` (less than 1) of the
/// radius, at random.
#[must_use]
pub fn rough_sphere(level: u32, amplitude: f32, seed: u64) -> Triangles {
    let (positions, triangles) = icosphere_f64(level);
    let mut rng = Rng::new(seed);
    let moved = positions.into_iter().map(|p| {
        let r = 1.0 + f64::from(amplitude) * (2.0 * rng.unit_f64() - 1.0);
        p.map(|x| (x * r) as f32)
    });
    (moved.collect(), triangles)
}

fn icosphere_f64(level: u32) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let unit = |p: [f64; 3]| {
        let length = (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]).sqrt();
        p.map(|x| x / length)
    };
    let g = f64::midpoint(1.0, 5.0f64.sqrt());
    #[rustfmt::skip]
    let corners = [
        [-1.0, g, 0.0], [1.0, g, 0.0], [-1.0, -g, 0.0], [1.0, -g, 0.0],
        [0.0, -1.0, g], [0.0, 1.0, g], [0.0, -1.0, -g], [0.0, 1.0, -g],
        [g, 0.0, -1.0], [g, 0.0, 1.0], [-g, 0.0, -1.0], [-g, 0.0, 1.0],
    ];
    let mut positions: Vec<[f64; 3]> = corners.into_iter().map(unit).collect();
    #[rustfmt::skip]
    let mut triangles: Vec<[u32; 3]> = vec![
        [0, 11, 5], [0, 5, 1], [0, 1, 7], [0, 7, 10], [0, 10, 11],
        [1, 5, 9], [5, 11, 4], [11, 10, 2], [10, 7, 6], [7, 1, 8],
        [3, 9, 4], [3, 4, 2], [3, 2, 6], [3, 6, 8], [3, 8, 9],
        [4, 9, 5], [2, 4, 11], [6, 2, 10], [8, 6, 7], [9, 8, 1],
    ];
    for _ in 0..level {
        let mut middle_of = std::collections::HashMap::new();
        let mut middle = |a: u32, b: u32| {
            *middle_of.entry((a.min(b), a.max(b))).or_insert_with(|| {
                // The lower vertex first, so that rounding does not depend on the direction.
                let (p, q) = (positions[a.min(b) as usize], positions[a.max(b) as usize]);
                positions.push(unit([p[0] + q[0], p[1] + q[1], p[2] + q[2]]));
                positions.len() as u32 - 1
            })
        };
        triangles = triangles
            .into_iter()
            .flat_map(|[a, b, c]| {
                let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
                [[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]
            })
            .collect();
    }
    (positions, triangles)
}

/// The box between two corners: two triangles a side, eight vertices, x fastest.
#[must_use]
pub fn block(low: [f32; 3], high: [f32; 3]) -> Triangles {
    let corner = |i: usize| [0, 1, 2].map(|k| if i >> k & 1 == 0 { low[k] } else { high[k] });
    let triangles = [
        [0, 2, 1],
        [1, 2, 3],
        [4, 5, 6],
        [5, 7, 6],
        [0, 1, 4],
        [1, 5, 4],
        [2, 6, 3],
        [3, 6, 7],
        [0, 4, 2],
        [2, 4, 6],
        [1, 3, 5],
        [3, 7, 5],
    ];
    ((0..8).map(corner).collect(), triangles.to_vec())
}

/// The cube from −1 to 1, each face a grid of `n` × `n` squares, exactly flat: 12·n² triangles. `n`
/// ≥ 1.
#[must_use]
pub fn cube(n: usize) -> Triangles {
    let step = |i: usize| (2.0 * i as f64 / n as f64 - 1.0) as f32;
    let mut builder = Builder::default();
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            let mut outward = [0.0; 3];
            outward[axis] = side;
            let at = |i: usize, j: usize| {
                let mut p = outward;
                p[(axis + 1) % 3] = step(i);
                p[(axis + 2) % 3] = step(j);
                p
            };
            for i in 0..n {
                for j in 0..n {
                    builder.quad([at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)], outward);
                }
            }
        }
    }
    builder.finish()
}

/// A beam with a section of 4 by 4 that goes around the z axis at a distance of 10 and rises: from
/// 360 degrees on it crosses itself, if it rises by less than 4 a turn.
#[must_use]
pub fn coil(degrees: f64, steps: usize, rise: f64) -> Triangles {
    let mut positions = Vec::new();
    for step in 0..=steps {
        let part = step as f64 / steps as f64;
        let angle = (degrees * part).to_radians();
        let (cos, sin, up) = (libm::cos(angle), libm::sin(angle), rise * part);
        for [r, z] in [[8.0, 0.0], [12.0, 0.0], [12.0, 4.0], [8.0, 4.0f64]] {
            positions.push([(r * cos) as f32, (r * sin) as f32, (z + up) as f32]);
        }
    }
    let mut triangles = vec![[0, 1, 2], [0, 2, 3]];
    for step in 0..steps as u32 {
        for side in 0..4 {
            let [a, b] = [side, (side + 1) % 4].map(|k| 4 * step + k);
            triangles.extend([[a, a + 4, b], [b, a + 4, b + 4]]);
        }
    }
    let [a, b, c, d] = [0, 1, 2, 3].map(|k| 4 * steps as u32 + k);
    triangles.extend([[a, c, b], [a, d, c]]);
    (positions, triangles)
}

/// A square plate of side 1 on a plane with these slopes along x and y. Each face is a grid of 4 by
/// 4 squares, whose diagonals run against those of the other face.
#[must_use]
pub fn plate(slope: [f32; 2], thickness: f32) -> Triangles {
    let mut positions = Vec::new();
    for layer in [0.0, thickness] {
        for i in 0..25 {
            let [x, y] = [i % 5, i / 5].map(|k| k as f32 / 4.0);
            positions.push([x, y, slope[0] * x + slope[1] * y + layer]);
        }
    }
    let mut triangles = Vec::new();
    for i in 0..16u32 {
        let a = i % 4 + 5 * (i / 4);
        let [b, c, d] = [a + 1, a + 6, a + 5];
        triangles.extend([[a, c, b], [a, d, c]]);
        let [a, b, c, d] = [a, b, c, d].map(|v| v + 25);
        triangles.extend([[a, b, d], [b, c, d]]);
    }
    let rim = (0..4).chain((0..4).map(|i| 4 + 5 * i));
    let rim: Vec<u32> =
        rim.chain((0..4).map(|i| 24 - i)).chain((0..4).map(|i| 20 - 5 * i)).collect();
    for (i, &from) in rim.iter().enumerate() {
        let to = rim[(i + 1) % rim.len()];
        triangles.extend([[from, to, to + 25], [from, to + 25, from + 25]]);
    }
    (positions, triangles)
}
