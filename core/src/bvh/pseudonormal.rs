//! Angle-weighted pseudonormals without stored mesh connectivity. A descent finds the triangles of
//! a feature, which is a vertex or an edge, by equal coordinates.
//!
//! *Which feature.* The sum of [`signed_distance`](super::signed_distance) is taken about a feature
//! that all possibly closest triangles share. It is nearly the closest feature, not certainly.
//!
//! *Error of the sum.* Let u be the direction from the feature to the query. Let η be such that no
//! triangle about the feature reaches a direction x with x·u > η. Then the winding number is the
//! same, w₀, wherever x·u > η. The rest of the sum, over 0 < x·u ≤ η, is at most 2·∫x·u ≤ 2πη²
//! about a vertex. By the same argument in the plane across an edge it is η² about an edge.
//!
//! *Nothing crosses the way from the feature to the query.* Triangles about the feature do not
//! contain the direction u. Any other triangle there would be nearer than the feature. So it would
//! be among the possibly closest triangles, and these all share the feature.
//!
//! So the product with u has the right sign if it exceeds this error and rounding.

use super::descent::{LeafVisit, LeafVisitor};
use super::leaf_distance::{LeafLimit, nearest_within};
use super::leaf_squares::LeafSquares;
use super::point_query::PointQuery;
use super::side_search::Search;
use super::triangle_bounds::{each_triangle, limit_of, lower_of};
use super::viewed_side::{ViewedSide, cross, is_flat, norm_1, viewed_side};
use crate::bvh::format::{Bvh, FanLeaf};
use crate::num::tolerance::{SIGN_COSINE, TRUSTED_DIRECTION_SQ, U32};
use crate::num::{greater, sqrt_approx};
use crate::query::{QueryError, Side};
use glam::Vec3;

/// The triangles that may be the closest one.
pub(crate) struct Candidates<'p> {
    query: &'p PointQuery,
    /// Lower bound, grid units, up to which a triangle is a candidate: more than twice the need of
    /// rounding.
    pub(crate) band: f32,
    /// All triangles nearer than a feature are candidates if the feature is within this distance,
    /// grid units.
    feature_limit: f32,
}

/// [`Candidates::band`] if the nearest triangle is at this squared distance.
#[inline]
pub(crate) fn band_of(query: &PointQuery, distance_sq: f32) -> f32 {
    sqrt_approx(distance_sq) * (1.0 + 128.0 * U32) + 8.0 * query.rounding
}

impl<'p> Candidates<'p> {
    pub(crate) fn new(query: &'p PointQuery, distance_sq: f32) -> Self {
        let (distance, band) = (sqrt_approx(distance_sq), band_of(query, distance_sq));
        let feature_limit = distance * (1.0 + 64.0 * U32) + 4.0 * query.rounding;
        Candidates { query, band, feature_limit }
    }
}

/// The side by the feature that all candidates share, if that proves one. `corners` are those of
/// any candidate.
pub(crate) fn side_of_shared_feature(
    search: &mut Search<'_, '_>,
    candidates: &Candidates<'_>,
    corners: [Vec3; 3],
) -> Result<Option<Side>, QueryError> {
    let limit = limit_of(candidates.query, candidates.band);
    let key_limit = candidates.query.key_limit(limit);
    let mut shared =
        Shared { candidates, limit, key_limit, known: LeafSquares::NONE, corners, kept: [true; 3] };
    if !search.descend(candidates.query, &mut shared)? {
        return Ok(None);
    }
    let ([a, b, c], p) = (corners, candidates.query.p);
    match shared.kept {
        [true, false, false] => about_vertex(search, candidates, key_limit, a, p),
        [false, true, false] => about_vertex(search, candidates, key_limit, b, p),
        [false, false, true] => about_vertex(search, candidates, key_limit, c, p),
        [true, true, false] => about_edge(search, candidates, key_limit, [a, b], p),
        [false, true, true] => about_edge(search, candidates, key_limit, [b, c], p),
        [true, false, true] => about_edge(search, candidates, key_limit, [c, a], p),
        _ => Ok(None),
    }
}

/// Finds the corners that all candidates share.
struct Shared<'a> {
    candidates: &'a Candidates<'a>,
    limit: f32,
    key_limit: u32,
    known: LeafSquares,
    corners: [Vec3; 3],
    kept: [bool; 3],
}

impl LeafVisitor for Shared<'_> {
    fn limit(&self) -> u32 {
        self.key_limit
    }

    fn leaf(&mut self, visit: &LeafVisit<'_>) -> Option<bool> {
        let (leaf, query) = (&visit.leaf, self.candidates.query);
        let limit = LeafLimit::all_low(query, self.limit);
        let low = nearest_within(leaf, query, &limit, Some(&mut self.known))?.low;
        each_triangle(
            query,
            leaf,
            &limit,
            (low, &self.known),
            |lane, seen, [distance_sq, lower_bound_sq]| {
                if lower_bound_sq > self.limit
                    || lower_of(leaf, lane, query.p, distance_sq, lower_bound_sq)
                        > self.candidates.band
                    || viewed_side(query, leaf, lane, seen) == ViewedSide::Flat
                {
                    return;
                }
                let corners = leaf.corners(lane);
                for (kept, corner) in self.kept.iter_mut().zip(&self.corners) {
                    *kept &= corners.contains(corner);
                }
            },
        );
        Some(self.kept != [false; 3])
    }
}

/// Error of the sum about a vertex, in units of η²: 2π, rounded up.
const VERTEX_FEATURE_ERROR: f32 = 6.5;

/// The same about an edge: 1, and more than the further terms up to [`LARGEST_ETA`].
const EDGE_FEATURE_ERROR: f32 = 1.2;

/// From this η on the sum is not used. Below, the next term about an edge, η⁴/4, is less than a
/// fiftieth of the first.
const LARGEST_ETA: f32 = 0.25;

/// A sum of weighted unit normals, and its rounding.
#[derive(Default)]
struct Sum {
    normal: Vec3,
    /// Sum of the weights, each times the relative rounding of its normal. A sliver's is large.
    unsure: f32,
    weight: f32,
    count: f32,
    /// No triangle reaches a direction whose cosine to the query is greater.
    eta: f32,
    /// Some triangle has no trusted normal or directions.
    broken: bool,
}

impl Sum {
    fn add(&mut self, normal: Vec3, size: Vec3, weight: f32, eta: f32) {
        let largest = normal.abs().max_element();
        let scaled = normal * (1.0 / largest);
        let length = sqrt_approx(scaled.dot(scaled));
        self.normal += scaled * (weight / length);
        self.unsure += weight * (norm_1(size) / (largest * length));
        self.weight += weight;
        self.count += 1.0;
        self.eta = greater(self.eta, eta);
    }

    /// The side by the product with `to_query`; `None` if rounding leaves it undecided.
    ///
    /// `feature_error`: the error of the product in units of η², because the feature is not exactly
    /// the closest. `inexact`: the sum of absolute values whose roundings `to_query` carries.
    fn side(&self, to_query: Vec3, feature_error: f32, inexact: f32) -> Option<Side> {
        let product = self.normal.dot(to_query);
        let count = self.count;
        let roundings = 16.0 * self.unsure + (32.0 + 2.0 * count) * self.weight + 64.0 * count;
        let margin = U32 * (norm_1(to_query) * roundings + 16.0 * self.weight * inexact)
            + feature_error * self.eta * self.eta * norm_1(to_query);
        if self.broken || self.count == 0.0 || margin.is_nan() || self.eta >= LARGEST_ETA {
            None
        } else if product > margin {
            Some(Side::Outside)
        } else if product < -margin {
            Some(Side::Inside)
        } else {
            None
        }
    }
}

/// The factor of a triangle's normal in a sum for sides.
#[cold]
#[inline(never)]
fn factor(tree: &Bvh<'_>, triangle: u32) -> f32 {
    match (tree.sideless().contains(triangle), tree.turned().contains(triangle)) {
        (true, _) => 0.0,
        (false, true) => -1.0,
        (false, false) => 1.0,
    }
}

/// Visits all triangles of a feature, each with a factor of its normal: −1 if sides are those of
/// the triangle turned, 0 if it tells no side.
struct Star<'t, F> {
    tree: &'t Bvh<'t>,
    limit: u32,
    each: F,
}

impl<F: FnMut(&FanLeaf<'_>, usize, f32)> LeafVisitor for Star<'_, F> {
    fn limit(&self) -> u32 {
        self.limit
    }

    fn leaf(&mut self, visit: &LeafVisit<'_>) -> Option<bool> {
        let marked = match self.tree.if_marked() {
            Some(tree) => Some((tree, tree.links(visit.node)?.triangle(visit.child))),
            None => None,
        };
        for lane in 0..visit.leaf.shape().triangles() {
            let factor = match marked {
                Some((tree, first)) => factor(tree, first.wrapping_add(lane as u32)),
                None => 1.0,
            };
            (self.each)(&visit.leaf, lane, factor);
        }
        Some(true)
    }
}

/// Whether a normal is finite, and so large that underflow and cancellation leave it a direction.
#[cfg_attr(meshsweep_small, inline(never))]
fn is_sound(normal: Vec3, size: Vec3) -> bool {
    norm_1(size) > TRUSTED_DIRECTION_SQ && normal.abs().max_element() > 64.0 * U32 * norm_1(size)
}

fn about_vertex(
    search: &mut Search<'_, '_>,
    candidates: &Candidates<'_>,
    limit: u32,
    vertex: Vec3,
    p: Vec3,
) -> Result<Option<Side>, QueryError> {
    let s = p - vertex;
    let far = sqrt_approx(s.dot(s));
    if !(far > 0.0 && far <= candidates.feature_limit) {
        return Ok(None);
    }
    let u = s * (1.0 / far);
    let mut sum = Sum::default();
    let each = |leaf: &FanLeaf<'_>, lane: usize, turn: f32| {
        let (e, g) = match leaf.corners(lane) {
            [a, b, c] if a == vertex => (b - a, c - a),
            [a, b, c] if b == vertex => (c - b, a - b),
            [a, b, c] if c == vertex => (a - c, b - c),
            _ => return,
        };
        let (normal, size) = cross(e, g);
        if normal == Vec3::ZERO && is_flat(leaf, lane, norm_1(size)) {
            return;
        }
        if !is_sound(normal, size) || turn == 0.0 {
            sum.broken = true;
            return;
        }
        let largest = normal.abs().max_element();
        let scaled = normal * (1.0 / largest);
        let angle = libm::atan2f(largest * sqrt_approx(scaled.dot(scaled)), e.dot(g));
        let unit = |v: Vec3| v * (1.0 / sqrt_approx(v.dot(v)));
        let (e, g) = (unit(e), unit(g));
        let reached = e.dot(u).max(g.dot(u));
        // Directions between the two are (λe + μg) / |λe + μg|. The divisor is at least
        // (λ + μ)·cos(α/2).
        let eta = if reached <= -SIGN_COSINE * U32 {
            0.0
        } else {
            let half = 0.5 * (1.0 + e.dot(g)) - SIGN_COSINE * U32;
            if half > 0.0 {
                (reached + SIGN_COSINE * U32) / sqrt_approx(half)
            } else {
                f32::INFINITY
            }
        };
        sum.add(normal * turn, size, angle, eta);
    };
    if !search.descend(candidates.query, &mut Star { tree: search.tree, limit, each })? {
        return Ok(None);
    }
    Ok(sum.side(s, VERTEX_FEATURE_ERROR, 0.0))
}

fn about_edge(
    search: &mut Search<'_, '_>,
    candidates: &Candidates<'_>,
    limit: u32,
    [a, b]: [Vec3; 2],
    p: Vec3,
) -> Result<Option<Side>, QueryError> {
    let (edge, s) = (b - a, p - a);
    let (along, length_sq) = (s.dot(edge), edge.dot(edge));
    let rounding = SIGN_COSINE * U32 * norm_1(s) * norm_1(edge);
    let across = s - edge * (along / length_sq);
    let far = sqrt_approx(across.dot(across));
    // The foot must lie within the edge, and clear of its ends.
    if !(along > rounding && length_sq - along > rounding && far > 0.0)
        || far + SIGN_COSINE * U32 * norm_1(s) > candidates.feature_limit
    {
        return Ok(None);
    }
    let u = across * (1.0 / far);
    let mut sum = Sum::default();
    let each = |leaf: &FanLeaf<'_>, lane: usize, turn: f32| {
        let corners = leaf.corners(lane);
        if !corners.contains(&a) || !corners.contains(&b) {
            return;
        }
        let [x, y, z] = corners;
        let (normal, size) = cross(y - x, z - x);
        if normal == Vec3::ZERO && is_flat(leaf, lane, norm_1(size)) {
            return;
        }
        let Some(third) = corners.into_iter().find(|&c| c != a && c != b) else { return };
        let leg = third - a;
        let inward = leg - edge * (leg.dot(edge) / length_sq);
        let height = sqrt_approx(inward.dot(inward));
        if !is_sound(normal, size) || height == 0.0 || turn == 0.0 {
            sum.broken = true;
            return;
        }
        let noise = SIGN_COSINE * U32 * (norm_1(leg) / height + norm_1(s) / far);
        let reached = inward.dot(u) / height + noise;
        sum.add(normal * turn, size, 1.0, if reached > 0.0 { reached } else { 0.0 });
    };
    if !search.descend(candidates.query, &mut Star { tree: search.tree, limit, each })? {
        return Ok(None);
    }
    Ok(sum.side(across, EDGE_FEATURE_ERROR, norm_1(s)))
}
