//! A plane that parts leaves from a query point, in integers, for processors without vectors.
//!
//! The plane stands across the way from the point to the best triangle so far, a little farther
//! than the best distance. A triangle whose vertices all lie behind it cannot change the answer.

#[cfg(not(meshsweep_wide))]
use crate::bvh::point::query::PointQuery;
#[cfg(not(meshsweep_wide))]
use crate::bvh::tree::format::{FullRing, LeafShape};
use crate::geom::fan::IntVector;
#[cfg(not(meshsweep_wide))]
use crate::geom::fan::{IntLimit, IntPoint};
#[cfg(not(meshsweep_wide))]
use crate::num::SOFT_FLOAT;
#[cfg(any(test, not(meshsweep_wide)))]
use crate::num::tolerance::{EVERYTHING_SQ, LEAST_DENOMINATOR, PLANE_ALONG, U32};
#[cfg(any(test, not(meshsweep_wide)))]
use glam::Vec3;

/// The offset from the closest point of a triangle to the query, for a plane across it. Without
/// floating point it is about that direction in whole numbers of twelve bits, else the bits of the
/// kernel's residual. Zeros if it is not known.
#[cfg(not(meshsweep_wide))]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Residual([i32; 3]);

#[cfg(not(meshsweep_wide))]
impl Residual {
    pub(crate) const NONE: Residual = Residual([0; 3]);

    #[inline(always)]
    pub(crate) fn of_integers(direction: IntVector) -> Residual {
        Residual(direction)
    }

    #[inline(always)]
    pub(crate) fn of_float(residual: Vec3) -> Residual {
        // Here and below not by `map`: the compiler does not inline that at `opt-level = "s"`.
        let bits = |x: f32| x.to_bits().cast_signed();
        Residual([bits(residual.x), bits(residual.y), bits(residual.z)])
    }

    #[inline(always)]
    pub(crate) fn integers(self) -> IntVector {
        self.0
    }

    #[inline(always)]
    fn float(self) -> Vec3 {
        let [x, y, z] = self.0;
        let float = |x: i32| f32::from_bits(x.cast_unsigned());
        Vec3::new(float(x), float(y), float(z))
    }
}

/// A plane across the residual of the best triangle. Coordinates are grid units from the grid's
/// origin.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(
    all(not(test), meshsweep_wide),
    expect(dead_code, reason = "vector targets look at all lanes of a leaf")
)]
pub(crate) struct LeafPlane {
    normal: IntVector,
    /// A vertex whose product with `normal` is at most this lies behind the plane.
    behind: i32,
}

impl LeafPlane {
    /// No vertex is behind it.
    pub(crate) const NONE: LeafPlane = LeafPlane { normal: [0; 3], behind: -1 };
}

#[cfg(not(meshsweep_wide))]
impl LeafPlane {
    /// The plane across `normal`, which has twelve bits. What is behind it is farther from `p` than
    /// the root of `limit`. Both are of one triangle: `normal` is along the way from it to `p`, and
    /// the root of `limit` is at most as long as that way. So no sum wraps: `core/docs/rounding.md`
    /// §8, "Roots of limits".
    pub(crate) fn new(p: &IntPoint, normal: IntVector, limit: IntLimit) -> LeafPlane {
        let far = limit.root_of_product(normal.into_iter().fold(0, |sum, x| sum + x * x));
        LeafPlane { normal, behind: p.along(normal).saturating_sub(far).saturating_sub(1) }
    }
}

#[cfg(any(test, not(meshsweep_wide)))]
impl LeafPlane {
    /// The plane across `residual`, whose square is `distance_sq`. What is behind it is farther
    /// from `at` than the root of `limit`.
    ///
    /// Without a root: |n|·L ≤ (|n|²/2^k + L²·2^k)/2 for any k. Proof: `core/docs/rounding.md` §8,
    /// "Left out".
    #[cfg_attr(meshsweep_small, inline(never))]
    #[cfg_attr(not(meshsweep_small), inline(always))]
    fn across_residual(at: Vec3, residual: Vec3, distance_sq: f32, limit: f32) -> LeafPlane {
        if !(distance_sq > LEAST_DENOMINATOR && limit < EVERYTHING_SQ) {
            return LeafPlane::NONE;
        }
        // Of zeros, which stand for no residual, the normal is zeros: see `parts`.
        // The residual is not longer than 2^half.
        let half = ((distance_sq.to_bits() >> 23).cast_signed() - 127 + 2) >> 1;
        let power = |k: i32| f32::from_bits((127 + k).cast_unsigned() << 23);
        let (scale, unscale) = (power(12 - half), power(half - 12));
        let whole = |x: f32| (x * scale) as i32;
        let (a, b, c) = (whole(residual.x), whole(residual.y), whole(residual.z));
        let length_sq = (a * a + b * b + c * c) as f32;
        let far = 0.5 * (length_sq * unscale + limit * scale) * (1.0 + 8.0 * U32);
        let along = a as f32 * at.x + b as f32 * at.y + c as f32 * at.z;
        let margin = (at.x.abs() + at.y.abs() + at.z.abs()) * PLANE_ALONG;
        let behind = (along - far - margin) as i32;
        LeafPlane { normal: [a, b, c], behind: behind.clamp(-1 << 30, 1 << 30) - 1 }
    }
}

#[cfg(not(meshsweep_wide))]
impl LeafPlane {
    /// The plane across the way to a triangle at the squared distance `distance_sq`. What is behind
    /// it is farther from the query than the root of `limit`.
    #[inline(always)]
    pub(crate) fn across(
        query: &PointQuery,
        residual: Residual,
        distance_sq: f32,
        limit: f32,
    ) -> LeafPlane {
        if !SOFT_FLOAT {
            let residual = residual.float();
            return LeafPlane::across_residual(query.from_origin, residual, distance_sq, limit);
        }
        match &query.int_point {
            Some(point) => LeafPlane::new(point, residual.integers(), IntLimit::of(limit)),
            None => LeafPlane::NONE,
        }
    }

    /// Whether a vertex may be behind it.
    #[inline(always)]
    pub(crate) fn parts(&self) -> bool {
        let [a, b, c] = self.normal;
        a | b | c != 0
    }

    /// Triangles of a leaf that are not behind the plane: bits, the first triangle's lowest. A
    /// call, for the caller's numbers would leave no registers for the rows.
    #[inline(never)]
    pub(crate) fn in_front(&self, ring: &FullRing<'_>, shape: LeafShape) -> u32 {
        let [a, b, c] = self.normal;
        let less_behind = !self.behind;
        // A product at most `behind` makes the sum negative.
        let is_behind = |[x, y, z]: IntVector| {
            let sum = a.wrapping_mul(x).wrapping_add(less_behind);
            let sum = sum.wrapping_add(b.wrapping_mul(y)).wrapping_add(c.wrapping_mul(z));
            sum.cast_unsigned() >> 31
        };
        let behind = ring.bits(shape, is_behind);
        let first_fan = !(u32::MAX << (shape.turn() & 31));
        let [one, other] = ring.centres(shape);
        let (one, other) = (is_behind(one).wrapping_sub(1), is_behind(other).wrapping_sub(1));
        let in_front = !(behind & behind >> 1) | one & first_fan | other & !first_fan;
        in_front & !(u32::MAX << (shape.triangles() & 31))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::noise::Noise;

    impl Noise {
        fn part(&mut self) -> f64 {
            (self.bits() >> 11) as f64 / (1u64 << 53) as f64
        }

        fn vector(&mut self, size: f64) -> [f64; 3] {
            [(); 3].map(|()| size * (2.0 * self.part() - 1.0))
        }
    }

    #[test]
    fn what_is_behind_a_plane_is_farther_than_the_limit_and_little_is_lost() {
        let mut noise = Noise(5);
        let mut loosest = 0f64;
        for round in 0..300_000 {
            let origin = noise.vector(1e6).map(f64::trunc);
            let away = libm::exp2(f64::from(round % 30));
            let p = noise.vector(away).map(|x| x + 30_000.0);
            let p = [0, 1, 2].map(|k| (p[k] + origin[k]) as f32);
            let from_origin = Vec3::from_array(p) - Vec3::from_array(origin.map(|x| x as f32));
            let size = libm::exp2(40.0 * noise.part() - 10.0);
            let residual = noise.vector(size).map(|x| x as f32);
            let residual = Vec3::from_array(residual);
            let distance_sq = residual.length_squared();
            let limit = distance_sq * (1.0 + noise.part() as f32);
            let plane = LeafPlane::across_residual(from_origin, residual, distance_sq, limit);
            let normal = plane.normal.map(f64::from);
            let along: f64 = (0..3).map(|k| normal[k] * (f64::from(p[k]) - origin[k])).sum();
            let length = libm::sqrt(normal.iter().map(|x| x * x).sum());
            let least = -f64::from(1 << 30);
            let behind = f64::from(plane.behind);
            // The plane's distance from the point, in products of the normal.
            let (far, wanted) = (along - behind, length * libm::sqrt(f64::from(limit)));
            assert!(length == 0.0 || behind <= least || far >= wanted, "{p:?} {residual:?}");
            if length > 0.0 && behind > least && round % 30 < 17 {
                loosest = loosest.max(far / wanted.max(length * away));
            }
            // Nor does a product of a stored vertex leave 32 bits.
            assert!(plane.normal.iter().all(|x| x.abs() <= 1 << 12), "{residual:?}");
        }
        assert!(loosest < 1.5, "{loosest}");
    }
}
