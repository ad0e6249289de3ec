//! Lower bounds, in f32, of the distance from a point or a segment to a triangle swept by a sphere
//! (Guéziec 2000, 3.1).
//!
//! A bound of this file may be too low by rounding, but never too high. It is a supporting plane,
//! which holds for any direction. So a region misjudged on a sliver costs tightness and not truth.
//! Derivation: `core/docs/rounding.md` §2, §3.

use super::boxes::{Aabb, Clipped};
use super::lanes::Lanes;
use super::real_vector::RealVector;
use super::support::{Support, distance_sq};
use crate::num::tolerance::{
    NEAR_SQUARES, POINT_BOUND, SEGMENT_BOUND, SQUARED_SLACK, TRUSTED_DIRECTION_SQ, U32, U64,
    UNDERFLOW,
};
use crate::num::{Real, greater, lesser};
use glam::Vec3;

/// A lower bound of the distance from the origin to the triangle `a b c`, exact up to a
/// dozen roundings of (farthest corner + longest edge). Zero where the direction is too short to
/// trust.
#[inline(always)]
pub fn direction_bound(a: Vec3, b: Vec3, c: Vec3) -> f32 {
    let Support { along, length_sq } = Support::new(RealVector::corners([a, b, c]));
    if length_sq < TRUSTED_DIRECTION_SQ { 0.0 } else { along / libm::sqrtf(length_sq) }
}

/// A query point with the rounding margin that holds for every triangle inside one box.
#[derive(Clone, Copy, Debug)]
pub struct SweptPoint {
    point: Vec3,
    margin: f32,
}

impl SweptPoint {
    /// For triangles whose corners all lie in `bounds`.
    pub fn new(point: Vec3, bounds: &Aabb) -> Self {
        let farthest = (point - bounds.min).abs().max((bounds.max - point).abs());
        let edge = bounds.max - bounds.min;
        let norms = farthest.x + farthest.y + farthest.z + edge.x + edge.y + edge.z;
        SweptPoint { point, margin: POINT_BOUND * U32 * norms + UNDERFLOW }
    }

    /// An upper bound of the 1-norms of the ways from any corner to the point and to another
    /// corner, together.
    pub fn norms(&self) -> f32 {
        self.margin / (POINT_BOUND * U32)
    }

    /// A lower bound of the distance from the point to the triangle swept by `radius`, never
    /// negative. `None` if the distance certainly exceeds `limit`, which needs no square root.
    #[inline(always)]
    pub fn lower(&self, corners: [Vec3; 3], radius: f32, limit: f32) -> Option<f32> {
        self.bound(Support::new(self.seen(corners)), radius, limit)
    }

    /// An upper bound of the distance from the point to the triangle, infinite where f32 does not
    /// tell.
    #[inline(never)]
    pub fn upper(&self, corners: [Vec3; 3]) -> f32 {
        let length = libm::sqrtf(distance_sq(self.seen(corners)));
        (Real(length) + Real(self.margin)).0
    }

    #[inline(always)]
    fn seen(&self, corners: [Vec3; 3]) -> [RealVector; 3] {
        let (point, [a, b, c]) = (RealVector::from(self.point), RealVector::corners(corners));
        [a - point, b - point, c - point]
    }

    /// Puts a triangle, seen from the point, into a lane.
    #[inline(always)]
    pub fn load(&self, lanes: &mut Lanes, lane: usize, corners: [Vec3; 3]) {
        lanes.set(lane, corners.map(|corner| corner - self.point));
    }

    /// [`lower`](Self::lower) from the triangle's supporting plane.
    #[inline(always)]
    pub fn bound(&self, support: Support, radius: f32, limit: f32) -> Option<f32> {
        let Support { along, length_sq } = support;
        if Real(length_sq) < Real(TRUSTED_DIRECTION_SQ) {
            return Some(0.0);
        }
        let inside = Real(radius) + Real(self.margin);
        let beyond = Real(limit) + inside;
        let squared = Real(along) * Real(along) * Real(SQUARED_SLACK);
        if along > 0.0 && squared > beyond * beyond * Real(length_sq) {
            return None;
        }
        let length = libm::sqrtf(length_sq);
        let Real(lower) = Real(along / length) - inside;
        Some(greater(0.0, lower))
    }
}

/// A segment, clipped to the box of the model, with its rounding margin.
#[derive(Clone, Copy, Debug)]
pub struct SweptSegment {
    start: Vec3,
    direction: Vec3,
    /// 1 / |direction|², or zero where the segment is too short to have a direction.
    inverse_sq: f32,
    length: f32,
    margin: f32,
    /// Parameter of `start` on the unclipped segment, and the parameter of one unit of `direction`.
    t_start: f32,
    t_scale: f32,
}

impl SweptSegment {
    /// For triangles whose corners all lie in `bounds`, which `segment` was clipped to.
    pub fn new(segment: &Clipped, bounds: &Aabb) -> Self {
        let start = segment.start.as_vec3();
        let end = segment.end.as_vec3();
        let direction = end - start;
        let length_sq = direction.dot(direction);
        let edge = bounds.max - bounds.min;
        let farthest = (start - bounds.min).abs().max((bounds.max - start).abs());
        let ends = start.abs() + end.abs();
        let norms = 2.0 * (edge.x + edge.y + edge.z + farthest.x + farthest.y + farthest.z)
            + ends.x
            + ends.y
            + ends.z;
        // The clipped ends are off by roundings of the unclipped ones.
        let clipping = (16.0 * U64 * segment.magnitude) as f32;
        let margin = SEGMENT_BOUND * U32 * norms + clipping + UNDERFLOW;
        let has_direction = length_sq >= TRUSTED_DIRECTION_SQ;
        let length = libm::sqrtf(length_sq);
        SweptSegment {
            start,
            direction,
            inverse_sq: if has_direction { 1.0 / length_sq } else { 0.0 },
            length,
            // Without a direction the segment is a point, and its length is part of the doubt.
            margin: if has_direction { margin } else { margin + 2.0 * length },
            t_start: segment.t_start as f32,
            t_scale: (segment.t_end - segment.t_start) as f32,
        }
    }

    /// `Some(t)` if the segment may come within `radius` of the triangle, at no parameter of the
    /// unclipped segment below `t`. `None` only if it certainly does not.
    #[inline(always)]
    pub fn enter(&self, corners: [Vec3; 3], radius: f32) -> Option<f32> {
        let (start, direction) = (RealVector::from(self.start), RealVector::from(self.direction));
        let inverse_sq = Real(self.inverse_sq);
        let max_distance = Real(radius) + Real(self.margin);
        let [a, b, c] = RealVector::corners(corners);
        let (a, b, c) = (a - start, b - start, c - start);
        let along = |seen: RealVector| seen.dot(direction) * inverse_sq;
        let (sa, sb, sc) = (along(a), along(b), along(c));
        let slack = max_distance * Real(self.length) * inverse_sq;
        let first = lesser(lesser(sa, sb), sc) - slack;
        let last = greater(greater(sa, sb), sc) + slack;
        if first > Real(1.0) || last < Real(0.0) {
            return None;
        }
        // Seen along the segment, the distance of its line and the triangle is the distance of a
        // point and a triangle.
        let across = Support::new([a - direction * sa, b - direction * sb, c - direction * sc]);
        if is_beyond(across, max_distance.0) {
            return None;
        }
        let enters = greater(first, Real(0.0)) * Real(self.t_scale);
        Some((Real(self.t_start) + enters - Real(16.0 * U32)).0)
    }
}

/// Whether the [`direction_bound`] of a triangle is above a limit, which is not negative. The root,
/// which boards compute by many instructions, is taken only where the squares are too near.
#[inline(always)]
fn is_beyond(Support { along, length_sq }: Support, limit: f32) -> bool {
    if along <= 0.0 || length_sq < TRUSTED_DIRECTION_SQ {
        return false;
    }
    let reached = Real(along) * Real(along);
    let allowed = Real(limit) * (Real(limit) * Real(length_sq));
    if allowed > Real(TRUSTED_DIRECTION_SQ) {
        if reached > allowed * Real(NEAR_SQUARES) {
            return true;
        }
        if reached * Real(NEAR_SQUARES) < allowed {
            return false;
        }
    }
    along / libm::sqrtf(length_sq) > limit
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::noise::Noise;
    use glam::DVec3;

    #[test]
    fn point_bound_is_below_the_distance_and_close_to_it() {
        let bounds = Aabb { min: Vec3::splat(-1.0), max: Vec3::splat(1.0) };
        let corners = [Vec3::ZERO, Vec3::X, Vec3::Y];
        for (point, distance) in [
            (Vec3::new(0.2, 0.2, 3.0), 3.0),
            (Vec3::new(-3.0, -4.0, 0.0), 5.0),
            (Vec3::new(0.5, -2.0, 0.0), 2.0),
        ] {
            let swept = SweptPoint::new(point, &bounds);
            let (lower, upper) = (
                swept.lower(corners, 0.25, f32::INFINITY).expect("nothing exceeds infinity"),
                swept.upper(corners),
            );
            assert!(swept.lower(corners, 0.25, distance - 0.2).is_some());
            assert!(swept.lower(corners, 0.25, distance - 0.3).is_none());
            assert!(distance <= upper && upper < distance + 1e-4, "{upper} {distance}");
            assert!(
                lower <= distance - 0.25 && lower > distance - 0.25 - 1e-4,
                "{lower} {distance}"
            );
        }
    }

    #[test]
    fn squares_decide_as_the_root_does() {
        let (mut noise, mut counts) = (Noise(5), [0; 2]);
        let mut random = || (noise.bits() >> 40) as f32 / (1u32 << 24) as f32;
        for round in 0..400_000 {
            // Lengths from below the trusted one to far above it.
            let length = libm::exp2f(random() * 90.0 - 65.0);
            let limit = [1e-12, 1e-6, 1e-3, 1.0][round % 4] * random();
            let near = 1.0 + [0.0, 1e-7, 1e-6, 1e-5, 1.0][round % 5] * (random() - 0.5);
            let along = limit * length * near - [0.0, 1e-30][round % 2];
            let support = Support { along, length_sq: length * length };
            let bound = if support.length_sq < TRUSTED_DIRECTION_SQ {
                0.0
            } else {
                along / libm::sqrtf(support.length_sq)
            };
            assert_eq!(is_beyond(support, limit), bound > limit, "{support:?} {limit:e}");
            counts[usize::from(bound > limit)] += 1;
        }
        assert!(counts.iter().all(|&count| count > 50_000), "{counts:?}");
    }

    #[test]
    fn segment_probe_separates_what_is_apart_and_keeps_what_touches() {
        let bounds = Aabb { min: Vec3::splat(-1.0), max: Vec3::splat(1.0) };
        let corners = [Vec3::ZERO, Vec3::X, Vec3::Y];
        let segment = |a: [f64; 3], b: [f64; 3]| {
            let clipped = bounds.clip(DVec3::from(a), DVec3::from(b)).expect("meets the box");
            SweptSegment::new(&clipped, &bounds)
        };
        let through = segment([0.2, 0.2, 1.0], [0.2, 0.2, -1.0]);
        let t = through.enter(corners, 0.0).expect("crosses");
        assert!(t <= 0.5 && t > 0.49, "{t}");
        assert!(segment([0.2, -0.3, 1.0], [0.2, -0.3, -1.0]).enter(corners, 0.25).is_none());
        assert!(segment([0.2, -0.3, 1.0], [0.2, -0.3, -1.0]).enter(corners, 0.31).is_some());
        assert!(segment([0.2, 0.2, 1.0], [0.2, 0.2, 0.5]).enter(corners, 0.4).is_none());
        assert!(segment([0.2, 0.2, 0.5], [0.2, 0.2, 0.5]).enter(corners, 0.4).is_none());
        assert!(segment([0.2, 0.2, 0.5], [0.2, 0.2, 0.5]).enter(corners, 0.51).is_some());
    }
}
