//! A glance at a segment and the model's box, in f32 with early exits.
//!
//! A product, sum or difference only grows with the margin. A length that is not beyond the
//! projection without a margin is not beyond it in [`misses`](SegmentAndBox::misses). A length that
//! is beyond the projection with a greater margin is beyond it there too.

use super::{Glance, SegmentAndBox};
use crate::num::tolerance::{BVH_FAR, LEAST_DENOMINATOR, U32};
use glam::Vec3;

#[inline(always)]
pub(super) fn glance(both: &SegmentAndBox, surface_error: f32) -> Glance {
    let &SegmentAndBox { a, b, low, high } = both;
    let (d, m, extent) = (b - a, (a - low) + (b - high), high - low);
    let (d_abs, m_abs) = (d.abs(), m.abs());
    let projection = extent + d_abs;
    // Not less than the ways of both ends to their farthest corners.
    let size = (m_abs.x + projection.x) + (m_abs.y + projection.y) + (m_abs.z + projection.z);
    // Coordinates that are not finite end here too.
    if size.is_nan() || size > 0.5 * BVH_FAR {
        return Glance::Unsure;
    }
    // One 32nd more than the margin of `misses` pays for the rounding of `size`.
    let margin = || 2.0 * surface_error + size * (33.0 * U32) + LEAST_DENOMINATOR;
    if m_abs.x > projection.x || m_abs.y > projection.y || m_abs.z > projection.z {
        let far = (extent + Vec3::splat(margin())) + d_abs;
        let is_clear = m_abs.x > far.x || m_abs.y > far.y || m_abs.z > far.z;
        return if is_clear { Glance::Clear } else { Glance::Unsure };
    }
    let projection_across = |[d, e]: [f32; 2], [h, k]: [f32; 2]| h * e + k * d;
    let across = |[m, n]: [f32; 2], [d, e]: [f32; 2]| (m * e - n * d).abs();
    let (dx, dy, dz) = (d_abs.x, d_abs.y, d_abs.z);
    let Vec3 { x, y, z } = extent;
    let (xy, yz, zx) = (
        across([m.x, m.y], [d.x, d.y]),
        across([m.y, m.z], [d.y, d.z]),
        across([m.z, m.x], [d.z, d.x]),
    );
    let (beyond, along, [h, k]) = if xy > projection_across([dx, dy], [x, y]) {
        (xy, [dx, dy], [x, y])
    } else if yz > projection_across([dy, dz], [y, z]) {
        (yz, [dy, dz], [y, z])
    } else if zx > projection_across([dz, dx], [z, x]) {
        (zx, [dz, dx], [z, x])
    } else {
        return Glance::Meets;
    };
    let margin = margin();
    let projection = projection_across(along, [h + margin, k + margin]);
    if beyond > projection + LEAST_DENOMINATOR { Glance::Clear } else { Glance::Unsure }
}
