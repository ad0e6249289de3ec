//! Axis-aligned box, and a segment clipped to it.

use crate::num::tolerance::U64;
use glam::{DVec3, Vec3};

/// Axis-aligned box, `min ≤ max` on every axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// Least corner.
    pub min: Vec3,
    /// Greatest corner.
    pub max: Vec3,
}

/// The part of a segment that may lie in a box.
#[derive(Clone, Copy, Debug)]
pub struct Clipped {
    /// Parameter at which the part begins, up to `16·2^-53·magnitude`.
    pub start: DVec3,
    /// Parameter at which it ends, up to the same.
    pub end: DVec3,
    /// Parameter of `start` on the whole segment, never above the true one.
    pub t_start: f64,
    /// Parameter of `end`, never below the true one.
    pub t_end: f64,
    /// Sum of the absolute coordinates of both ends of the whole segment.
    pub magnitude: f64,
}

impl Aabb {
    /// The box between a least and a greatest corner.
    pub fn of([min, max]: [[f32; 3]; 2]) -> Aabb {
        Aabb { min: Vec3::from_array(min), max: Vec3::from_array(max) }
    }

    /// Least and greatest corner.
    pub fn corners(&self) -> [[f32; 3]; 2] {
        [self.min, self.max].map(|corner| corner.to_array())
    }

    /// Distance bounds `(lower, upper)` from `p` to anything inside, in f64 with rounding taken
    /// into account.
    pub fn distance_range(&self, p: DVec3) -> (f64, f64) {
        let (lo, hi) = (self.min.as_dvec3(), self.max.as_dvec3());
        let gap = (lo - p).max(p - hi).max(DVec3::ZERO);
        let far = (p - lo).abs().max((hi - p).abs());
        (libm::sqrt(gap.dot(gap)) * (1.0 - 8.0 * U64), libm::sqrt(far.dot(far)) * (1.0 + 8.0 * U64))
    }

    /// The part of the segment `a b` that may meet the box, by slabs, rounded outward; `None` if it
    /// certainly misses.
    pub fn clip(&self, a: DVec3, b: DVec3) -> Option<Clipped> {
        let d = b - a;
        let size = a.abs() + b.abs();
        let magnitude = size.x + size.y + size.z;
        let doubt = 16.0 * U64 * magnitude;
        let (mut t_start, mut t_end) = (0f64, 1f64);
        for axis in 0..3 {
            let (from, step, lo, hi) = match axis {
                0 => (a.x, d.x, self.min.x, self.max.x),
                1 => (a.y, d.y, self.min.y, self.max.y),
                _ => (a.z, d.z, self.min.z, self.max.z),
            };
            let (lo, hi) = (f64::from(lo) - doubt, f64::from(hi) + doubt);
            if step == 0.0 {
                if from < lo || from > hi {
                    return None;
                }
                continue;
            }
            let (t0, t1) = ((lo - from) / step, (hi - from) / step);
            let (near, far) = if t0 <= t1 { (t0, t1) } else { (t1, t0) };
            t_start = t_start.max(near - 8.0 * U64 * near.abs());
            t_end = t_end.min(far + 8.0 * U64 * far.abs());
        }
        if t_start > t_end {
            return None;
        }
        let start = if t_start == 0.0 { a } else { a + d * t_start };
        let end = if t_end == 1.0 { b } else { a + d * t_end };
        Some(Clipped { start, end, t_start, t_end, magnitude })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const UNIT: Aabb = Aabb { min: Vec3::ZERO, max: Vec3::ONE };

    #[test]
    fn clip_keeps_exactly_what_is_inside() {
        let c = UNIT.clip(DVec3::new(-1.0, 0.5, 0.5), DVec3::new(3.0, 0.5, 0.5)).expect("crosses");
        assert!((c.t_start - 0.25).abs() < 1e-14 && (c.t_end - 0.5).abs() < 1e-14);
        assert!(UNIT.clip(DVec3::new(-1.0, 2.0, 0.5), DVec3::new(3.0, 2.0, 0.5)).is_none());
        assert!(UNIT.clip(DVec3::new(-1.0, 0.5, 0.5), DVec3::new(-0.5, 0.5, 0.5)).is_none());
    }

    #[test]
    fn clip_keeps_a_segment_that_grazes_a_face() {
        assert!(UNIT.clip(DVec3::new(-1.0, 1.0, 0.5), DVec3::new(3.0, 1.0, 0.5)).is_some());
        assert!(UNIT.clip(DVec3::new(0.5, 0.5, 0.5), DVec3::new(0.5, 0.5, 0.5)).is_some());
    }

    #[test]
    fn distance_range_brackets_corners() {
        let (lower, upper) = UNIT.distance_range(DVec3::new(4.0, 0.5, 5.0));
        assert!(lower <= 5.0 && lower > 4.999_999);
        assert!(upper >= libm::sqrt(16.0 + 0.25 + 25.0));
    }
}
