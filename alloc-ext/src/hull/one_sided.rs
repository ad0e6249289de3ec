//! How far the hull can be from the surface: a certified bound of the one-sided Hausdorff distance from triangles to a model.
//!
//! Branch and bound. The distance to the surface is 1-Lipschitz, so a triangle is bounded from its centre; the distance to
//! one surface triangle is convex, so it is also bounded from its corners. The larger half is split until the bound is
//! within a few percent of a distance that was found.

use glam::DVec3;
use meshsweep_core::geom::point_triangle;
use meshsweep_core::query::{Stop, closest_point};
use meshsweep_core::{Model, QueueEntry};
use std::collections::BinaryHeap;

/// The bound may exceed the true distance by this factor.
const SLACK: f64 = 1.05;

/// A midpoint is rounded, so the halves of a piece miss what they were cut from by up to √3·2^-53 of a coordinate. After so many cuts that this is not
/// enough, 2^9/√3, a piece is no larger than a rounding.
const MIDPOINTS: f64 = 1.0 / (1u64 << 44) as f64;

struct Piece {
    bound: f64,
    corners: [DVec3; 3],
}

impl Ord for Piece {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.bound.total_cmp(&other.bound)
    }
}
impl PartialOrd for Piece {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}
impl PartialEq for Piece {
    fn eq(&self, other: &Self) -> bool {
        self.bound.total_cmp(&other.bound).is_eq()
    }
}
impl Eq for Piece {}

/// Where a point's nearest surface is.
pub struct Nearest {
    /// Not above the distance.
    pub lower: f64,
    /// Not below the distance.
    pub upper: f64,
    /// Corners of a triangle of the surface, best of the nearest one, if one is known.
    pub triangle: Option<[DVec3; 3]>,
}

/// Bounds of the largest distance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Farthest {
    /// A distance that a point has at least.
    pub lower: f64,
    /// A distance that no point exceeds; infinite if a query failed.
    pub upper: f64,
}

/// Largest distance from a point of `triangles` to the surface that `nearest` knows; `upper` exceeds `lower` by a twentieth where 20,000 queries do for that, and by more where it
/// is not above `enough`.
///
/// Cost: one query for each triangle, and some dozens more for the farthest.
pub fn farthest(
    triangles: impl Iterator<Item = [DVec3; 3]>,
    enough: f64,
    mut nearest: impl FnMut(DVec3) -> Option<Nearest>,
) -> Farthest {
    let mut bound_of = |corners: [DVec3; 3], found: &mut f64| {
        let [a, b, c] = corners;
        let centre = (a + b + c) / 3.0;
        let Some(near) = nearest(centre) else { return f64::INFINITY };
        *found = found.max(near.lower);
        let reach = corners.iter().map(|p| (*p - centre).length()).fold(0.0, f64::max);
        let lipschitz = near.upper + reach;
        let convex = near.triangle.map_or(f64::INFINITY, |[p, q, r]| {
            corners.iter().map(|&v| point_triangle(v, p, q, r).upper).fold(0.0, f64::max)
        });
        lipschitz.min(convex) * (1.0 + 1e-12)
    };
    let mut found = 0f64;
    let mut heap = BinaryHeap::new();
    let mut size = 0f64;
    for corners in triangles {
        size = corners.iter().fold(size, |size, p| size.max(p.abs().max_element()));
        let bound = bound_of(corners, &mut found);
        heap.push(Piece { bound, corners });
    }
    // Enough to settle any mesh at hand; what is left over keeps its bound.
    let mut budget = 20_000;
    while let Some(piece) = heap.pop() {
        if piece.bound <= (found * SLACK).max(enough) || budget == 0 || piece.bound == 0.0 {
            return Farthest { lower: found, upper: piece.bound.max(found) + size * MIDPOINTS };
        }
        budget -= 1;
        for half in bisect(piece.corners) {
            let bound = bound_of(half, &mut found).min(piece.bound);
            heap.push(Piece { bound, corners: half });
        }
    }
    Farthest { lower: found, upper: found }
}

/// Least found upper bound of the largest distance from a point of `triangles` (local frame) to the model's surface; local frame.
///
/// `surface[source]` are corners of the surface's triangle with that number, local frame. Cost: as [`farthest`].
pub fn hull_to_surface(
    model: &Model<'_>,
    triangles: impl Iterator<Item = [DVec3; 3]>,
    surface: impl Fn(u32) -> Option<[DVec3; 3]>,
) -> f64 {
    let mut queue = vec![QueueEntry::EMPTY; model.capacities().queue + 1024];
    let scale = model.scale();
    let nearest = |point: DVec3| {
        // The query is rounded to f32: the distance to what was asked is part of the bound.
        let asked = (point * scale).as_vec3();
        let offset = (asked.as_dvec3() / scale - point).length();
        let answer = closest_point(model, asked.to_array(), &Stop::EXACT, &mut queue).ok()?;
        Some(Nearest {
            lower: f64::from(answer.lower) / scale - offset,
            upper: f64::from(answer.upper) / scale + offset,
            triangle: answer.triangle.and_then(&surface),
        })
    };
    farthest(triangles, 0.0, nearest).upper
}

/// Two halves, cut across the longest edge.
fn bisect([a, b, c]: [DVec3; 3]) -> [[DVec3; 3]; 2] {
    let (ab, bc, ca) = ((b - a).length_squared(), (c - b).length_squared(), (a - c).length_squared());
    let [p, q, r] = if ab >= bc && ab >= ca {
        [a, b, c]
    } else if bc >= ca {
        [b, c, a]
    } else {
        [c, a, b]
    };
    let middle = (p + q) * 0.5;
    [[p, middle, r], [middle, q, r]]
}
