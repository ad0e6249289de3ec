//! Choice of the rotation that a node's children share.
//!
//! The cost of a frame is the expected number of children that a distance query opens. By
//! Steiner's formula a box with extents `a, b, c` grown by `d` on all sides has the volume
//! `abc + 2(ab + bc + ca) d + π(a + b + c) d² + …`, summed over the children. The candidates are
//! the principal axes of all points and of each child, the best of them turned about the axis of
//! least spread; the best is refined by shrinking quasi-random steps. Every candidate is judged
//! after rounding to the stored quaternion.

use super::boxes::LANES;
use super::rotation::{frame_axes, principal_frame, round_quaternion, unit_quaternion};
use arrayvec::ArrayVec;
use glam::{DQuat, DVec3};

/// Distance by which boxes are grown for the cost, relative to the mean diagonal of the node's
/// children. Small values favour small volume (thin boxes along the surface), large ones small
/// extents.
const DILATION: f64 = 0.05;

/// Refinement steps after the candidates. Twice as many take a tenth of a build's time and save a
/// thousandth of the visits.
const REFINEMENTS: u32 = 32;

/// Frames that are turned about their axis of least spread, the best as they are. With all of them
/// a build takes a tenth more time, and visits are the same.
const TURNED: usize = 3;

/// Sets of more points are reduced to extreme points for the search.
pub(super) const SEARCH_POINTS: usize = 48;

/// Points of all children, transposed: entry `s` holds the `s`-th point of each child, so that one
/// pass fits all boxes at once. Shorter children repeat their last point. Lanes without points hold
/// the origin, which is a point of the set, so the span does not change.
struct ChildPoints {
    points_by_rank: Vec<[[f32; LANES]; 3]>,
    child_count: usize,
    dilation: f32,
}

impl ChildPoints {
    fn new(children: &[&[DVec3]]) -> Self {
        let origin =
            children.iter().find_map(|points| points.first()).copied().unwrap_or(DVec3::ZERO);
        let count = children.iter().map(|points| points.len()).max().unwrap_or(0);
        let mut points_by_rank = vec![[[0.0; LANES]; 3]; count];
        let mut diagonals = 0.0;
        for (lane, points) in children.iter().enumerate().filter(|(_, points)| !points.is_empty()) {
            for (rank, entry) in points_by_rank.iter_mut().enumerate() {
                let relative = (points[rank.min(points.len() - 1)] - origin).as_vec3();
                (0..3).for_each(|k| entry[k][lane] = relative[k]);
            }
            let low = points.iter().copied().reduce(DVec3::min).unwrap_or(origin);
            let high = points.iter().copied().reduce(DVec3::max).unwrap_or(origin);
            diagonals += (high - low).length();
        }
        let dilation = (DILATION * diagonals / children.len().max(1) as f64) as f32;
        Self { points_by_rank, child_count: children.len(), dilation }
    }

    /// Summed Steiner volume of the children's boxes in the frame of a stored quaternion, rounding
    /// to 8 bits included.
    fn cost(&self, quaternion: [i8; 4]) -> f32 {
        let axes = frame_axes(unit_quaternion(quaternion));
        let mut low = [[f32::INFINITY; LANES]; 3];
        let mut high = [[f32::NEG_INFINITY; LANES]; 3];
        for [x, y, z] in &self.points_by_rank {
            for k in 0..3 {
                let axis = axes[k];
                for i in 0..LANES {
                    let q = axis.x * x[i] + axis.y * y[i] + axis.z * z[i];
                    low[k][i] = if q < low[k][i] { q } else { low[k][i] };
                    high[k][i] = if q > high[k][i] { q } else { high[k][i] };
                }
            }
        }
        let rounding = [0, 1, 2].map(|k| {
            let least = low[k].iter().copied().fold(f32::INFINITY, f32::min);
            let greatest = high[k].iter().copied().fold(f32::NEG_INFINITY, f32::max);
            expected_rounding(greatest - least)
        });
        let d = self.dilation;
        let mut sum = 0.0;
        for i in 0..self.child_count {
            let [a, b, c] = [0, 1, 2].map(|k| high[k][i] - low[k][i] + rounding[k]);
            sum += a * b * c
                + 2.0 * d * (a * b + b * c + c * a)
                + std::f32::consts::PI * d * d * (a + b + c);
        }
        sum
    }
}

/// Mean growth of a box by rounding outward, both ends together: one unit of the exponent that a
/// node of this span gets.
fn expected_rounding(span: f32) -> f32 {
    /// Of the 255 units, half a unit at each end goes to rounding.
    const UNITS: f32 = 254.0;
    let unit = span / UNITS;
    // Next power of two: the sign and mantissa bits cut off, the exponent raised unless the
    // mantissa was zero.
    let floor = f32::from_bits(unit.to_bits() & 0xff80_0000);
    if floor < unit { floor * 2.0 } else { floor }
}

/// Best candidate so far.
struct Search<'a> {
    points: &'a ChildPoints,
    best_quaternion: [i8; 4],
    best_cost: f32,
}

impl Search<'_> {
    /// Takes a candidate if it is the best; its cost.
    fn consider(&mut self, candidate: DQuat) -> f32 {
        let rounded = round_quaternion(candidate);
        if rounded == self.best_quaternion {
            return self.best_cost;
        }
        let cost = self.points.cost(rounded);
        if cost < self.best_cost {
            self.best_cost = cost;
            self.best_quaternion = rounded;
        }
        cost
    }
}

/// Quaternion of the best frame found for the points of up to eight children, grid units within
/// ±70,000. Where no rotation helps (equal points, axis-aligned input), it is the identity, `(127,
/// 0, 0, 0)`. Cost: proportional to the greatest number of points of a child.
pub(super) fn best_quaternion(children: &[&[DVec3]]) -> [i8; 4] {
    refined(children, REFINEMENTS)
}

fn refined(children: &[&[DVec3]], refinements: u32) -> [i8; 4] {
    /// Tangents of half of 22.5°, 45° and 67.5°: turns about the third axis. A box repeats after
    /// 90°.
    const HALF_TURN_TANGENTS: [f64; 3] =
        [0.198_912_367_379_658, 0.414_213_562_373_095_1, 0.668_178_637_919_298_9];
    let points = ChildPoints::new(children);
    let identity = round_quaternion(DQuat::IDENTITY);
    let mut search =
        Search { best_cost: points.cost(identity), points: &points, best_quaternion: identity };
    if points.points_by_rank.is_empty() || search.best_cost <= 0.0 {
        return identity;
    }
    let all = principal_frame(children.iter().flat_map(|points| points.iter().copied()));
    let each = children.iter().filter_map(|points| principal_frame(points.iter().copied()));
    let mut frames: ArrayVec<(f32, DQuat), { LANES + 1 }> =
        all.into_iter().chain(each).map(|frame| (search.consider(frame), frame)).collect();
    frames.sort_by(|a, b| a.0.total_cmp(&b.0));
    for (_, frame) in frames.into_iter().take(TURNED) {
        for tangent in HALF_TURN_TANGENTS {
            search.consider((DQuat::from_xyzw(0.0, 0.0, tangent, 1.0) * frame).normalize());
        }
    }
    refine(&mut search, refinements);
    search.best_quaternion
}

/// Local search: steps fill a shrinking ball of rotations around the best frame, in a
/// low-discrepancy order.
fn refine(search: &mut Search, steps: u32) {
    /// First step: tangent of half of about 17°, a little less than the candidates' spacing.
    const FIRST_STEP: f64 = 0.15;
    /// Last step: about one unit of the stored quaternion.
    const LAST_STEP: f64 = 0.006;
    /// Generator of the R3 sequence, powers of the inverse of the root of x^4 = x + 1 (Roberts,
    /// 2018).
    const R3: DVec3 =
        DVec3::new(0.819_172_513_396_164_4, 0.671_043_606_703_789_3, 0.549_700_477_901_970_5);
    let mut position = DVec3::splat(0.5);
    for step in 0..steps {
        position = (position + R3).fract();
        let progress = f64::from(step) / f64::from(steps);
        // Between linear and geometric shrinking, without `pow`.
        let remaining = (1.0 - progress) * (1.0 - progress);
        let size = LAST_STEP + (FIRST_STEP - LAST_STEP) * remaining;
        let turn = (position * 2.0 - 1.0) * size;
        let best = unit_quaternion(search.best_quaternion);
        search.consider((DQuat::from_xyzw(turn.x, turn.y, turn.z, 1.0) * best).normalize());
    }
}

#[cfg(test)]
mod tests {
    use super::super::boxes::tests::assert_covers_all;
    use super::super::boxes::{IDENTITY, NodeBoxes, axis_aligned, quantise};
    use super::super::extremes::extreme_points;
    use super::super::rotation::stored_rotation;
    use super::*;
    use crate::random::SplitMix;
    use meshsweep_core::internal::bvh::tree::format::layout::lengthens_nothing;

    /// Four flat leaves side by side in a plane that is slanted against all axes.
    fn slanted_leaves(fraction: f64) -> Vec<Vec<DVec3>> {
        let turn = DQuat::from_xyzw(0.31, -0.22, 0.17, 0.9).normalize();
        let mut noise = SplitMix::new(6);
        let mut leaf = |i: i32| {
            let centre = DVec3::new(f64::from(i % 2) * 900.0, f64::from(i / 2) * 700.0, 0.0);
            (0..60)
                .map(|_| turn * noise.point(centre, DVec3::new(800.0, 600.0, 8.0)) + 30_000.0)
                .map(|p| if fraction == 0.0 { p.round() } else { p * fraction })
                .collect()
        };
        (0..4).map(&mut leaf).collect()
    }

    /// Summed volume of the boxes, grid units.
    fn volume(boxes: &NodeBoxes, count: usize) -> f64 {
        let unit = |k: usize| 2f64.powi(i32::from(boxes.exponent[k]));
        (0..count)
            .map(|i| {
                (0..3)
                    .map(|k| f64::from(boxes.high[k][i] - boxes.low[k][i]) * unit(k))
                    .product::<f64>()
            })
            .sum()
    }

    #[test]
    fn slanted_leaves_get_thin_boxes() {
        let leaves = slanted_leaves(0.0);
        let children: Vec<&[DVec3]> = leaves.iter().map(Vec::as_slice).collect();
        let boxes = shared_frame(&children);
        assert_covers_all(&boxes, &children);
        assert!(volume(&boxes, 4) < 4.0 * 800.0 * 600.0 * 24.0, "{}", volume(&boxes, 4));
        assert!(volume(&boxes, 4) < 0.1 * volume(&axis_aligned(&children), 4));
    }

    #[test]
    fn fractional_points_are_covered() {
        let leaves = slanted_leaves(0.613);
        let children: Vec<&[DVec3]> = leaves.iter().map(Vec::as_slice).collect();
        assert_covers_all(&shared_frame(&children), &children);
    }

    #[test]
    fn flat_and_collinear_children_are_covered() {
        let mut noise = SplitMix::new(7);
        for size in [DVec3::new(500.0, 300.0, 0.0), DVec3::new(0.0, 400.0, 0.0), DVec3::ZERO] {
            let leaves: Vec<Vec<DVec3>> = (0..8)
                .map(|_| (0..6).map(|_| noise.point(DVec3::splat(9000.0), size).round()).collect())
                .collect();
            let children: Vec<&[DVec3]> = leaves.iter().map(Vec::as_slice).collect();
            assert_covers_all(&shared_frame(&children), &children);
        }
    }

    #[test]
    fn equal_points_get_the_identity() {
        let boxes = shared_frame(&[&[DVec3::ONE; 3], &[DVec3::ONE]]);
        assert_eq!(boxes.matrix, IDENTITY);
        assert_covers_all(&boxes, &[&[DVec3::ONE], &[DVec3::ONE]]);
    }

    /// The boxes of children in the best frame of their extreme points.
    fn shared_frame(children: &[&[DVec3]]) -> NodeBoxes {
        let reduced: Vec<Vec<DVec3>> =
            children.iter().map(|points| extreme_points(points, SEARCH_POINTS)).collect();
        let search: Vec<&[DVec3]> = reduced.iter().map(Vec::as_slice).collect();
        quantise(stored_rotation(best_quaternion(&search)), children)
    }

    #[test]
    fn stored_frames_lengthen_no_vector() {
        let leaves = slanted_leaves(0.0);
        for count in 1..=4 {
            let children: Vec<&[DVec3]> = leaves[..count].iter().map(Vec::as_slice).collect();
            let boxes = shared_frame(&children);
            assert!(lengthens_nothing(&boxes.matrix));
        }
    }

    #[test]
    fn more_refinements_never_cost_more() {
        let leaves = slanted_leaves(0.0);
        let children: Vec<&[DVec3]> = leaves.iter().map(Vec::as_slice).collect();
        let cost = |refinements| ChildPoints::new(&children).cost(refined(&children, refinements));
        assert!(cost(64) <= cost(0));
    }

    #[test]
    fn rounding_is_the_next_power_of_two() {
        assert_eq!(expected_rounding(0.0), 0.0);
        assert_eq!(expected_rounding(254.0), 1.0);
        assert_eq!(expected_rounding(255.0), 2.0);
        assert_eq!(expected_rounding(509.0), 4.0);
        assert_eq!(expected_rounding(127.0), 0.5);
    }
}
