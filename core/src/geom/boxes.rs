//! Axis-aligned box, and a segment clipped to it.

use crate::num::tolerance::{BOX_MISSED, U32, U64, UNDERFLOW};
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

    /// Whether a segment certainly misses the box, in f32. Then [`clip`](Self::clip) finds so, too,
    /// of a segment whose ends are these. Coordinates are at most 2^12. Derivation:
    /// `core/docs/rounding.md` §3.
    pub fn is_missed(&self, start: Vec3, end: Vec3) -> bool {
        let sizes = (self.min.abs() + self.max.abs()) + (start.abs() + end.abs());
        let margin = BOX_MISSED * U32 * (sizes.x + sizes.y + sizes.z);
        let (centre, half) = ((self.min + self.max) * 0.5, (self.max - self.min) * 0.5 + margin);
        let (from, to, d) = (start - centre, end - centre, end - start);
        let is_beside = |from: f32, to: f32, half: f32| {
            (from > half && to > half) || (from < -half && to < -half)
        };
        // Seen along an axis: the line of the segment is apart from the box.
        let is_apart =
            |[from_x, from_y]: [f32; 2], [x, y]: [f32; 2], [half_x, half_y]: [f32; 2]| {
                (x * from_y - y * from_x).abs() > half_x * y.abs() + half_y * x.abs() + UNDERFLOW
            };
        is_beside(from.x, to.x, half.x)
            || is_beside(from.y, to.y, half.y)
            || is_beside(from.z, to.z, half.z)
            || is_apart([from.x, from.y], [d.x, d.y], [half.x, half.y])
            || is_apart([from.y, from.z], [d.y, d.z], [half.y, half.z])
            || is_apart([from.z, from.x], [d.z, d.x], [half.z, half.x])
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
            let (from, to, step, lo, hi) = match axis {
                0 => (a.x, b.x, d.x, self.min.x, self.max.x),
                1 => (a.y, b.y, d.y, self.min.y, self.max.y),
                _ => (a.z, b.z, d.z, self.min.z, self.max.z),
            };
            let (lo, hi) = (f64::from(lo) - doubt, f64::from(hi) + doubt);
            if step == 0.0 {
                if from < lo || from > hi {
                    return None;
                }
                continue;
            }
            let rises = step > 0.0;
            // An end between the planes cuts nothing off. Boards spare two quotients in f64.
            if if rises { from < lo } else { from > hi } {
                let near = (if rises { lo } else { hi } - from) / step;
                t_start = t_start.max(near - 8.0 * U64 * near.abs());
            }
            if if rises { to > hi } else { to < lo } {
                let far = (if rises { hi } else { lo } - from) / step;
                t_end = t_end.min(far + 8.0 * U64 * far.abs());
            }
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
    use crate::num::noise::Noise;

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
    fn what_is_missed_in_f32_is_missed_by_clipping_and_little_else_is() {
        let mut noise = Noise(11);
        let mut random = || noise.unit();
        let (mut missed, mut clipped) = (0, 0);
        for round in 0..300_000 {
            let size = [2.0, 1.0, 40.0, 3000.0][round % 4];
            let length = [1.0, 1e-3, 1e-7, 1e-20][round / 4 % 4];
            let mut vector = || Vec3::new(random(), random(), random());
            let start = vector() * size;
            // Toward the box, along its edges, or anywhere.
            let end = match round / 16 % 3 {
                0 => vector() * 2.0,
                1 => start + vector() * size * length,
                _ => Vec3::new(start.x, vector().y * 2.0, 1.0),
            };
            let corner = vector() * 0.5;
            let bounds = Aabb { min: corner, max: corner + vector().abs() * 0.5 };
            let is_clipped = bounds.clip(start.as_dvec3(), end.as_dvec3()).is_none();
            let is_missed = bounds.is_missed(start, end);
            assert!(!is_missed || is_clipped, "{bounds:?} {start} {end}");
            missed += u32::from(is_missed);
            clipped += u32::from(is_clipped);
        }
        assert!(missed > clipped / 100 * 99, "{missed} {clipped}");
    }

    #[test]
    fn distance_range_brackets_corners() {
        let (lower, upper) = UNIT.distance_range(DVec3::new(4.0, 0.5, 5.0));
        assert!(lower <= 5.0 && lower > 4.999_999);
        assert!(upper >= libm::sqrt(16.0 + 0.25 + 25.0));
    }
}
