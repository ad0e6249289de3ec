//! Winding numbers of a cell's points, by counting crossings on the way to points whose winding
//! number is known.
//!
//! The way stays in the cell, so only the cell's own triangles can cross it. Every split makes the
//! count cheaper. Crossings are decided by exact predicates. A way that touches an edge or a vertex
//! is given up for another one.
//!
//! The box tree's sides ([`Bvh::signed_distance`](meshsweep_core::Bvh::signed_distance)) are no
//! proof: where components overlap, a point inside one is outside of another that is nearer. They
//! serve the choice of planes, where an error costs only a worse choice, and save four fifths of
//! the time.

use super::span::Frame;
use robust::{Coord3D, orient3d};

/// A point whose winding number is known.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reference {
    pub at: [f64; 3],
    pub winding: i32,
}

/// Points of a cell to start from.
const REFERENCES: usize = 3;

/// Points in general position between the vertices of a region.
pub(super) fn starts(frame: &Frame) -> impl Iterator<Item = [f64; 3]> + '_ {
    // Multiples of irrational numbers, so that no two weights have a simple ratio.
    [0.618_033_988_7, 0.414_213_562_4, 0.732_050_807_6].into_iter().take(REFERENCES).map(
        |step: f64| {
            let mut at = [0.0; 3];
            let mut sum = 0.0;
            for (i, vertex) in frame.vertices.iter().enumerate() {
                let weight = 0.25 + (step * (i + 1) as f64).fract();
                sum += weight;
                at.iter_mut().zip(vertex).for_each(|(at, x)| *at += weight * x);
            }
            at.map(|x| x / sum)
        },
    )
}

/// Winding number of `point`, if one of the ways is clear of edges and vertices. Triangles are all
/// that may cross the ways.
pub(super) fn winding(
    point: [f64; 3],
    references: &[Reference],
    triangles: impl Iterator<Item = [[f64; 3]; 3]> + Clone,
) -> Option<i32> {
    references.iter().find_map(|reference| {
        Some(reference.winding + crossings(point, reference.at, triangles.clone())?)
    })
}

/// How much the winding number falls on the way from `from` to `to`; `None` if the way touches an
/// edge or a vertex, or ends on a triangle.
fn crossings(
    from: [f64; 3],
    to: [f64; 3],
    triangles: impl Iterator<Item = [[f64; 3]; 3]>,
) -> Option<i32> {
    let coord = |[x, y, z]: [f64; 3]| Coord3D { x, y, z };
    let (p, q) = (coord(from), coord(to));
    let low: [f64; 3] = std::array::from_fn(|k| from[k].min(to[k]));
    let high: [f64; 3] = std::array::from_fn(|k| from[k].max(to[k]));
    let mut fall = 0;
    for [a, b, c] in triangles {
        let beside = |k: usize| {
            (a[k] < low[k] && b[k] < low[k] && c[k] < low[k])
                || (a[k] > high[k] && b[k] > high[k] && c[k] > high[k])
        };
        if beside(0) || beside(1) || beside(2) {
            continue;
        }
        let [a, b, c] = [a, b, c].map(coord);
        // Negative in front.
        let (at_from, at_to) = (orient3d(a, b, c, p), orient3d(a, b, c, q));
        if (at_from > 0.0 && at_to > 0.0) || (at_from < 0.0 && at_to < 0.0) {
            continue;
        }
        let edges = [orient3d(p, q, a, b), orient3d(p, q, b, c), orient3d(p, q, c, a)];
        let (any_left, any_right) =
            (edges.iter().any(|&e| e > 0.0), edges.iter().any(|&e| e < 0.0));
        if any_left && any_right {
            continue;
        }
        if at_from == 0.0 || at_to == 0.0 || edges.contains(&0.0) {
            return None;
        }
        // Behind a triangle it is one more than in front.
        fall += if at_from > 0.0 { 1 } else { -1 };
    }
    Some(fall)
}
