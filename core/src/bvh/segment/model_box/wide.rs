//! A segment and the model's box, three axes in one register: comparisons one by one would be
//! branches that no processor guesses.

use super::SegmentAndBox;
use crate::num::tolerance::{LEAST_DENOMINATOR, U32};
use glam::Vec3;
use wide::f32x4;

#[inline(always)]
fn lanes(v: Vec3) -> f32x4 {
    f32x4::new([v.x, v.y, v.z, 0.0])
}

/// The axes y, z, x.
#[inline(always)]
fn next(v: f32x4) -> f32x4 {
    let [x, y, z, w] = v.to_array();
    f32x4::new([y, z, x, w])
}

/// By axis, the way from a place to the farthest corner of the box.
#[inline(always)]
pub(super) fn farthest(p: Vec3, low: Vec3, high: Vec3) -> Vec3 {
    let p = lanes(p);
    let [x, y, z, _] = (p - lanes(low)).abs().fast_max((p - lanes(high)).abs()).to_array();
    Vec3::new(x, y, z)
}

/// [`SegmentAndBox::misses`] with the same numbers.
#[inline(always)]
pub(super) fn misses(both: &SegmentAndBox, surface_error: f32, size: f32) -> bool {
    let &SegmentAndBox { a, b, low, high } = both;
    let margin = 2.0 * surface_error + size * (32.0 * U32) + LEAST_DENOMINATOR;
    let (a, b, low, high) = (lanes(a), lanes(b), lanes(low), lanes(high));
    let (d, m) = (b - a, (a - low) + (b - high));
    let (half, d_abs) = ((high - low) + f32x4::splat(margin), d.abs());
    let along = m.abs().simd_gt(half + d_abs);
    let (d_next, m_next, half_next) = (next(d), next(m), next(half));
    let projection = half * d_next.abs() + half_next * d_abs;
    let across =
        (m * d_next - m_next * d).abs().simd_gt(projection + f32x4::splat(LEAST_DENOMINATOR));
    // The fourth lane compares 0 with more.
    (along | across).any()
}
