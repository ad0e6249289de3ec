//! A glance at a segment and the model's box, in integers: no product of floats is computed, and no
//! end of a segment that misses the box is brought into grid units.
//!
//! Numbers are truncated to whole grid units, all lengths doubled as in
//! [`misses`](super::SegmentAndBox::misses). Margins: `core/docs/rounding.md` §9.

use super::Glance;
use crate::bvh::tree::format::Bvh;
use crate::num::{greater, truncated};

/// Lengths must be below this, grid units.
const MOST: u32 = 1 << 18;
/// What truncation takes from a length along one axis, and the rounding of
/// [`misses`](super::SegmentAndBox::misses), grid units.
const ALONG: i32 = 18;
/// What truncation takes from one factor of a product.
const FACTOR: u32 = 5;

/// The segment between `ends`, input units.
#[inline(never)]
pub(super) fn glance(tree: &Bvh<'_>, ends: [[f32; 3]; 2]) -> Glance {
    try_glance(tree, ends).unwrap_or(Glance::Unsure)
}

#[inline(always)]
fn try_glance(tree: &Bvh<'_>, [a, b]: [[f32; 3]; 2]) -> Option<Glance> {
    let units = tree.units();
    let exponent = units.inward_exponent();
    let (low, high) = tree.grid_bounds();
    let (low, high) = (low.to_array(), high.to_array());
    let mut lengths = Lengths { m: [0; 3], d: [0; 3], extent: [0; 3] };
    let surface = truncated(units.surface_error, 1)?;
    let mut bits = surface.cast_unsigned();
    for axis in 0..3 {
        let (a, b) = (truncated(a[axis], exponent)?, truncated(b[axis], exponent)?);
        let (low, high) = (truncated(low[axis], 0)?, truncated(high[axis], 0)?);
        // Below 2^31 each, for the numbers are below 2^30.
        let (from_low, from_high, d, extent) = (a - low, b - high, b - a, high - low);
        bits |= from_low.unsigned_abs() | from_high.unsigned_abs();
        bits |= d.unsigned_abs() | extent.unsigned_abs();
        lengths.m[axis] = from_low.wrapping_add(from_high);
        lengths.d[axis] = d;
        lengths.extent[axis] = extent;
    }
    if bits >= MOST { None } else { Some(lengths.glance(surface, bits)) }
}

/// Lengths along the axes: of the ways from the box's middle to the segment's, doubled, of the
/// segment, and of the box.
struct Lengths {
    m: [i32; 3],
    d: [i32; 3],
    extent: [i32; 3],
}

impl Lengths {
    /// `surface`: twice the surface error; `bits`: all ones of all lengths, but for `m`, which is
    /// not longer than two of them.
    #[inline(always)]
    fn glance(&self, surface: i32, bits: u32) -> Glance {
        let mut most = i32::MIN;
        for axis in 0..3 {
            let projection = self.extent[axis] + self.d[axis].abs();
            most = greater(most, self.m[axis].abs() - projection);
        }
        if most > surface + ALONG {
            return Glance::Clear;
        }
        // Products of numbers below 2^15 need 30 bits, sums of two of them 31.
        let shift = 17u32.saturating_sub((2 * bits).leading_zeros());
        let margin = ((surface + ALONG) >> shift).unsigned_abs() + 1;
        let short = |x: i32| x >> shift;
        let mut meets = most < -ALONG;
        let ([mx, my, mz], [dx, dy, dz], [hx, hy, hz]) = (self.m, self.d, self.extent);
        // By value: at `opt-level = "s"` the compiler would keep a check of each index.
        for planes in [
            [[mx, my], [dx, dy], [hx, hy]],
            [[my, mz], [dy, dz], [hy, hz]],
            [[mz, mx], [dz, dx], [hz, hx]],
        ] {
            let [[m, n], [d, e], [h, k]] = planes;
            let (m, n, d, e) = (short(m), short(n), short(d), short(e));
            let (h, k) = (short(h).unsigned_abs(), short(k).unsigned_abs());
            let across = (m * e - n * d).unsigned_abs();
            let (m, n, d, e) =
                (m.unsigned_abs(), n.unsigned_abs(), d.unsigned_abs(), e.unsigned_abs());
            let error = FACTOR * (m + n + h + k + 2 * (margin + d + e) + 4 * FACTOR);
            let projection = h * e + k * d;
            if across > projection + margin * (d + e) + error {
                return Glance::Clear;
            }
            meets &= across + error <= projection;
        }
        if meets { Glance::Meets } else { Glance::Unsure }
    }
}
