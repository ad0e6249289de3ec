//! A plane that parts leaves from a query point, in integers, for processors without vectors.
//!
//! The plane stands across the way from the point to the best triangle so far, a little farther
//! than the best distance. A triangle whose vertices all lie behind it cannot change the answer.

#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
use crate::bvh::format::{FullRing, LeafShape};
#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
use crate::bvh::point_query::PointQuery;
use crate::geom::fan::{Whole, WholePoint};
use crate::num::sqrt_approx;
use crate::num::tolerance::U32;
#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
use crate::num::{
    SOFT_FLOAT,
    tolerance::{EVERYTHING_SQ, LEAST_DENOMINATOR, PLANE_ALONG},
};
#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
use glam::Vec3;

/// The way from the closest point of a triangle to the query, for a plane across it. Without
/// floating point it is about that way in whole numbers of twelve bits, else the bits of the
/// kernel's residual. Zeros if it is not known.
#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Way([i32; 3]);

#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
impl Way {
    pub(crate) const NONE: Way = Way([0; 3]);

    #[inline(always)]
    pub(crate) fn of_whole(direction: Whole) -> Way {
        Way(direction)
    }

    #[inline(always)]
    pub(crate) fn of_residual(residual: Vec3) -> Way {
        Way(residual.to_array().map(|x| x.to_bits().cast_signed()))
    }

    #[inline(always)]
    pub(crate) fn whole(self) -> Whole {
        self.0
    }

    #[inline(always)]
    fn residual(self) -> Vec3 {
        Vec3::from_array(self.0.map(|x| f32::from_bits(x.cast_unsigned())))
    }
}

/// A plane across the way to the best triangle. Coordinates are grid units from the grid's origin.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(
    any(target_arch = "x86_64", target_arch = "aarch64"),
    expect(dead_code, reason = "vector targets look at all lanes of a leaf")
)]
pub(crate) struct LeafPlane {
    normal: Whole,
    /// A vertex whose product with `normal` is at most this lies behind the plane.
    behind: i32,
}

impl LeafPlane {
    /// No vertex is behind it.
    pub(crate) const NONE: LeafPlane = LeafPlane { normal: [0; 3], behind: -1 };

    /// The plane across `normal`, which has twelve bits. What is behind it is farther from `p` than
    /// the root of `limit`.
    pub(crate) fn new(p: &WholePoint, normal: Whole, limit: f32) -> LeafPlane {
        let length_sq = normal.into_iter().fold(0, |sum, x| sum + x * x) as f32;
        let far = sqrt_approx(length_sq * limit) * (1.0 + 8.0 * U32);
        let behind = p.along(normal).saturating_sub(far as i32).saturating_sub(1);
        LeafPlane { normal, behind }
    }
}

#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
impl LeafPlane {
    /// The plane across the way to a triangle at the squared distance `distance_sq`. What is behind
    /// it is farther from the query than the root of `limit`.
    #[inline(always)]
    pub(crate) fn across(query: &PointQuery, way: Way, distance_sq: f32, limit: f32) -> LeafPlane {
        if !SOFT_FLOAT {
            return LeafPlane::across_residual(query.from_origin, way, distance_sq, limit);
        }
        match &query.whole {
            Some(point) => LeafPlane::new(point, way.whole(), limit),
            None => LeafPlane::NONE,
        }
    }

    /// Without a root: |n|·L ≤ (|n|²/2^k + L²·2^k)/2 for any k. Proof: `core/docs/rounding.md` §8,
    /// "Left out".
    #[inline(always)]
    fn across_residual(at: Vec3, way: Way, distance_sq: f32, limit: f32) -> LeafPlane {
        let residual = way.residual();
        let is_known = residual != Vec3::ZERO && distance_sq > LEAST_DENOMINATOR;
        if !(is_known && limit < EVERYTHING_SQ) {
            return LeafPlane::NONE;
        }
        // The residual is not longer than 2^half.
        let half = ((distance_sq.to_bits() >> 23).cast_signed() - 127 + 2) >> 1;
        let power = |k: i32| f32::from_bits((127 + k).cast_unsigned() << 23);
        let (scale, unscale) = (power(12 - half), power(half - 12));
        let [a, b, c] = [residual.x, residual.y, residual.z].map(|x| (x * scale) as i32);
        let length_sq = (a * a + b * b + c * c) as f32;
        let far = 0.5 * (length_sq * unscale + limit * scale) * (1.0 + 8.0 * U32);
        let along = a as f32 * at.x + b as f32 * at.y + c as f32 * at.z;
        let margin = (at.x.abs() + at.y.abs() + at.z.abs()) * PLANE_ALONG;
        let behind = (along - far - margin) as i32;
        LeafPlane { normal: [a, b, c], behind: behind.clamp(-1 << 30, 1 << 30) - 1 }
    }

    /// Whether a vertex may be behind it.
    #[inline(always)]
    pub(crate) fn parts(&self) -> bool {
        let [a, b, c] = self.normal;
        a | b | c != 0
    }

    /// Triangles of a leaf that are not behind the plane: bits, the first triangle's lowest. A call,
    /// for the caller's numbers would leave no registers for the rows.
    #[inline(never)]
    pub(crate) fn in_front(&self, ring: &FullRing<'_>, shape: LeafShape) -> u32 {
        let [a, b, c] = self.normal;
        let less_behind = !self.behind;
        // A product at most `behind` makes the sum negative.
        let is_behind = |[x, y, z]: Whole| {
            let sum = a.wrapping_mul(x).wrapping_add(less_behind);
            let sum = sum.wrapping_add(b.wrapping_mul(y)).wrapping_add(c.wrapping_mul(z));
            sum.cast_unsigned() >> 31
        };
        let behind = ring.bits(is_behind);
        let first_fan = !(u32::MAX << (shape.turn() & 31));
        let [one, other] = ring.centres(shape).map(|centre| is_behind(centre).wrapping_sub(1));
        let in_front = !(behind & behind >> 1) | one & first_fan | other & !first_fan;
        in_front & !(u32::MAX << (shape.triangles() & 31))
    }
}
