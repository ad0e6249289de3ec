//! A query point in the frame that the boxes of a node share, axis by axis, for processors without
//! vectors. `box_lanes` does the same for all axes at once.

use super::frame::{FRACTION_BITS, KeyPoint, MAX_SHIFT, PRODUCT_BITS, ROUND_UP};
use crate::bvh::tree::format::layout::{FRAME_BYTES, boxes};

impl KeyPoint {
    /// The point less the origin of a node's frame, with two bits below the unit.
    #[inline(always)]
    pub fn relative_to_origin(&self, record: &[u8; FRAME_BYTES]) -> [i32; 3] {
        let (origin, _) = record[boxes::FRAME_ORIGIN..].as_chunks::<2>();
        // The unit is at least that of the bits below it.
        let places = self.unit_exponent.wrapping_sub(FRACTION_BITS) & 31;
        let away = |x: i32, axis: usize| {
            let origin = u32::from(u16::from_le_bytes(origin[axis])) >> places;
            x.wrapping_sub(origin.cast_signed())
        };
        // By number: at `opt-level = "s"` a loop would keep the vector in memory.
        let [x, y, z] = self.at;
        [away(x, 0), away(y, 1), away(z, 2)]
    }
}

/// How far a step is below a key unit at most, in powers of two. A finer one counts as this, so a
/// plane comes less than one key unit too far inward.
pub(super) const FINEST: i32 = MAX_SHIFT.cast_signed() - 8;

/// Distances of the query point inward from byte 0 and from byte 255 along an axis of a node's
/// frame: key units, rounded up.
///
/// `[a, b, c]` is the axis's row of the matrix. `[x, y, z]` is the point less the frame's origin,
/// by [`KeyPoint::relative_to_origin`]. The axis's step is 2^`above` key units.
#[inline(always)]
pub(super) fn axis_place([a, b, c]: &[[u8; 2]; 3], [x, y, z]: [i32; 3], above: i32) -> [i32; 2] {
    let term = |pair: &[u8; 2], x: i32| i32::from(i16::from_le_bytes(*pair)).wrapping_mul(x);
    let at = term(a, x).wrapping_add(term(b, y)).wrapping_add(term(c, z));
    // In units of the products of matrix and coordinates.
    let bits = above.wrapping_add(PRODUCT_BITS.cast_signed());
    let (mut step, mut inset) = (1i32.wrapping_shl(bits.cast_unsigned()), 0);
    if above < -FINEST {
        (step, inset) = (if bits < 0 { 0 } else { step }, 1);
    }
    // Byte 128 lies at the origin, and 127 steps from it lies byte 255.
    let half = step.wrapping_shl(7);
    let inward = |x: i32| (x.wrapping_add(ROUND_UP) >> PRODUCT_BITS).wrapping_add(inset);
    [inward(half.wrapping_add(at)), inward(half.wrapping_sub(step).wrapping_sub(at))]
}
