//! Point–segment distance: in f64 as an interval that contains the real one, in f32 as a lower
//! bound of the distance to a capsule (Guéziec 2000, 3.1).
//!
//! Both compute the length of the residual `ap − t·ab`. A wrong `t` moves the point along the
//! segment, so that its error is added. Derivation: `core/docs/rounding.md` §14.

use super::boxes::Aabb;
use crate::num::sqrt_approx;
use crate::num::tolerance::{CAPSULE_UNDERFLOW, SEGMENT_DISTANCE, TRUSTED_DIRECTION_SQ, U32, U64};
use glam::{DVec3, Vec3};

/// Distance of a point and a segment: `lower ≤ distance ≤ upper` in real arithmetic.
#[derive(Clone, Copy, Debug)]
pub struct PointSegment {
    /// Not above the distance.
    pub lower: f64,
    /// Not below the distance.
    pub upper: f64,
    /// Squared length of the residual as computed. It decides ties.
    pub distance_sq: f64,
    /// The closest point is `a + t·(b − a)`, `0 ≤ t ≤ 1`.
    pub t: f64,
}

/// Distance interval of `p` and the segment `a b`.
///
/// A segment without length is its point. Segments that share the closest point as an end have the
/// same bits. Coordinates must be finite and below 1e75, so that no product overflows.
#[inline]
pub fn point_segment(p: DVec3, a: DVec3, b: DVec3) -> PointSegment {
    let (ap, ab) = (p - a, b - a);
    let (along, length_sq) = (ap.dot(ab), ab.dot(ab));
    let t = if along > 0.0 { (along / length_sq).min(1.0) } else { 0.0 };
    let residual = match t {
        0.0 => ap,
        1.0 => p - b,
        t => ap - ab * t,
    };
    let distance_sq = residual.dot(residual);
    let length = libm::sqrt(distance_sq);
    let (ap, ab) = (ap.abs(), ab.abs());
    let norms = (ap.x + ap.y + ap.z) + (ab.x + ab.y + ab.z);
    let margin = f64::from(SEGMENT_DISTANCE) * U64 * norms;
    PointSegment { lower: (length - margin).max(0.0), upper: length + margin, distance_sq, t }
}

/// A query point with the rounding margin that holds for every segment inside one box.
#[derive(Clone, Copy, Debug)]
pub struct CapsulePoint {
    point: Vec3,
    margin: f32,
}

impl CapsulePoint {
    /// For segments whose ends lie in `bounds`.
    pub fn new(point: Vec3, bounds: &Aabb) -> Self {
        let farthest = (point - bounds.min).abs().max((bounds.max - point).abs());
        let edge = bounds.max - bounds.min;
        let norms = (farthest.x + farthest.y + farthest.z) + (edge.x + edge.y + edge.z);
        CapsulePoint { point, margin: SEGMENT_DISTANCE * U32 * norms + CAPSULE_UNDERFLOW }
    }

    /// A lower bound of the distance to the segment `a b` swept by `radius`, never negative.
    #[inline(always)]
    pub fn lower(&self, a: Vec3, b: Vec3, radius: f32) -> f32 {
        let (ap, ab) = (self.point - a, b - a);
        let (along, length_sq) = (ap.dot(ab), ab.dot(ab));
        let residual = if along <= 0.0 || length_sq < TRUSTED_DIRECTION_SQ {
            ap
        } else if along >= length_sq {
            self.point - b
        } else {
            ap - ab * (along / length_sq)
        };
        let lower = sqrt_approx(residual.dot(residual)) - (radius + self.margin);
        if lower > 0.0 { lower } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intervals_hold_and_the_capsule_bound_is_close_below() {
        let bounds = Aabb { min: Vec3::splat(-1.0), max: Vec3::splat(1.0) };
        let (a, b) = (Vec3::new(-0.5, 0.25, 0.0), Vec3::new(0.75, 0.25, 0.0));
        for (point, distance, t) in [
            (Vec3::new(0.125, 0.25, 3.0), 3.0, 0.5),
            (Vec3::new(-3.5, 4.25, 0.0), 5.0, 0.0),
            (Vec3::new(0.75, -1.75, 0.0), 2.0, 1.0),
            (Vec3::new(0.125, 0.25, 0.0), 0.0, 0.5),
        ] {
            let exact = point_segment(point.as_dvec3(), a.as_dvec3(), b.as_dvec3());
            assert!(exact.lower <= distance && distance <= exact.upper && exact.t == t);
            assert!(exact.upper - exact.lower < 1e-13);
            let bound = CapsulePoint::new(point, &bounds).lower(a, b, 0.125);
            let swept = (distance as f32 - 0.125).max(0.0);
            assert!(bound <= swept && bound > swept - 1e-4, "{bound} {swept}");
        }
    }

    #[test]
    fn a_segment_without_length_is_a_point_and_neighbours_agree_at_a_corner() {
        let (p, a) = (DVec3::new(3.0, 4.0, 0.0), DVec3::ZERO);
        let point = point_segment(p, a, a);
        assert!(point.t == 0.0 && point.distance_sq == 25.0);
        let corner = DVec3::new(0.1, 0.2, 0.3);
        let before = point_segment(p, DVec3::new(-1.0, -1.7, 0.11), corner);
        let after = point_segment(p, corner, DVec3::new(-1.3, -0.9, 7.0));
        assert!(before.t == 1.0 && after.t == 0.0);
        assert_eq!(before.distance_sq.to_bits(), after.distance_sq.to_bits());
    }
}
