//! Meshes from meshes.

use super::{Triangles, cube, icosphere};

/// Powers of two near 1e30 and 1e-30: scaling by them is exact.
pub const EXTREME_SCALES: [f32; 2] = [(1u128 << 99) as f32, 1.0 / (1u128 << 99) as f32];

/// The mesh times a factor; exact for a power of two. A negative factor turns it inside out.
#[must_use]
pub fn scaled((positions, triangles): &Triangles, factor: f32) -> Triangles {
    (positions.iter().map(|p| p.map(|x| x * factor)).collect(), triangles.clone())
}

/// The mesh under p ↦ `rows`·p + `shift`, in f64, rounded to f32 once. Faces that were exactly flat
/// may not be so after.
#[must_use]
pub fn transformed(
    (positions, triangles): &Triangles,
    rows: [[f32; 3]; 3],
    shift: [f32; 3],
) -> Triangles {
    let apply = |p: &[f32; 3]| {
        std::array::from_fn(|k| {
            let products = rows[k].iter().zip(p).map(|(r, x)| f64::from(*r) * f64::from(*x));
            (products.sum::<f64>() + f64::from(shift[k])) as f32
        })
    };
    (positions.iter().map(apply).collect(), triangles.clone())
}

/// The mesh with every triangle wound the other way.
#[must_use]
pub fn inverted((positions, triangles): &Triangles) -> Triangles {
    (positions.clone(), triangles.iter().map(|&[a, b, c]| [a, c, b]).collect())
}

/// Both meshes in one; vertices are not merged.
#[must_use]
pub fn joined((positions, triangles): &Triangles, (others, more): &Triangles) -> Triangles {
    let first = positions.len() as u32;
    let mut all = triangles.clone();
    all.extend(more.iter().map(|t| t.map(|v| v + first)));
    ([positions.as_slice(), others.as_slice()].concat(), all)
}

/// Two disjoint closed parts: a unit sphere of 320 triangles at the origin and a cube of 108, side
/// 2, centred at (4, 0, 0).
#[must_use]
pub fn two_parts() -> Triangles {
    let identity = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    joined(&icosphere(2), &transformed(&cube(3), identity, [4.0, 0.0, 0.0]))
}
