//! A node's frame and the 8-bit boxes of its children, rounded outward in the *decoded* frame.
//!
//! The frame is a matrix of integers, a rotation that is shrunk so little that it makes no vector
//! longer. Boxes are computed in exactly the coordinates in which a reader compares them: nothing
//! is lost between fitting and decoding.
//!
//! Why containment is rigorous: entries of `M` are integers of at most 14 bits and coordinates
//! relative to the origin stay below 2^18, so for grid points every product and sum of `M·(P −
//! origin)` is an integer below 2^37, which f64 holds exactly; scaling by a power of two, `floor`
//! and `ceil` are exact as well. For fractional points, the difference, the products and the two
//! sums err by at most `4u / (1 − 4u) · Σ|M_kj (P − origin)_j|` with `u = 2^−53` (Higham, "Accuracy
//! and stability of numerical algorithms", section 3.1); the intervals are widened by twice that,
//! which also pays for rounding the bound and the widening.

use super::extent::{Extent, Frame, PointSet};
use glam::DVec3;
use meshsweep_core::internal::bvh::tree::format::layout::{MOST_EXPONENT, ROW_BITS};
use meshsweep_core::internal::num::exp2;
use std::ops::RangeInclusive;

/// Children of a node at most.
pub const LANES: usize = 8;
/// Least and greatest exponent of the step of an axis-aligned box.
const EXPONENTS: RangeInclusive<i32> = -20..=40;
/// The same of a frame: steps finer than the grid would gain nothing.
const FRAME_EXPONENTS: RangeInclusive<i32> = 0..=MOST_EXPONENT as i32;
/// Grid points per axis, less one.
const GRID_MAX: f64 = 65_535.0;
/// A node's frame and boxes, as the blob stores them.
///
/// A point `P` (grid units) has the box coordinates `q_k = (M_k·(P − origin)) · 2^(−13 −
/// exponent_k) + 128` for `k = 0..3`, and child `i` covers `low[k][i] <= q_k <= high[k][i]` for all
/// its points, in real arithmetic. Absent children have `low = 255` and `high = 0`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NodeBoxes {
    /// Grid point near the middle of the children.
    pub origin: [u16; 3],
    /// Rows of the matrix, in units of 2^-[`ROW_BITS`].
    pub matrix: [[i16; 3]; 3],
    /// Binary exponent of the box coordinates' unit, per axis: 0 to 9 in a shared frame, -20 to 40
    /// along the axes.
    pub exponent: [i8; 3],
    /// Lower ends of the boxes by axis and child.
    pub low: [[u8; LANES]; 3],
    /// Upper ends of the boxes by axis and child.
    pub high: [[u8; LANES]; 3],
}

impl NodeBoxes {
    /// Whether child `lane` covers `point`, decided in exact integer arithmetic.
    ///
    /// Exact for coordinates that are multiples of 2^−76; smaller bits count as an interval that
    /// must be covered whole, so `true` is always right. False for absent lanes and for
    /// coordinates beyond ±70,000, which no mesh has.
    #[cfg(test)]
    pub fn covers(&self, lane: usize, point: DVec3) -> bool {
        use super::extent::MAX_ABS_COORDINATE;
        const FRACTION_BITS: u32 = 76;
        if point.abs().max_element().is_nan() || point.abs().max_element() > MAX_ABS_COORDINATE {
            return false;
        }
        let scale = (1u128 << FRACTION_BITS) as f64;
        // Scaling by a power of two is exact, so `floor` and `ceil` enclose the coordinate; they
        // are equal unless bits fall off.
        let below = point.to_array().map(|c| (c * scale).floor() as i128);
        let above = point.to_array().map(|c| (c * scale).ceil() as i128);
        (0..3).all(|k| {
            let (mut least, mut greatest) = (0i128, 0i128);
            for j in 0..3 {
                let entry = i128::from(self.matrix[k][j]);
                let origin = i128::from(self.origin[j]) << FRACTION_BITS;
                let (a, b) = (entry * (below[j] - origin), entry * (above[j] - origin));
                least += a.min(b);
                greatest += a.max(b);
            }
            let shift = (FRACTION_BITS + ROW_BITS).wrapping_add_signed(i32::from(self.exponent[k]));
            let end = |stored: u8| (i128::from(stored) - 128) << shift;
            end(self.low[k][lane]) <= least && greatest <= end(self.high[k][lane])
        })
    }
}

/// Boxes of up to eight children in the frame of `matrix`; children without points become absent
/// lanes.
///
/// Coordinates are grid units within ±70,000. The exponents are the least that fit,
/// so the node spans 128 to 255 units per axis unless it is flat there. Cost: two extents of each
/// child. Panics on more than eight children.
pub(super) fn quantise(matrix: [[i16; 3]; 3], children: &[impl PointSet]) -> NodeBoxes {
    fit(matrix, children, FRAME_EXPONENTS)
}

fn fit(
    matrix: [[i16; 3]; 3],
    children: &[impl PointSet],
    exponents: RangeInclusive<i32>,
) -> NodeBoxes {
    assert!(children.len() <= LANES, "a node has at most {LANES} children");
    let mut boxes = NodeBoxes {
        origin: [0; 3],
        matrix,
        exponent: [0; 3],
        low: [[255; LANES]; 3],
        high: [[0; LANES]; 3],
    };
    let matrix = matrix.map(|row| DVec3::from_array(row.map(f64::from)));
    let mut extents = [Extent::EMPTY; LANES];
    let mut origin = children.iter().find_map(PointSet::first).unwrap_or(DVec3::ZERO);
    // The first pass only finds the middle.
    for pass in 0..2 {
        origin = origin.round().clamp(DVec3::ZERO, DVec3::splat(GRID_MAX));
        for (extent, points) in extents.iter_mut().zip(children) {
            *extent = points.extent(&Frame { matrix, origin });
        }
        if pass == 0 {
            let all = extents.iter().fold(Extent::EMPTY, Extent::union);
            for k in (0..3).filter(|&k| all.low[k] <= all.high[k]) {
                let square = exp2(2 * ROW_BITS.cast_signed());
                origin += matrix[k] * ((all.low[k] + all.high[k]) * 0.5 / square);
            }
        }
    }
    boxes.origin = origin.to_array().map(|c| c as u16);
    let all = extents.iter().fold(Extent::EMPTY, Extent::union);
    for k in 0..3 {
        let exponent = least_exponent(all.low[k], all.high[k], exponents.clone());
        boxes.exponent[k] = exponent as i8;
        let per_unit = exp2(-exponent - ROW_BITS.cast_signed());
        for (lane, extent) in
            extents.iter().enumerate().filter(|(_, extent)| extent.low[k] <= extent.high[k])
        {
            // In 0..=255 by the choice of the exponent.
            boxes.low[k][lane] = ((extent.low[k] * per_unit).floor() + 128.0) as u8;
            boxes.high[k][lane] = ((extent.high[k] * per_unit).ceil() + 128.0) as u8;
        }
    }
    boxes
}

/// Node whose boxes are aligned with the grid's axes: `M` is the identity.
///
/// The same contract and cost as for rotated frames; children without points become absent lanes.
pub(super) fn axis_aligned(children: &[impl PointSet]) -> NodeBoxes {
    fit(IDENTITY, children, EXPONENTS)
}

/// The matrix of boxes along the axes.
pub(super) const IDENTITY: [[i16; 3]; 3] = {
    let one = 1 << ROW_BITS;
    [[one, 0, 0], [0, one, 0], [0, 0, one]]
};

/// Least exponent in whose unit `low..=high`, rounded outward, fits in `-128..=127`.
fn least_exponent(low: f64, high: f64, mut exponents: RangeInclusive<i32>) -> i32 {
    exponents
        .find(|&exponent| {
            let per_unit = exp2(-exponent - ROW_BITS.cast_signed());
            (low * per_unit).floor() >= -128.0 && (high * per_unit).ceil() <= 127.0
        })
        .expect("255 steps of the greatest exponent span every model")
}

#[cfg(test)]
pub(super) mod tests {
    use super::super::rotation::stored_rotation;
    use super::*;
    use crate::random::SplitMix;

    pub(in super::super) fn assert_covers_all(boxes: &NodeBoxes, children: &[&[DVec3]]) {
        for (lane, points) in children.iter().enumerate() {
            for &point in *points {
                assert!(boxes.covers(lane, point), "lane {lane} misses {point} in {boxes:?}");
            }
        }
        for lane in children.len()..LANES {
            assert!((0..3).all(|k| boxes.low[k][lane] == 255 && boxes.high[k][lane] == 0));
        }
    }

    fn slices(children: &[Vec<DVec3>]) -> Vec<&[DVec3]> {
        children.iter().map(Vec::as_slice).collect()
    }

    const SKEW: [i8; 4] = [93, -127, 41, 7];

    #[test]
    fn grid_points_are_covered() {
        let mut noise = SplitMix::new(1);
        for size in [2.0, 30.0, 900.0, 65_535.0] {
            let children: Vec<Vec<DVec3>> = (0..7)
                .map(|_| {
                    (0..20)
                        .map(|_| noise.point(DVec3::splat(32_767.5), DVec3::splat(size)).round())
                        .collect()
                })
                .collect();
            for quaternion in [[127, 0, 0, 0], SKEW, [127; 4], [0, 0, -127, 1]] {
                assert_covers_all(
                    &quantise(stored_rotation(quaternion), &slices(&children)),
                    &slices(&children),
                );
            }
        }
    }

    #[test]
    fn fractional_points_are_covered() {
        let mut noise = SplitMix::new(2);
        for size in [1e-9, 1e-3, 1.0, 65_535.0] {
            let children: Vec<Vec<DVec3>> = (0..8)
                .map(|_| (0..20).map(|_| noise.point(DVec3::ZERO, DVec3::splat(size))).collect())
                .collect();
            for quaternion in [[127, 0, 0, 0], SKEW, [127, 127, -127, 0]] {
                assert_covers_all(
                    &quantise(stored_rotation(quaternion), &slices(&children)),
                    &slices(&children),
                );
            }
        }
    }

    #[test]
    fn flat_collinear_and_single_points_are_covered() {
        let mut noise = SplitMix::new(3);
        let centre = DVec3::new(40_000.0, 3.0, 65_535.0);
        for size in [DVec3::new(900.0, 900.0, 0.0), DVec3::new(0.0, 0.0, 77.0), DVec3::ZERO] {
            for fraction in [0.0, 0.37] {
                let children: Vec<Vec<DVec3>> = (0..8)
                    .map(|_| (0..5).map(|_| noise.point(centre, size).round() + fraction).collect())
                    .collect();
                for quaternion in [[127, 0, 0, 0], SKEW] {
                    assert_covers_all(
                        &quantise(stored_rotation(quaternion), &slices(&children)),
                        &slices(&children),
                    );
                }
            }
        }
    }

    #[test]
    fn extreme_corners_fit_the_exponents() {
        let corners = [DVec3::ZERO, DVec3::splat(GRID_MAX)];
        for quaternion in [[127, 0, 0, 0], [127; 4], SKEW, [-127, 127, 127, -127]] {
            assert_covers_all(&quantise(stored_rotation(quaternion), &[&corners[..]]), &[&corners]);
        }
    }

    #[test]
    fn boxes_span_half_of_the_range_or_more() {
        let mut noise = SplitMix::new(4);
        let points: Vec<DVec3> = (0..200)
            .map(|_| noise.point(DVec3::splat(30_000.0), DVec3::splat(5000.0)).round())
            .collect();
        let boxes = quantise(stored_rotation(SKEW), &[&points[..]]);
        for k in 0..3 {
            assert!(boxes.high[k][0] - boxes.low[k][0] >= 126, "{boxes:?}");
        }
    }

    #[test]
    fn covers_is_false_one_step_outside() {
        let corners = [DVec3::splat(10.0), DVec3::splat(20.0)];
        let boxes = axis_aligned(&[&corners[..]]);
        assert!(boxes.covers(0, DVec3::new(10.0, 20.0, 15.0)));
        assert!(!boxes.covers(0, DVec3::new(10.0f64.next_down(), 20.0, 15.0)));
        assert!(!boxes.covers(0, DVec3::new(10.0, 20.0f64.next_up(), 15.0)));
        assert!(!boxes.covers(1, DVec3::new(15.0, 15.0, 15.0)));
        assert!(!boxes.covers(0, DVec3::NAN));
    }

    #[test]
    fn children_without_points_are_absent() {
        let boxes = axis_aligned(&[&[][..], &[DVec3::ONE]]);
        assert!((0..3).all(|k| boxes.low[k][0] == 255 && boxes.high[k][0] == 0));
        assert!(boxes.covers(1, DVec3::ONE));
        let nothing = axis_aligned(&[&[][..]; 0]);
        assert!((0..LANES).all(|lane| !nothing.covers(lane, DVec3::ZERO)));
    }
}
