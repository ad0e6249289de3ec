//! The distance of a convex solid and a triangle in f64, with both ends proved.
//!
//! The search is that of Gilbert, Johnson and Keerthi, *A Fast Procedure for Computing the Distance
//! Between Complex Objects in Three-Dimensional Space* (1988). The differences of two convex sets'
//! points are a convex set. The search goes towards its point next to the origin, from simplex to
//! simplex. It proves nothing by itself: the upper end is the length of the way between two points
//! that it found, the lower end the gap along a direction that it tried. So a simplex that rounding
//! misjudges costs width and no truth. Derivation: `core/docs/rounding.md` §19.

use super::point_triangle::{Closest, closest};
use super::vector::{Point, cross, dot, minus, norm_1};
use crate::num::tolerance::{CONVEX_DEPTH, CONVEX_GAP, GAP_DIRECTION_SQ, GAP_SETTLED, U64};
use crate::num::{greater, lesser};
use glam::DVec3;

/// The distance of a convex solid and a triangle.
#[derive(Clone, Copy, Debug)]
pub struct ConvexGap {
    /// Not above the distance.
    pub lower: f64,
    /// Not below the distance.
    pub upper: f64,
    /// A point of the solid and one of the triangle. They are at most `upper` apart.
    pub points: [[f64; 3]; 2],
    /// From the solid to the triangle, of length 1: `lower` is the gap along it. Zero if `lower` is
    /// 0.
    pub direction: [f64; 3],
    /// The two still meet if each corner of one moves by less than this, each in its own direction.
    /// 0 if nothing is proved.
    pub depth: f64,
}

/// Most simplices of a search. Few searches take ten.
const MOST_ROUNDS: usize = 48;

/// A corner of the triangle less a corner of the solid.
#[derive(Clone, Copy)]
struct Difference {
    vector: Point<f64>,
    ends: [Point<f64>; 2],
}

impl Difference {
    #[inline(always)]
    fn new(from: Point<f64>, to: Point<f64>) -> Difference {
        Difference { vector: minus(to, from), ends: [from, to] }
    }
}

/// Up to four differences, and the weights of their point next to the origin.
#[derive(Clone, Copy)]
struct Simplex {
    corners: [Difference; 4],
    weights: [f64; 4],
    count: usize,
    /// If it holds the origin: a lower bound of the origin's distance from its faces.
    depth: Option<f64>,
}

impl Simplex {
    fn of(corner: Difference) -> Simplex {
        Simplex { corners: [corner; 4], weights: [1.0, 0.0, 0.0, 0.0], count: 1, depth: None }
    }

    /// The point next to the origin.
    #[inline(always)]
    fn way(&self) -> Point<f64> {
        self.sum(|corner| corner.vector)
    }

    #[inline(always)]
    fn sum(&self, of: impl Fn(&Difference) -> Point<f64>) -> Point<f64> {
        let mut sum = [0.0; 3];
        for (corner, weight) in self.corners.iter().zip(self.weights).take(self.count) {
            for (sum, x) in sum.iter_mut().zip(of(corner)) {
                *sum += x * weight;
            }
        }
        sum
    }

    #[inline(always)]
    fn has(&self, other: &Difference) -> bool {
        self.corners.iter().take(self.count).any(|corner| corner.vector == other.vector)
    }

    /// With one corner more: the face whose point is next to the origin, or all of it.
    #[inline(always)]
    fn with(&self, corner: Difference) -> Simplex {
        let mut simplex = *self;
        if let Some(slot) = simplex.corners.get_mut(self.count) {
            *slot = corner;
            simplex.count += 1;
        }
        let [a, b, c, _] = &simplex.corners;
        match simplex.count {
            1 => simplex,
            2 => segment([a, b]),
            3 => triangle([a, b, c]),
            _ => tetrahedron(&simplex.corners),
        }
    }

    /// Of corners with these weights. Corners without weight are left out.
    #[inline(always)]
    fn weighted<const N: usize>(corners: [&Difference; N], weights: [f64; N]) -> Simplex {
        let first = corners.first().copied().unwrap_or(&NOWHERE);
        let mut simplex = Simplex { count: 0, weights: [0.0; 4], ..Simplex::of(*first) };
        for (&corner, weight) in corners.into_iter().zip(weights) {
            let mut slots = simplex.corners.iter_mut().zip(&mut simplex.weights);
            if weight > 0.0
                && let Some((place, share)) = slots.nth(simplex.count)
            {
                (*place, *share) = (corner, weight);
                simplex.count += 1;
            }
        }
        simplex
    }
}

const NOWHERE: Difference = Difference { vector: [0.0; 3], ends: [[0.0; 3]; 2] };

fn segment(corners: [&Difference; 2]) -> Simplex {
    let [a, b] = corners.map(|corner| corner.vector);
    let along = minus(b, a);
    let length_sq = dot(along, along);
    let t = if length_sq > 0.0 { (-dot(a, along) / length_sq).clamp(0.0, 1.0) } else { 0.0 };
    Simplex::weighted(corners, [1.0 - t, t])
}

#[inline(never)]
fn triangle(corners: [&Difference; 3]) -> Simplex {
    let [a, b, c] = corners.map(|corner| DVec3::from_array(corner.vector));
    let Closest { u: v, v: w, .. } = closest(-a, b - a, c - a);
    Simplex::weighted(corners, [greater(0.0, 1.0 - v - w), v, w])
}

#[inline(never)]
fn tetrahedron(corners: &[Difference; 4]) -> Simplex {
    let [a, b, c, d] = corners;
    let mut nearest: Option<(f64, Simplex)> = None;
    let mut heights = [0f64; 4];
    let mut depth = f64::INFINITY;
    let mut holds = true;
    // Each face, and the corner across from it.
    let faces = [([b, c, d], a), ([a, c, d], b), ([a, b, d], c), ([a, b, c], d)];
    for ((face, apex), height) in faces.into_iter().zip(&mut heights) {
        let [p, q, r] = face.map(|corner| corner.vector);
        let (e, g) = (minus(q, p), minus(r, p));
        let normal = cross(e, g);
        let (of_apex, of_origin) = (dot(normal, minus(apex.vector, p)), -dot(normal, p));
        // The sides of both count only where rounding cannot have changed them. In a flat
        // tetrahedron they are noise.
        let rounding = CONVEX_DEPTH * U64 * (norm_1(e) * norm_1(g));
        let certain = lesser(
            of_origin.abs() - rounding * norm_1(p),
            of_apex.abs() - rounding * norm_1(minus(apex.vector, p)),
        );
        if of_apex * of_origin > 0.0 && certain > 0.0 {
            *height = of_origin / of_apex;
            depth = lesser(depth, certain / libm::sqrt(dot(normal, normal)));
            continue;
        }
        holds = false;
        let simplex = triangle(face);
        let way = simplex.way();
        let way_sq = dot(way, way);
        if nearest.is_none_or(|(least, _)| way_sq < least) {
            nearest = Some((way_sq, simplex));
        }
    }
    match nearest {
        Some((_, simplex)) if !holds => simplex,
        _ => {
            let [p, q, r, s] = heights;
            let sum = (p + q) + (r + s);
            let simplex = Simplex::weighted([a, b, c, d], heights.map(|height| height / sum));
            Simplex { depth: Some(depth), ..simplex }
        }
    }
}

/// The distance of the hull of `solid` and a triangle. The triangle may be a segment or a point.
/// Without corners the solid is the origin.
///
/// Coordinates must be finite, 0 or from 1e-60 to 1e60 in size.
///
/// Cost: for each of some three to eight simplices an inner product for each corner, and the point
/// of a simplex next to the origin.
pub fn convex_gap(solid: &[Point<f64>], triangle: &[Point<f64>; 3]) -> ConvexGap {
    let margin = CONVEX_GAP * U64 * (farthest(solid) + farthest(triangle));
    let &[first, ..] = triangle;
    let start = solid.first().copied().unwrap_or_default();
    let mut simplex = Simplex::of(Difference::new(start, first));
    let mut way = simplex.way();
    let mut way_sq = dot(way, way);
    let (mut gap_sq, mut gap_way) = (0.0, [0.0; 3]);
    for _ in 0..MOST_ROUNDS {
        let has_direction = way_sq >= GAP_DIRECTION_SQ;
        if !has_direction {
            break;
        }
        let next = Difference::new(highest(solid, way), lowest(triangle, way));
        let along = dot(way, next.vector);
        if along > 0.0 && along * along > gap_sq * way_sq {
            (gap_sq, gap_way) = (along * along / way_sq, way);
        }
        if along >= way_sq * GAP_SETTLED || simplex.has(&next) {
            break;
        }
        let nearer = simplex.with(next);
        let nearer_way = nearer.way();
        let nearer_sq = dot(nearer_way, nearer_way);
        let is_nearer = nearer_sq < way_sq;
        if nearer.depth.is_none() && !is_nearer {
            break;
        }
        (simplex, way, way_sq) = (nearer, nearer_way, nearer_sq);
        if simplex.depth.is_some() {
            break;
        }
    }
    let points = [simplex.sum(|corner| corner.ends[0]), simplex.sum(|corner| corner.ends[1])];
    let [from, to] = points;
    let between = minus(to, from);
    let lower = greater(0.0, libm::sqrt(gap_sq) - margin);
    ConvexGap {
        lower,
        upper: libm::sqrt(dot(between, between)) + margin,
        points,
        direction: if lower > 0.0 { unit(gap_way) } else { [0.0; 3] },
        depth: simplex.depth.map_or(0.0, |depth| greater(0.0, depth - margin)),
    }
}

#[inline(always)]
fn unit(way: Point<f64>) -> Point<f64> {
    let length = libm::sqrt(dot(way, way));
    way.map(|x| x / length)
}

/// The corner that is farthest along a direction.
#[inline(always)]
fn highest(corners: &[Point<f64>], way: Point<f64>) -> Point<f64> {
    let mut found = corners.first().copied().unwrap_or_default();
    let mut most = dot(way, found);
    for &corner in corners.iter().skip(1) {
        let height = dot(way, corner);
        if height > most {
            (most, found) = (height, corner);
        }
    }
    found
}

#[inline(always)]
fn lowest(corners: &[Point<f64>], way: Point<f64>) -> Point<f64> {
    highest(corners, way.map(|x| -x))
}

/// Largest 1-norm.
#[inline(always)]
fn farthest(corners: &[Point<f64>]) -> f64 {
    corners.iter().map(|&corner| norm_1(corner)).fold(0.0, greater)
}

#[cfg(test)]
mod tests {
    use super::convex_gap;

    const FLAT: [[f64; 3]; 3] = [[0.0; 3], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];

    fn cube(low: [f64; 3], size: f64) -> [[f64; 3]; 8] {
        core::array::from_fn(|i| [0, 1, 2].map(|k| low[k] + size * (i >> k & 1) as f64))
    }

    fn check(solid: &[[f64; 3]], expected: f64) {
        for triangle in [FLAT, [FLAT[1], FLAT[2], FLAT[0]], [FLAT[2], FLAT[1], FLAT[0]]] {
            let gap = convex_gap(solid, &triangle);
            assert!(gap.lower <= expected && expected <= gap.upper, "{solid:?} {gap:?}");
            assert!(gap.upper - gap.lower < 4e-13, "{solid:?} {gap:?}");
            assert_eq!(gap.depth, 0.0);
        }
    }

    #[test]
    fn points_segments_triangles_and_solids_have_tight_intervals() {
        check(&[[1.0, 1.0, 3.0]], 3.0);
        check(&[[-3.0, -4.0, 0.0]], 5.0);
        check(&[[1.0, 1.0, 3.0], [1.0, 1.0, 9.0]], 3.0);
        check(&[[-1.0, 2.0, 2.0], [5.0, 2.0, 2.0]], 2.0);
        check(&[[6.0, 6.0, -1.0], [6.0, 6.0, 1.0]], f64::sqrt(32.0));
        check(&[[1.0, 1.0, 1.0], [1.5, 1.0, 3.0], [1.0, 1.5, 3.0]], 1.0);
        check(&cube([1.0, 1.0, 0.25], 2.0), 0.25);
        check(&cube([-3.0, 1.0, -1.0], 2.0), 1.0);
        check(&cube([3.0, 3.0, 1.0], 2.0), f64::sqrt(3.0));
        check(&[[7.0, 0.0, 0.0]; 5], 3.0);
    }

    #[test]
    fn a_solid_in_a_triangle_is_known_to_meet_it_by_how_deep_it_is() {
        let gap = convex_gap(&cube([1.0, 1.0, -0.5], 1.0), &FLAT);
        assert!(gap.lower == 0.0 && gap.depth > 0.0 && gap.depth <= 0.5 + 1e-12, "{gap:?}");
        assert!(gap.upper < 1e-12, "{gap:?}");
        for deep in [0.3, 1e-3, 1e-6] {
            let gap = convex_gap(&cube([1.0, 1.0, -deep], 1.0), &FLAT);
            assert!(gap.depth <= deep * (1.0 + 1e-9) && gap.lower == 0.0, "{deep}: {gap:?}");
        }
    }

    #[test]
    fn touching_and_passing_through_have_a_lower_end_of_zero() {
        for solid in [
            &[[1.0, 1.0, 0.0], [1.0, 1.0, 2.0]][..],
            &[[1.0, 1.0, -1.0], [1.0, 1.0, 2.0]],
            &[[0.5, 0.5, -1.0], [1.0, 0.5, -1.0], [1.0, 1.0, 1.0]],
            &[[0.0; 3]],
        ] {
            let gap = convex_gap(solid, &FLAT);
            assert!(gap.lower == 0.0 && gap.upper < 1e-12, "{solid:?} {gap:?}");
        }
    }
}
