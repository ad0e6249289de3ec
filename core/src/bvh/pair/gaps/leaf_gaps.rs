//! The distances of the triangles of two leaves.
//!
//! Pairs that are apart along the direction of the last measured pair are dropped. Boxes bound the
//! others in f32, and the pair with the least bound is measured in f64. The offset between its
//! points is the next direction: most often no pair is left.

use super::int_pair_direction::IntPairDirection;
use super::question::PairQuestion;
use crate::bvh::pair::leaf_keys::{
    box_gaps_sq, heights, keys_of_triangles, may_be_near, pairs_along,
};
use crate::bvh::pair::leaf_pair::{LeafPair, TriangleBoxes};
use crate::bvh::pair::pair_keys::{distance_of, indices_of, key_limit, key_of, pair_bit};
use crate::bvh::tree::format::FanLeaf;
use crate::bvh::tree::gap::TriangleGap;
use crate::bvh::tree::node::WIDE;
use crate::bvh::tree::triangle_at::TriangleAt;
use crate::geom::fan::WIDTH;
use crate::geom::{
    Contact, GapLimits, TriangleDistance, crossing, triangle_distance, triangle_gap, triangles_meet,
};
use crate::num::tolerance::{GAP_ALONG, GAP_SLACK, LEAST_GAP_SQ, SQUARED_SLACK, U32};
use crate::num::{difference, dot, greater, lesser, up_to_f32};
use crate::query::{VertexPose, Work};
use glam::Vec3;

/// What a visit of two leaves showed.
pub(crate) struct GapVisit {
    pub(crate) goes_on: bool,
    /// A lower bound of the distance of both leaves, common units. 0 unless `keeps`.
    pub(crate) lower: f64,
    /// A bit for each pair of triangles that was measured or proved far.
    pub(crate) pairs: u64,
    /// Some pairs were proved far and not measured.
    pub(crate) has_beyond: bool,
}

/// Pairs of triangles that the caller knows already.
#[derive(Clone, Copy)]
pub(crate) struct SettledPairs {
    /// A bit for each.
    pub(crate) pairs: u64,
    /// Other pairs are settled if their gap, as computed along a direction in integers, is at least
    /// this. Common units.
    pub(crate) far: f64,
}

/// The search among the triangles of two leaves.
pub(crate) struct LeafGaps<'a> {
    pub(crate) pose: &'a VertexPose,
    /// The greater of both surface errors, common units.
    pub(crate) surface_error: f64,
    /// Direction between the points of the last measured pair that was not in contact. The size of
    /// its largest component is 1. Zero before the first such pair. `visit` skips pairs that are
    /// far apart along it.
    pub(crate) direction: [f32; 3],
    /// From point to point of the last measured pair. Zero if the pair is in contact.
    pub(crate) offset: [f64; 3],
}

impl<'a> LeafGaps<'a> {
    /// Measures one pair of triangles. Returns whether the question goes on.
    pub(crate) fn measure(
        &mut self,
        leaves: [&FanLeaf<'_>; 2],
        place: [TriangleAt; 2],
        question: &mut PairQuestion<'_>,
        work: &mut Work,
    ) -> bool {
        let [first, second] = leaves;
        let pair = LeafPair::new(self.pose, first, second);
        work.triangles = work.triangles.saturating_add(1);
        work.exact = work.exact.saturating_add(1);
        let gap = self.measured(&pair, place, self.direction_between(&pair, place));
        self.turn_to(&gap);
        question.take(&gap)
    }

    /// Visits the pairs of triangles of two leaves that may be within the limit. `settled`:
    /// skips these pairs, and ends after one that was measured. `keeps`: also finds a lower bound
    /// of the distance of both leaves. `keeps` only without `settled`.
    #[inline(never)]
    pub(crate) fn visit(
        &mut self,
        leaves: [&FanLeaf<'_>; 2],
        [first_at, second_at]: [TriangleAt; 2],
        settled: Option<SettledPairs>,
        question: &mut PairQuestion<'_>,
        keeps: bool,
        work: &mut Work,
    ) -> Option<GapVisit> {
        let [first, second] = leaves;
        let pair = LeafPair::new(self.pose, first, second);
        let error = self.pose.vertex_error;
        let margin =
            (error + error) + GAP_ALONG * U32 * greater(pair.a.max_norm(), pair.b.max_norm()) * 2.0;
        let limit_sq_of = |question: &PairQuestion<'_>| {
            let grown_limit = (up_to_f32(question.limit()) + margin) * GAP_SLACK;
            grown_limit * grown_limit * GAP_SLACK
        };
        let mut limit_sq = limit_sq_of(question);
        let mut seen = SeenPairs { pairs: 0, lower: f64::INFINITY, has_beyond: false };
        let visit = |direction, goes_on, seen: &SeenPairs| {
            let lower = if keeps { least_distance(&pair, direction, margin, seen)? } else { 0.0 };
            Some(GapVisit { goes_on, lower, pairs: seen.pairs, has_beyond: seen.has_beyond })
        };
        // With vectors, `pairs_along` costs no more than this test.
        if !WIDE && !may_be_near(self.direction, limit_sq, &pair) {
            return visit(self.direction, true, &seen);
        }
        let (first, second) = (&pair.a, &pair.b);
        let near = pairs_along(self.direction, limit_sq, first, second);
        if near == 0 {
            return visit(self.direction, true, &seen);
        }
        let near = near & !settled.map_or(0, |settled| settled.pairs);
        let mut keys = keys_of_triangles(first, second, limit_sq, near)?;
        // With `settled` the caller has counted the pairs: it visits the same leaves again.
        if settled.is_none() {
            let pairs = (pair.a.triangles * pair.b.triangles) as u32;
            work.triangles = work.triangles.saturating_add(pairs);
        }
        let mut last_between = None;
        let mut direction = self.direction;
        loop {
            let key = keys.least();
            if key > key_limit(limit_sq) {
                return visit(self.direction, true, &seen);
            }
            keys.drop(key);
            let [i, j] = indices_of(key);
            let place = [first_at.with_lane(i as usize), second_at.with_lane(j as usize)];
            let is_beyond = |last_between: &Option<IntPairDirection<'_>>| {
                let (Some(last_between), Some(settled)) = (last_between, settled) else {
                    return false;
                };
                last_between.is_beyond(settled.far, leaves, place) == Some(true)
            };
            // Neighbours often face the same triangle. Then the direction of the last pair proves
            // this pair far.
            let mut is_far = is_beyond(&last_between);
            let mut between = Vec3::ZERO;
            if !is_far {
                between = self.direction_between(&pair, place);
                last_between = settled.and_then(|_| IntPairDirection::of(self.pose, between));
                is_far = is_beyond(&last_between);
            }
            if is_far {
                (seen.pairs, seen.has_beyond) = (seen.pairs | pair_bit(key), true);
                continue;
            }
            let gap = self.measured(&pair, place, between);
            work.exact = work.exact.saturating_add(1);
            self.turn_to(&gap);
            seen = SeenPairs {
                pairs: seen.pairs | pair_bit(key),
                lower: lesser(seen.lower, gap.lower),
                ..seen
            };
            let goes_on = question.take(&gap);
            if !goes_on || settled.is_some() {
                return visit(self.direction, goes_on, &seen);
            }
            let along = (self.direction, limit_sq_of(question));
            if along != (direction, limit_sq) {
                (direction, limit_sq) = along;
                keys.keep(pairs_along(direction, limit_sq, first, second));
            }
        }
    }

    /// The distance of one pair.
    #[inline(never)]
    fn measured(
        &self,
        pair: &LeafPair<'_>,
        place: [TriangleAt; 2],
        direction: Vec3,
    ) -> TriangleGap {
        let [i, j] = place.map(TriangleAt::lane);
        let (first, second) = (pair.a.triangle(i), pair.b.triangle(j));
        let tops = [CornerFalls::of(&first, direction), CornerFalls::of(&second, -direction)];
        let [a, b] = pair.in_f64(i, j);
        let guesses = SLOPES_SQ.map(|slope_sq| tops.map(|tops| tops.corners(slope_sq)));
        let TriangleDistance { lower, mut upper, mut points } = triangle_distance(a, b, guesses);
        let rounding = self.pose.vertex_error_f64;
        let lower = greater(0.0, lower - (rounding + rounding));
        upper += rounding + rounding;
        let mut meets = false;
        if lower <= 0.0 {
            // With the surface error the proof is about the input. Without it the proof is about
            // the stored surfaces. The upper end is 0 here; `StoredLengths` adds the surface
            // errors.
            meets = meet(&a, &b, rounding + self.surface_error);
            if meets || meet(&a, &b, rounding) {
                upper = 0.0;
                points = crossing(a, b).map_or(points, |common| [common; 2]);
            }
        }
        let [unit, _] = self.pose.units.map(f64::from);
        let [x, y, z] = pair.first_vertex(i).map(|x| x * unit);
        let points = points.map(|[u, v, w]| [u + x, v + y, w + z]);
        TriangleGap { place, lower, upper, meets, points }
    }

    /// The direction between two triangles, as f32 tells.
    fn direction_between(&self, pair: &LeafPair<'_>, place: [TriangleAt; 2]) -> Vec3 {
        let [i, j] = place.map(TriangleAt::lane);
        let (a, b) = (pair.a.triangle(i), pair.b.triangle(j));
        let start = Vec3::from_array(self.direction);
        let [from, ..] = a;
        let [to, ..] = b;
        let start = if start == Vec3::ZERO { difference(to, from) } else { start };
        triangle_gap(&a, &b, start, GapLimits { far_sq: f32::INFINITY, near_sq: -1.0 }).direction
    }

    /// Keeps the offset of a measured pair, and the direction if the pair is not in contact.
    fn turn_to(&mut self, gap: &TriangleGap) {
        let [[a, b, c], [x, y, z]] = gap.points;
        let direction = [x - a, y - b, z - c];
        self.offset = direction;
        let longest = direction.iter().fold(0.0, |longest, x| greater(longest, x.abs()));
        if longest > 0.0 {
            self.direction = direction.map(|x| (x / longest) as f32);
        }
    }
}

/// Squares of slopes, for the first guess and the second. A corner counts as nearest if its edge to
/// the highest corner is no steeper. No proof rests on them.
const SLOPES_SQ: [f32; 2] = [1e-4, 1e-9];

/// How far the corners of a triangle are below the highest one along a direction.
#[derive(Clone, Copy)]
struct CornerFalls {
    /// Squared fall of each corner below the highest one, times `direction_sq`.
    fall_sq: [f32; 3],
    /// Squared length of the edge from each corner to the highest one.
    edge_sq: [f32; 3],
    /// Squared length of the direction.
    direction_sq: f32,
}

impl CornerFalls {
    #[inline(always)]
    fn of(triangle: &[Vec3; 3], direction: Vec3) -> CornerFalls {
        let heights = triangle.map(|corner| dot(corner, direction));
        let (mut top, mut most) = (Vec3::ZERO, f32::MIN);
        for (&corner, &height) in triangle.iter().zip(&heights) {
            if height > most {
                (top, most) = (corner, height);
            }
        }
        let square = |vector| dot(vector, vector);
        CornerFalls {
            fall_sq: heights.map(|height| (most - height) * (most - height)),
            edge_sq: triangle.map(|corner| square(difference(corner, top))),
            direction_sq: square(direction),
        }
    }

    /// A bit for each corner whose edge to the highest one is no steeper than the slope. The
    /// highest corner is always among them.
    #[inline(always)]
    fn corners(&self, slope_sq: f32) -> u32 {
        let ([p, q, r], [u, v, w]) = (self.fall_sq, self.edge_sq);
        let bit = |fall_sq, edge_sq| u32::from(fall_sq <= slope_sq * self.direction_sq * edge_sq);
        bit(p, u) | bit(q, v) << 1 | bit(r, w) << 2
    }
}

/// Whether it is proved that two triangles meet. Not inlined, so that it is compiled once.
#[inline(never)]
fn meet(a: &[[f64; 3]; 3], b: &[[f64; 3]; 3], doubt: f64) -> bool {
    triangles_meet(*a, *b, doubt) == Contact::Meets
}

/// What the visit showed of the pairs so far.
struct SeenPairs {
    /// A bit for each pair that was measured or proved far.
    pairs: u64,
    /// The least lower end of the measured pairs.
    lower: f64,
    /// Some pairs were proved far and not measured.
    has_beyond: bool,
}

/// A lower bound of the distance of both leaves: of measured pairs their lower ends, of the others
/// the larger of the gap of their boxes and the gap along the direction (§18). Common units.
fn least_distance(
    pair: &LeafPair<'_>,
    direction: [f32; 3],
    margin: f32,
    seen: &SeenPairs,
) -> Option<f64> {
    let (a, b) = (&pair.a, &pair.b);
    let (first, second) = (TriangleBoxes::of(a)?, TriangleBoxes::of(b)?);
    let (tops, lows) = (heights(a, direction).high, heights(b, direction).low);
    let [x, y, z] = direction;
    let direction_sq = x * x + y * y + z * z;
    let factor = if direction_sq < LEAST_GAP_SQ { 0.0 } else { SQUARED_SLACK / direction_sq };
    let columns = (1u32 << (b.triangles & 15)) - 1;
    let mut least = [f32::INFINITY; WIDTH];
    for (i, &top) in tops.iter().enumerate().take(a.triangles) {
        let bits = (!seen.pairs >> (i * WIDTH)) as u32 & columns;
        if bits == 0 {
            continue;
        }
        let sums = box_gaps_sq(&first, &second, i, bits);
        for (j, (least, (sum, low))) in least.iter_mut().zip(sums.iter().zip(lows)).enumerate() {
            if WIDE || bits >> j & 1 != 0 {
                let gap = greater(0.0, low - top);
                let bound = greater(*sum, gap * gap * factor);
                let bound = if bits & 1 << (j & 7) != 0 { bound } else { f32::INFINITY };
                *least = lesser(*least, bound);
            }
        }
    }
    let least = least.into_iter().fold(f32::INFINITY, lesser);
    if least == f32::INFINITY {
        return Some(seen.lower);
    }
    Some(lesser(seen.lower, greater(0.0, distance_of(key_of(least, 0)) - f64::from(margin))))
}
