//! A plane that parts leaves from a query point, in integers, for processors without floating
//! point.
//!
//! The plane stands across the way from the point to the best triangle so far, a little farther
//! than the best distance. A leaf whose vertices all lie behind it cannot change the answer.

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
    pub(crate) fn is_behind(&self, [x, y, z]: Whole) -> bool {
        let [a, b, c] = self.normal;
        let along = a.wrapping_mul(x).wrapping_add(b.wrapping_mul(y));
        along.wrapping_add(c.wrapping_mul(z)) <= self.behind
    }
}
