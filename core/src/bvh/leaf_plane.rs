//! A plane that parts leaves from a query point, in integers, for processors without floating
//! point.
//!
//! The plane stands across the way from the point to the best triangle so far, a little farther
//! than the best distance. A leaf whose vertices all lie behind it cannot change the answer.

#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
use crate::bvh::format::{GridRing, LeafShape};
use crate::geom::fan::{Whole, WholePoint};
use crate::num::sqrt_approx;
use crate::num::tolerance::U32;

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

    /// Whether a stored vertex is behind the plane.
    #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
    #[inline(always)]
    fn is_behind(&self, [x, y, z]: Whole) -> bool {
        let [a, b, c] = self.normal;
        let along = a.wrapping_mul(x).wrapping_add(b.wrapping_mul(y));
        along.wrapping_add(c.wrapping_mul(z)) <= self.behind
    }

    /// Triangles of a leaf that are not behind the plane: bits, the first triangle's lowest.
    #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
    #[inline(always)]
    pub(crate) fn in_front(&self, ring: &GridRing<'_>, shape: LeafShape) -> u32 {
        let (count, turn) = (shape.triangles(), shape.turn());
        let mut behind = 0u32;
        for ((x, y), z) in ring.x.iter().zip(ring.y).zip(ring.z).rev() {
            let vertex = [x, y, z].map(|pair| i32::from(u16::from_le_bytes(*pair)));
            behind = behind << 1 | u32::from(self.is_behind(vertex));
        }
        let first_fan = !(u32::MAX << (turn & 31));
        let [one, other] = ring.centres.map(|centre| self.is_behind(centre));
        let mut in_front = !(behind & behind >> 1);
        in_front |= if one { 0 } else { first_fan } | if other { 0 } else { !first_fan };
        in_front & !(u32::MAX << (count & 31))
    }
}
