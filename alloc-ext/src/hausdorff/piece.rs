//! Pieces of triangles: their bounds, and how they are cut.

use arrayvec::ArrayVec;
use glam::DVec3;
use meshsweep_core::internal::geom::point_triangle;
use std::cmp::Ordering;

/// Largest depth of a piece that is still cut.
pub(super) const MAX_DEPTH: u32 = 14_000;

/// Largest total rounding of cut points after [`MAX_DEPTH`] cuts, relative to the largest
/// coordinate: 14,000 · 2.2 · 2^-51 < 2^-36. Searches add it to their upper bounds.
pub(super) const CUT_ROUNDING: f64 = 1.0 / (1u64 << 36) as f64;

/// Factor of a computed bound, for the few roundings of a sum and a length.
pub(super) const ROUNDED_UP: f64 = 1.0 + 1e-12;

/// Ratio of a piece's radius and its distance from the surface above which it is cut along an edge.
/// Halving would take too many steps.
const EDGE_CUT_RATIO: f64 = 4.0;

/// Part of a piece's size that is too little to cut off.
const MIN_CUT: f64 = 1e-6;

/// A part of a triangle.
#[derive(Clone, Copy)]
pub(super) struct Piece<T> {
    /// Upper bound of the distance of its points.
    pub(super) bound: f64,
    pub(super) corners: [DVec3; 3],
    /// Cuts that made it.
    pub(super) depth: u32,
    /// It is cut along an edge of the surface triangle next to it, not halved.
    pub(super) is_wide: bool,
    /// The caller's.
    pub(super) of: T,
}

impl<T> Piece<T> {
    /// A piece whose centre is at most `upper` from the surface, next to `triangle`.
    pub(super) fn new(
        corners: [DVec3; 3],
        depth: u32,
        upper: f64,
        triangle: Option<[DVec3; 3]>,
        of: T,
    ) -> Self {
        let (_, radius) = bounding_ball(&corners);
        let convex = triangle.map_or(f64::INFINITY, |triangle| farthest_corner(&corners, triangle));
        let bound = (upper + radius).min(convex) * ROUNDED_UP;
        // NaN is no bound.
        let bound = if bound.is_nan() || radius.is_nan() { f64::INFINITY } else { bound };
        let is_wide = radius > EDGE_CUT_RATIO * upper;
        Self { bound, corners, depth, is_wide, of }
    }

    /// Two or three parts that cover the piece. `triangle` is the surface triangle next to it.
    pub(super) fn parts(&self, triangle: Option<[DVec3; 3]>) -> ArrayVec<[DVec3; 3], 3> {
        let along = triangle.filter(|_| self.is_wide);
        match along.and_then(|along| cut_along_edge(self.corners, along)) {
            Some(parts) => ArrayVec::from(parts),
            None => bisect(self.corners).into_iter().collect(),
        }
    }
}

impl<T> Ord for Piece<T> {
    fn cmp(&self, other: &Self) -> Ordering {
        self.bound.total_cmp(&other.bound)
    }
}
impl<T> PartialOrd for Piece<T> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl<T> PartialEq for Piece<T> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}
impl<T> Eq for Piece<T> {}

/// Largest distance of the corners from a triangle. No point between them is farther, because the
/// distance from a triangle is convex.
pub(super) fn farthest_corner(corners: &[DVec3; 3], [a, b, c]: [DVec3; 3]) -> f64 {
    corners.iter().map(|&p| point_triangle(p, a, b, c).upper).fold(0.0, greater)
}

/// The greater of two numbers; NaN if one is.
pub(super) fn greater(a: f64, b: f64) -> f64 {
    if a.is_nan() || b <= a { a } else { b }
}

/// The centre of a triangle, and the distance of its farthest corner from there.
pub(super) fn bounding_ball(corners: &[DVec3; 3]) -> (DVec3, f64) {
    let [a, b, c] = *corners;
    let centre = (a + b + c) / 3.0;
    (centre, corners.iter().map(|p| (*p - centre).length()).fold(0.0, greater))
}

/// Cuts a piece by the plane through an edge of the triangle `along`, perpendicular to that
/// triangle. Of the three edges, the one whose plane leaves most of the piece on both sides. `None`
/// if no plane leaves more than [`MIN_CUT`] of the piece's size.
fn cut_along_edge(corners: [DVec3; 3], along: [DVec3; 3]) -> Option<[[DVec3; 3]; 3]> {
    let [p, q, r] = along;
    let normal = (q - p).cross(r - p);
    let over = |(from, to): (DVec3, DVec3)| {
        let out = (to - from).cross(normal).normalize_or_zero();
        let heights = corners.map(|v| out.dot(v - from));
        let high = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let low = heights.iter().copied().fold(f64::INFINITY, f64::min);
        (high.min(-low), heights)
    };
    let edges = [(p, q), (q, r), (r, p)].map(over);
    let (most, heights) = edges.into_iter().max_by(|a, b| a.0.total_cmp(&b.0))?;
    let size = (corners[1] - corners[0]).abs().max((corners[2] - corners[0]).abs()).max_element();
    if most.is_nan() || most <= MIN_CUT * size {
        return None;
    }
    // The corner that is alone on its side.
    let alone =
        (0..3).find(|&k| (0..3).all(|i| i == k || (heights[i] > 0.0) != (heights[k] > 0.0)))?;
    let [a, b, c] = [0, 1, 2].map(|k| corners[(alone + k) % 3]);
    let [ha, hb, hc] = [0, 1, 2].map(|k| heights[(alone + k) % 3]);
    let x = a + (b - a) * (ha / (ha - hb)).clamp(0.0, 1.0);
    let y = a + (c - a) * (ha / (ha - hc)).clamp(0.0, 1.0);
    Some([[a, x, y], [x, b, c], [x, c, y]])
}

/// Two halves, cut across the longest edge.
pub(super) fn bisect([a, b, c]: [DVec3; 3]) -> [[DVec3; 3]; 2] {
    let (ab, bc, ca) =
        ((b - a).length_squared(), (c - b).length_squared(), (a - c).length_squared());
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
