//! Disks about the contents of a node's entries, for the static tree: a piece of a surface is thin
//! along its normal, however it lies in its box. A plane next to the surface misses its disk long
//! before it misses its box.

use super::lane_corners::Cut;
use super::order::WIDTH;
use glam::DVec3;
use wide::f32x8;

/// By lane a disk about the middle of the lane's box, in the tree's frame: the points with a
/// distance of at most `radius` from a line through the middle along `axis`, and a height of
/// `level` ± `half` along it.
#[derive(Clone, Debug)]
pub(super) struct Disks {
    axis: [[f32; WIDTH]; 3],
    level: [f32; WIDTH],
    half: [f32; WIDTH],
    radius: [f32; WIDTH],
}

/// What disks are larger by, in both directions, so that no rounding takes a point out of one.
///
/// A bound is a sum of five products of numbers below 2. Fewer than sixteen roundings of 2^-23 add
/// up to less than 2e-6. The normal and the product of normal and axis are off by less than 3e-7,
/// and the axis is a unit vector to 3e-7, times heights below 2. All is less than this. It counts
/// in full in each direction, because the sum of a sine and a cosine is at least 1.
const PAD: f64 = 4e-6;

/// More than rounding of the square of a cosine, which is off by less than 1.5e-6.
const SQUARED: f32 = 2e-6;

/// A disk of this radius holds everything.
const EVERYTHING: f32 = 8.0;

impl Default for Disks {
    fn default() -> Self {
        Self {
            axis: [[0.0; WIDTH]; 3],
            level: [0.0; WIDTH],
            half: [0.0; WIDTH],
            radius: [EVERYTHING; WIDTH],
        }
    }
}

impl Disks {
    /// Puts the disk about points into a lane. `middle` is that of the lane's box, and `normal` any
    /// direction: best that in which the points are thin.
    pub fn set(&mut self, lane: usize, middle: DVec3, normal: DVec3, points: &[DVec3]) {
        let axis = normal.try_normalize().unwrap_or(DVec3::Z).as_vec3();
        let along = axis.as_dvec3();
        let (mut low, mut high, mut radius_sq) = (f64::INFINITY, f64::NEG_INFINITY, 0.0f64);
        for &p in points {
            let from = p - middle;
            let height = from.dot(along);
            (low, high) = (low.min(height), high.max(height));
            radius_sq = radius_sq.max((from - along * height).length_squared());
        }
        for (of, x) in self.axis.iter_mut().zip(axis.to_array()) {
            of[lane] = x;
        }
        self.level[lane] = (0.5 * (low + high)) as f32;
        self.half[lane] = (0.5 * (high - low) + PAD) as f32;
        self.radius[lane] = (radius_sq.sqrt() + PAD) as f32;
    }

    /// For each lane the most that `cut.normal · p` may be on its disk, where it is `at_middle` in
    /// the middle of its box.
    #[inline]
    pub fn reach(&self, cut: &Cut, at_middle: f32x8) -> f32x8 {
        let [x, y, z] = cut.normal.map(f32x8::splat);
        let axis = self.axis.map(f32x8::from);
        let cosine = x * axis[0] + y * axis[1] + z * axis[2];
        let sine = (f32x8::splat(1.0 + SQUARED) - cosine * cosine).sqrt();
        at_middle
            + cosine * f32x8::from(self.level)
            + cosine.abs() * f32x8::from(self.half)
            + sine * f32x8::from(self.radius)
    }
}
