//! How far the hulls of two sets of points are apart, in f32.
//!
//! The search of [`convex_gap`](super::convex_gap): from simplex to simplex of the differences of
//! two points, towards the one next to the origin. Nothing that it decides proves anything. The
//! hulls are apart by the gap along a direction, whichever was tried. A point is in a hull if its
//! weights are not negative, however they were rounded. So a simplex that rounding misjudges costs
//! rounds and no truth. Derivation: `core/docs/rounding.md` §26.

use super::real_vector::RealVector;
use crate::num::{Real, difference, dot, greater};
use glam::Vec3;

/// Squares of the lengths that matter.
#[derive(Clone, Copy, Debug)]
pub struct GapLimits {
    /// Sets that are farther apart need no further search.
    pub far_sq: f32,
    /// Nor do sets with points that are at most so near. Negative: none are.
    pub near_sq: f32,
}

/// What a search has found of two sets of points.
#[derive(Clone, Copy, Debug)]
pub struct HullGap {
    /// The square of the greatest gap along a direction; 0 if there is none.
    pub gap_sq: f32,
    /// The direction of this gap, from the first set to the second.
    pub direction: Vec3,
    /// The squared distance of two of the points, one of either set.
    pub vertex_sq: f32,
    /// Places of these points in the sets.
    pub vertices: [usize; 2],
    /// The squared distance of a point of either hull.
    pub hull_sq: f32,
}

/// Most simplices of a search. Few take six.
const MOST_ROUNDS: usize = 12;

/// The part of a direction's square that the gap along it must have before the search ends. No
/// answer depends on it.
const SETTLED: f32 = 1.0 - 1e-5;

/// A vector whose square is less has no direction in f32.
const NO_DIRECTION_SQ: f32 = 1.0 / (1u64 << 40) as f32;

const ZERO: Real = Real(0.0);

/// How far the hulls of `first` and `second` are apart. `start` is the direction that is tried
/// first.
#[inline(never)]
pub fn hull_gap(first: &[Vec3], second: &[Vec3], start: Vec3, limits: GapLimits) -> HullGap {
    gap_of(first, second, start, limits)
}

/// The same of two triangles: a copy whose loops over corners are unrolled, but for small code.
#[cfg_attr(not(meshsweep_small), inline(never))]
#[cfg_attr(meshsweep_small, inline(always))]
pub fn triangle_gap(
    first: &[Vec3; 3],
    second: &[Vec3; 3],
    start: Vec3,
    limits: GapLimits,
) -> HullGap {
    if cfg!(meshsweep_small) {
        return hull_gap(first, second, start, limits);
    }
    gap_of(first, second, start, limits)
}

#[inline(always)]
fn gap_of(first: &[Vec3], second: &[Vec3], start: Vec3, limits: GapLimits) -> HullGap {
    let mut found = HullGap {
        gap_sq: 0.0,
        direction: start,
        vertex_sq: f32::INFINITY,
        vertices: [0; 2],
        hull_sq: f32::INFINITY,
    };
    // Any corners: zeros would be cleared by a call.
    let mut simplex = Simplex { corners: [RealVector::from(start); 4], count: 0 };
    let mut direction = start;
    for _ in 0..MOST_ROUNDS {
        let direction_sq = dot(direction, direction);
        if Real(direction_sq) < Real(NO_DIRECTION_SQ) {
            break;
        }
        let (p, top) = highest(first, direction);
        let (q, low) = highest(second, -direction);
        let (Some(&from), Some(&to)) = (first.get(p), second.get(q)) else { break };
        let along = -low - top;
        if Real(along) > ZERO {
            let gap_sq = along * along / direction_sq;
            if Real(gap_sq) > Real(found.gap_sq) {
                (found.gap_sq, found.direction) = (gap_sq, direction);
            }
            if Real(gap_sq) > Real(limits.far_sq) {
                break;
            }
        }
        let corner = difference(to, from);
        let corner_sq = dot(corner, corner);
        if Real(corner_sq) < Real(found.vertex_sq) {
            (found.vertex_sq, found.vertices) = (corner_sq, [p, q]);
            found.hull_sq = crate::num::lesser(found.hull_sq, corner_sq);
        }
        let is_settled = simplex.count > 0 && Real(along) >= Real(SETTLED * direction_sq);
        if Real(found.hull_sq) <= Real(limits.near_sq) || is_settled || simplex.has(corner) {
            break;
        }
        let Nearest { point, direction: next } = simplex.add(corner.into());
        let point = Vec3::from(point);
        found.hull_sq = crate::num::lesser(found.hull_sq, dot(point, point));
        if Real(found.hull_sq) <= Real(limits.near_sq) {
            break;
        }
        direction = next.into();
    }
    found
}

/// The place of the point that is farthest along a direction, and its height.
#[inline(always)]
fn highest(points: &[Vec3], direction: Vec3) -> (usize, f32) {
    let (mut place, mut most) = (0, f32::MIN);
    for (at, point) in points.iter().enumerate() {
        let height = dot(*point, direction);
        if Real(height) > Real(most) {
            (place, most) = (at, height);
        }
    }
    (place, most)
}

/// Up to four differences of points.
#[derive(Clone, Copy)]
struct Simplex {
    corners: [RealVector; 4],
    count: usize,
}

/// The point of a simplex next to the origin.
struct Nearest {
    /// A point of the simplex: its weights are not negative.
    point: RealVector,
    /// About the same, where the weights have fewer digits than the direction.
    direction: RealVector,
}

impl Nearest {
    #[inline(always)]
    fn at(point: RealVector) -> Nearest {
        Nearest { point, direction: point }
    }
}

impl Simplex {
    fn has(&self, corner: Vec3) -> bool {
        self.corners.iter().take(self.count).any(|&known| Vec3::from(known) == corner)
    }

    /// Adds a corner, and keeps those that the nearest point needs.
    #[inline(always)]
    fn add(&mut self, corner: RealVector) -> Nearest {
        if let Some(slot) = self.corners.get_mut(self.count) {
            *slot = corner;
            self.count += 1;
        }
        let [a, b, c, d] = self.corners;
        match self.count {
            1 => Nearest::at(a),
            2 => self.keep_of_segment(a, b),
            3 => self.keep_of_triangle([a, b, c]),
            _ => self.keep_of_tetrahedron([a, b, c, d]),
        }
    }

    #[inline(always)]
    fn keep<const N: usize>(&mut self, corners: [RealVector; N]) {
        self.corners.iter_mut().zip(corners).for_each(|(slot, corner)| *slot = corner);
        self.count = N;
    }

    #[inline(always)]
    fn keep_one(&mut self, corner: RealVector) -> Nearest {
        self.keep([corner]);
        Nearest::at(corner)
    }

    /// Of an edge, with the part of the way along it. The part is from 0 to 1.
    #[inline(always)]
    fn keep_edge(&mut self, a: RealVector, b: RealVector, part: Real) -> Nearest {
        self.keep([a, b]);
        Nearest::at(a + (b - a) * part)
    }

    fn keep_of_segment(&mut self, a: RealVector, b: RealVector) -> Nearest {
        let along = b - a;
        let (part, whole) = (-a.dot(along), along.dot(along));
        if part <= ZERO || whole <= ZERO {
            return self.keep_one(a);
        }
        if part >= whole {
            return self.keep_one(b);
        }
        self.keep_edge(a, b, quotient(part, whole))
    }

    /// By the regions of Ericson, *Real-Time Collision Detection*, 5.1.5.
    #[inline(never)]
    fn keep_of_triangle(&mut self, [a, b, c]: [RealVector; 3]) -> Nearest {
        let (ab, ac) = (b - a, c - a);
        let (d1, d2) = (-ab.dot(a), -ac.dot(a));
        if d1 <= ZERO && d2 <= ZERO {
            return self.keep_one(a);
        }
        let (d3, d4) = (-ab.dot(b), -ac.dot(b));
        if d3 >= ZERO && d4 <= d3 {
            return self.keep_one(b);
        }
        let vc = d1 * d4 - d3 * d2;
        if vc <= ZERO && d1 > ZERO && d3 <= ZERO {
            return self.keep_edge(a, b, quotient(d1, d1 - d3));
        }
        let (d5, d6) = (-ab.dot(c), -ac.dot(c));
        if d6 >= ZERO && d5 <= d6 {
            return self.keep_one(c);
        }
        let vb = d5 * d2 - d1 * d6;
        if vb <= ZERO && d2 > ZERO && d6 <= ZERO {
            return self.keep_edge(a, c, quotient(d2, d2 - d6));
        }
        let va = d3 * d6 - d5 * d4;
        let (e4, e5) = (d4 - d3, d5 - d6);
        if va <= ZERO && e4 >= ZERO && e5 >= ZERO && e4 + e5 > ZERO {
            return self.keep_edge(b, c, quotient(e4, e4 + e5));
        }
        let normal = ab.cross(ac);
        let normal_sq = normal.dot(normal);
        let weights = [va, vb, vc, ZERO];
        let Some(point) = weighted([a, b, c, c], weights).filter(|_| normal_sq > ZERO) else {
            return self.keep_one(a);
        };
        self.keep([a, b, c]);
        // The normal has more digits than the sum of the corners.
        let direction = normal * quotient(normal.dot(a), normal_sq);
        Nearest { point, direction }
    }

    /// The last corner is the one that was added.
    #[inline(never)]
    fn keep_of_tetrahedron(&mut self, [a, b, c, d]: [RealVector; 4]) -> Nearest {
        let mut best: Option<(Real, Simplex, Nearest)> = None;
        let mut heights = [ZERO; 3];
        // Each face at the new corner, and the corner across from it.
        let faces = [([d, b, c], a), ([d, c, a], b), ([d, a, b], c)];
        for (([p, q, r], apex), height) in faces.into_iter().zip(&mut heights) {
            let normal = (q - p).cross(r - p);
            let (of_origin, of_apex) = (-normal.dot(p), normal.dot(apex - p));
            if of_origin > ZERO && of_apex > ZERO || of_origin < ZERO && of_apex < ZERO {
                *height = quotient(of_origin, of_apex);
                continue;
            }
            let mut face = Simplex { corners: [p, q, r, r], count: 3 };
            let nearest = face.keep_of_triangle([p, q, r]);
            let square = nearest.direction.dot(nearest.direction);
            if best.as_ref().is_none_or(|(least, ..)| square < *least) {
                best = Some((square, face, nearest));
            }
        }
        if let Some((_, face, nearest)) = best {
            *self = face;
            return nearest;
        }
        // The origin is inside.
        let [x, y, z] = heights;
        let last = greater(ZERO, Real(1.0) - ((x + y) + z));
        let point = weighted([a, b, c, d], [x, y, z, last]).unwrap_or(d);
        Nearest { point, direction: RealVector::from(Vec3::ZERO) }
    }
}

#[inline(always)]
fn quotient(part: Real, whole: Real) -> Real {
    Real(part.0 / whole.0)
}

/// The point with these weights over their sum; negative ones count as 0. `None` if the sum is 0 or
/// infinite.
#[inline(always)]
fn weighted([a, b, c, d]: [RealVector; 4], weights: [Real; 4]) -> Option<RealVector> {
    let [x, y, z, w] = weights.map(|weight| greater(ZERO, weight));
    let sum = (x + y) + (z + w);
    if !(sum.0 > 0.0 && sum.0 < f32::INFINITY) {
        return None;
    }
    let [x, y, z, w] = [x, y, z, w].map(|weight| quotient(weight, sum));
    Some((a * x + b * y) + (c * z + d * w))
}

#[cfg(test)]
mod tests {
    use super::{GapLimits, hull_gap};
    use glam::Vec3;

    const OPEN: GapLimits = GapLimits { far_sq: f32::MAX, near_sq: -1.0 };
    const FLAT: [Vec3; 3] = [Vec3::ZERO, Vec3::new(4.0, 0.0, 0.0), Vec3::new(0.0, 4.0, 0.0)];

    fn both(second: [Vec3; 3]) -> [f32; 2] {
        let found = hull_gap(&FLAT, &second, Vec3::new(0.3, 0.2, 0.9), OPEN);
        assert!(found.hull_sq <= found.vertex_sq);
        [found.gap_sq, found.hull_sq].map(f32::sqrt)
    }

    #[test]
    fn both_ends_are_the_distance_of_faces_edges_and_vertices() {
        let at = |x: f32, y: f32, z: f32| {
            [(0.0, 0.0, 0.0), (0.5, 0.0, 2.0), (0.0, 0.5, 2.0)]
                .map(|(a, b, c)| Vec3::new(a + x, b + y, c + z))
        };
        for (second, distance) in [
            (at(1.0, 1.0, 1.0), 1.0),
            (at(-4.0, 1.0, 1.0), 17f32.sqrt()),
            (at(5.0, 5.0, 0.0), 18f32.sqrt()),
            (at(1.0, 1.0, -5.0), 3.0),
        ] {
            let [gap, hull] = both(second);
            assert!(gap <= distance * 1.000_01 && hull >= distance * 0.999_99, "{gap} {hull}");
            assert!(hull - gap < 1e-4 * distance, "{second:?}: {gap} {hull} {distance}");
        }
    }

    #[test]
    fn hulls_that_pass_through_each_other_have_no_gap_and_a_common_point() {
        let spike = [(0.5, 0.5, -9.0), (1.0, 0.5, -9.0), (1.0, 1.0, 9.0)];
        let [gap, hull] = both(spike.map(|(x, y, z)| Vec3::new(x, y, z)));
        assert!(gap == 0.0 && hull < 1e-5, "{gap} {hull}");
    }

    #[test]
    fn a_search_ends_as_soon_as_a_limit_tells() {
        let second = FLAT.map(|p| p + Vec3::new(0.0, 0.0, 3.0));
        let ask = |far_sq, near_sq| {
            hull_gap(&FLAT, &second, Vec3::new(0.0, 0.0, 1.0), GapLimits { far_sq, near_sq })
        };
        assert_eq!(ask(8.0, -1.0).gap_sq, 9.0);
        assert!(ask(100.0, 30.0).vertex_sq <= 30.0);
    }
}
