//! A query point in the frame that the boxes of a node share, axis by axis, for processors without
//! vectors. `box_lanes` does the same for all axes at once.

use super::frame::{FRACTION_BITS, KeyPoint, MAX_DISTANCE, MAX_SHIFT, PRODUCT_BITS, ROUND_UP};
use crate::bvh::tree::format::layout::{FRAME_BYTES, boxes};
use crate::num::greater;

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

/// A query point along one axis of a node's frame: in key units.
#[derive(Clone, Copy, Debug)]
pub struct AxisPlace {
    /// Distances of the point inward from byte 0 and from byte 255, key units, rounded up. Cut
    /// below, so that no plane is more than 2^15 − 1 beyond the point.
    pub from: [i32; 2],
    /// A plane's byte, as the high byte of 16 bits, shifted right by this gives key units: 1 to 15.
    pub shift: u32,
}

impl AxisPlace {
    /// The place along the axis whose row of the matrix is `[a, b, c]` and whose step is
    /// 2^`exponent` grid units. `[x, y, z]` is the point less the frame's origin, as
    /// [`KeyPoint::relative_to_origin`] has it.
    #[inline(always)]
    pub fn of(
        [a, b, c]: &[[u8; 2]; 3],
        [x, y, z]: [i32; 3],
        exponent: u8,
        unit_exponent: u32,
    ) -> AxisPlace {
        let term = |pair: &[u8; 2], x: i32| i32::from(i16::from_le_bytes(*pair)).wrapping_mul(x);
        let at = term(a, x).wrapping_add(term(b, y)).wrapping_add(term(c, z));
        let exponent = u32::from(exponent);
        let Axis { step, shift, inset } = if unit_exponent <= MAX_NEAR_EXPONENT {
            Axis::near(exponent, unit_exponent)
        } else {
            Axis::far(exponent, unit_exponent)
        };
        let shift = shift & 15;
        // Byte 128 lies at the origin, and 127 steps from it lies byte 255.
        let half = step.wrapping_shl(7);
        let least = (0xFF00 >> shift) - MAX_DISTANCE;
        let inward = |x: i32| {
            let units = (x.wrapping_add(ROUND_UP) >> PRODUCT_BITS).wrapping_add(inset);
            greater(least, units)
        };
        let from =
            [inward(half.wrapping_add(at)), inward(half.wrapping_sub(step).wrapping_sub(at))];
        AxisPlace { from, shift }
    }
}

/// Largest exponent of a key unit at which no step is finer than 2^-7 key units. Points within 32
/// model sizes do not exceed it.
const MAX_NEAR_EXPONENT: u32 = 7;

/// The step of an axis.
struct Axis {
    /// In units of the products of matrix and coordinates.
    step: i32,
    /// See [`AxisPlace::shift`].
    shift: u32,
    /// Key units by which planes are too far inward.
    inset: i32,
}

impl Axis {
    #[inline(always)]
    fn near(exponent: u32, unit_exponent: u32) -> Axis {
        let bits = (exponent + PRODUCT_BITS).wrapping_sub(unit_exponent);
        let shift = (8 + unit_exponent).wrapping_sub(exponent) & 15;
        Axis { step: 1i32.wrapping_shl(bits), shift, inset: 0 }
    }

    /// A step below 2^-7 key units counts as 2^-7, so that a plane comes less than one key unit too
    /// far inward.
    #[cold]
    #[inline(never)]
    fn far(exponent: u32, unit_exponent: u32) -> Axis {
        let shift = (8 + unit_exponent).saturating_sub(exponent);
        let (shift, inset) = if shift > MAX_SHIFT { (MAX_SHIFT, 1) } else { (shift & 15, 0) };
        let bits = (exponent + PRODUCT_BITS).wrapping_sub(unit_exponent);
        Axis { step: if bits < 31 { 1 << bits } else { 0 }, shift, inset }
    }
}
