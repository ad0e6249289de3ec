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

use super::search::{Searched, SideSearch};
use super::viewed_side::{ViewedSide, cross, is_flat, is_same, viewed_side};
use crate::bvh::point::leaf::bounds::{TriangleTaker, each_triangle, limit_of, lower_of};
use crate::bvh::point::leaf::distance::nearest_within;
use crate::bvh::point::leaf::limit::LeafLimit;
use crate::bvh::point::leaf::squares::LeafSquares;
use crate::bvh::point::query::PointQuery;
use crate::bvh::point::triangle_visitor::follow;
use crate::bvh::tree::descent::{LeafVisit, LeafVisitor};
use crate::bvh::tree::format::{Bvh, FanLeaf, lanes_of};
use crate::geom::norm_1;
use crate::num::tolerance::{
    EDGE_FEATURE_ERROR, LARGEST_ETA, SIDE_BAND, SIDE_BAND_ROUNDINGS, SIDE_FEATURE,
    SIDE_FEATURE_ROUNDINGS, SIDE_NORMAL, SIDE_SUM_NORMAL, SIDE_SUM_TERM, SIDE_SUM_WEIGHT,
    SIDE_SUM_WEIGHTS, SIGN_COSINE, TRUSTED_DIRECTION_SQ, U32, VERTEX_FEATURE_ERROR,
};
use crate::num::{Real, greater, sqrt_approx};
use crate::query::Side;
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
#[cfg_attr(meshsweep_small, inline(never))]
#[cfg_attr(not(meshsweep_small), inline)]
pub(crate) fn band_of(query: &PointQuery, distance_sq: f32) -> f32 {
    let distance = Real(sqrt_approx(distance_sq));
    (distance * Real(SIDE_BAND) + Real(query.rounding).times_power(SIDE_BAND_ROUNDINGS)).0
}

impl<'p> Candidates<'p> {
    pub(crate) fn new(query: &'p PointQuery, distance_sq: f32) -> Self {
        let (distance, band) = (sqrt_approx(distance_sq), band_of(query, distance_sq));
        let feature_limit = distance * SIDE_FEATURE + SIDE_FEATURE_ROUNDINGS * query.rounding;
        Candidates { query, band, feature_limit }
    }
}

/// The side by the feature that all candidates share, if that proves one. `corners` are those of
/// any candidate.
pub(crate) fn side_of_shared_feature(
    search: &mut SideSearch<'_, '_>,
    candidates: &Candidates<'_>,
    corners: [Vec3; 3],
) -> Searched<Side> {
    let limit = limit_of(candidates.query, candidates.band);
    let (mut key_limit, mut beyond) = (0, LeafLimit::NONE);
    follow(candidates.query, limit, &mut key_limit, &mut beyond);
    let known = LeafSquares::NONE;
    let mut shared = Shared { candidates, key_limit, beyond, known, corners, kept: [true; 3] };
    if !search.descend(candidates.query, &mut shared)? {
        return Some(None);
    }
    let [a, b, c] = corners;
    let about = match shared.kept {
        [true, false, false] => about_vertex(candidates, a),
        [false, true, false] => about_vertex(candidates, b),
        [false, false, true] => about_vertex(candidates, c),
        [true, true, false] => about_edge(candidates, [a, b]),
        [false, true, true] => about_edge(candidates, [b, c]),
        [true, false, true] => about_edge(candidates, [c, a]),
        _ => None,
    };
    let Some(About { feature, to_query, feature_error, inexact }) = about else {
        return Some(None);
    };
    let mut star = Star { tree: search.tree, limit: key_limit, feature, sum: Sum::NONE };
    if !search.descend(candidates.query, &mut star)? {
        return Some(None);
    }
    Some(star.sum.side(to_query, feature_error, inexact))
}

/// Finds the corners that all candidates share.
struct Shared<'a> {
    candidates: &'a Candidates<'a>,
    key_limit: u32,
    beyond: LeafLimit,
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
        let low = nearest_within(leaf, query, &self.beyond, Some(&mut self.known))?.low;
        let Shared { candidates, beyond, known, .. } = self;
        let low_sq = beyond.low_sq;
        let mut lanes = 0;
        let taker = CandidatesOfLeaf { candidates, low_sq, leaf, lanes: &mut lanes };
        each_triangle(query, leaf, beyond, (low, known), taker);
        for (kept, &corner) in self.kept.iter_mut().zip(&self.corners) {
            *kept = *kept && lanes & !leaf.lanes_at(corner) == 0;
        }
        Some(self.kept != [false; 3])
    }
}

/// Finds the candidates of a leaf.
struct CandidatesOfLeaf<'a, 'l> {
    candidates: &'a Candidates<'a>,
    low_sq: f32,
    leaf: &'a FanLeaf<'l>,
    /// Bits of the triangles.
    lanes: &'a mut u32,
}

impl TriangleTaker for CandidatesOfLeaf<'_, '_> {
    #[inline]
    fn triangle(
        &mut self,
        lane: usize,
        seen: Option<&[Vec3; 3]>,
        [distance_sq, lower_bound_sq]: [f32; 2],
    ) {
        let &Candidates { query, band, .. } = self.candidates;
        if lower_bound_sq <= self.low_sq
            && lower_of(self.leaf, lane, query.p, distance_sq, lower_bound_sq) <= band
            && viewed_side(query, self.leaf, lane, seen) != ViewedSide::Flat
        {
            *self.lanes |= 1 << (lane & 31);
        }
    }
}

/// A sum of weighted unit normals, and its rounding.
///
/// The flag stands between numbers that begin as zeros: more of them at once would be a call of
/// `memclr`.
#[repr(C)]
struct Sum {
    normal: Vec3,
    /// Sum of the weights, each times the relative rounding of its normal. A sliver's is large.
    unsure: f32,
    /// Every triangle has a trusted normal and directions.
    is_sound: bool,
    weight: f32,
    count: f32,
    /// No triangle reaches a direction whose cosine to the query is greater.
    eta: f32,
}

impl Sum {
    const NONE: Sum =
        Sum { normal: Vec3::ZERO, unsure: 0.0, is_sound: true, weight: 0.0, count: 0.0, eta: 0.0 };

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
        let roundings = SIDE_SUM_NORMAL * self.unsure
            + (SIDE_SUM_WEIGHTS + SIDE_SUM_TERM * count) * self.weight
            + SIDE_SUM_WEIGHT * count;
        let margin = U32 * (norm_1(to_query) * roundings + SIDE_SUM_NORMAL * self.weight * inexact)
            + feature_error * self.eta * self.eta * norm_1(to_query);
        if !self.is_sound || self.count == 0.0 || margin.is_nan() || self.eta >= LARGEST_ETA {
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

/// A vertex or an edge, and what the terms of its sum take from the query.
enum Feature {
    Vertex {
        at: Vec3,
        /// The direction to the query.
        u: Vec3,
    },
    Edge {
        ends: [Vec3; 2],
        edge: Vec3,
        length_sq: f32,
        /// The direction from the edge to the query.
        u: Vec3,
        /// Rounding of `u`.
        noise: f32,
    },
}

/// Sums over all triangles of a feature.
struct Star<'t> {
    tree: &'t Bvh<'t>,
    limit: u32,
    feature: Feature,
    sum: Sum,
}

impl LeafVisitor for Star<'_> {
    fn limit(&self) -> u32 {
        self.limit
    }

    fn leaf(&mut self, visit: &LeafVisit<'_>) -> Option<bool> {
        let marked = match self.tree.if_marked() {
            Some(tree) => Some((tree, tree.links(visit.node)?.triangle(visit.child))),
            None => None,
        };
        let leaf = &visit.leaf;
        let lanes = match self.feature {
            Feature::Vertex { at, .. } => leaf.lanes_at(at),
            Feature::Edge { ends: [one, other], .. } => leaf.lanes_at(one) & leaf.lanes_at(other),
        };
        for lane in lanes_of(lanes) {
            let factor = match marked {
                Some((tree, first)) => factor(tree, first.wrapping_add(lane as u32)),
                None => 1.0,
            };
            self.take(leaf, lane, factor);
        }
        Some(true)
    }
}

impl Star<'_> {
    /// Adds a triangle of the feature. `factor` multiplies its normal: −1 for a turned triangle, 0
    /// for a sideless one, 1 for others.
    #[inline(always)]
    fn take(&mut self, leaf: &FanLeaf<'_>, lane: usize, factor: f32) {
        let corners = leaf.corners(lane);
        let [a, b, c] = corners;
        // About a vertex from the vertex on.
        let [x, y, z] = match &self.feature {
            Feature::Vertex { at, .. } if is_same(&b, at) && !is_same(&a, at) => [b, c, a],
            Feature::Vertex { at, .. } if is_same(&c, at) && !is_same(&a, at) => [c, a, b],
            _ => corners,
        };
        let (e, g) = (y - x, z - x);
        let (normal, size) = cross(e, g);
        if normal == Vec3::ZERO && is_flat(leaf, lane, norm_1(size)) {
            return;
        }
        let mut is_known = is_sound(normal, size) && factor != 0.0;
        let (weight, eta);
        match &self.feature {
            Feature::Vertex { u, .. } => {
                let largest = normal.abs().max_element();
                let scaled = normal * (1.0 / largest);
                weight = libm::atan2f(largest * sqrt_approx(scaled.dot(scaled)), e.dot(g));
                let unit = |v: Vec3| v * (1.0 / sqrt_approx(v.dot(v)));
                let (e, g) = (unit(e), unit(g));
                let reached = e.dot(*u).max(g.dot(*u)) + SIGN_COSINE * U32;
                // Directions between the two are (λe + μg) / |λe + μg|. The divisor is at least
                // (λ + μ)·cos(α/2).
                let half = 0.5 * (1.0 + e.dot(g)) - SIGN_COSINE * U32;
                eta = if reached <= 0.0 {
                    0.0
                } else if half > 0.0 {
                    reached / sqrt_approx(half)
                } else {
                    f32::INFINITY
                };
            }
            Feature::Edge { ends: [a, b], edge, length_sq, u, noise } => {
                let third = corners.iter().find(|c| !is_same(c, a) && !is_same(c, b));
                let Some(third) = third else { return };
                let leg = *third - *a;
                let inward = leg - *edge * (leg.dot(*edge) / *length_sq);
                let height = sqrt_approx(inward.dot(inward));
                is_known &= height != 0.0;
                let noise = SIGN_COSINE * U32 * (norm_1(leg) / height + *noise);
                let reached = inward.dot(*u) / height + noise;
                weight = 1.0;
                eta = if reached > 0.0 { reached } else { 0.0 };
            }
        }
        if is_known {
            self.sum.add(normal * factor, size, weight, eta);
        } else {
            self.sum.is_sound = false;
        }
    }
}

/// Whether a normal is finite, and so large that underflow and cancellation leave it a direction.
#[cfg_attr(meshsweep_small, inline(never))]
fn is_sound(normal: Vec3, size: Vec3) -> bool {
    norm_1(size) > TRUSTED_DIRECTION_SQ
        && normal.abs().max_element() > SIDE_NORMAL * U32 * norm_1(size)
}

/// A feature, and what [`Sum::side`] takes of it.
struct About {
    feature: Feature,
    to_query: Vec3,
    feature_error: f32,
    inexact: f32,
}

fn about_vertex(candidates: &Candidates<'_>, vertex: Vec3) -> Option<About> {
    let s = candidates.query.p - vertex;
    let far = sqrt_approx(s.dot(s));
    if !(far > 0.0 && far <= candidates.feature_limit) {
        return None;
    }
    let feature = Feature::Vertex { at: vertex, u: s * (1.0 / far) };
    Some(About { feature, to_query: s, feature_error: VERTEX_FEATURE_ERROR, inexact: 0.0 })
}

fn about_edge(candidates: &Candidates<'_>, [a, b]: [Vec3; 2]) -> Option<About> {
    let (edge, s) = (b - a, candidates.query.p - a);
    let (along, length_sq) = (s.dot(edge), edge.dot(edge));
    let rounding = SIGN_COSINE * U32 * norm_1(s) * norm_1(edge);
    let across = s - edge * (along / length_sq);
    let far = sqrt_approx(across.dot(across));
    // The foot must lie within the edge, and clear of its ends.
    if !(along > rounding && length_sq - along > rounding && far > 0.0)
        || far + SIGN_COSINE * U32 * norm_1(s) > candidates.feature_limit
    {
        return None;
    }
    let (u, noise) = (across * (1.0 / far), norm_1(s) / far);
    let feature = Feature::Edge { ends: [a, b], edge, length_sq, u, noise };
    Some(About { feature, to_query: across, feature_error: EDGE_FEATURE_ERROR, inexact: norm_1(s) })
}
