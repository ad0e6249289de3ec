//! A query point in the frame that the boxes of a node share, axis by axis, for targets without
//! vectors. `box_lanes` does the same for all axes at once.

use super::key_point::{FRACTION_BITS, KeyPoint, MOST, MOST_CUT, PRODUCT_BITS, UP};
use crate::bvh::format::layout::{FRAME_BYTES, boxes};
use crate::num::greater;

/// A query point in the frame of one node, by axis, in key units.
#[derive(Clone, Copy, Debug)]
pub struct NodeFrame {
    /// From the first and from the last plane inward, rounded up. No plane of a child is farther
    /// than 2^15 − 1 from it.
    pub from: [[i32; 2]; 3],
    /// A plane's byte, as the high byte of 16 bits, shifted right by this gives key units: 1 to 15.
    pub shift: [u32; 3],
}

impl NodeFrame {
    /// Brings a point into the frame of a node's boxes. Bytes that no check has seen give some
    /// frame.
    #[inline(always)]
    pub fn of(record: &[u8; FRAME_BYTES], p: &KeyPoint) -> NodeFrame {
        let mut frame = NodeFrame { from: [[0; 2]; 3], shift: [1; 3] };
        let (halves, _) = record.as_chunks::<2>();
        let Some(numbers) =
            halves.get(boxes::FRAME_ROWS / 2..).and_then(|halves| halves.first_chunk::<12>())
        else {
            return frame;
        };
        let [a, b, c, d, e, f, g, h, i, ox, oy, oz] = *numbers;
        let row = |x: [u8; 2]| i32::from(i16::from_le_bytes(x));
        let way = |at: i32, origin: [u8; 2]| {
            let origin = i32::from(u16::from_le_bytes(origin)) << FRACTION_BITS;
            at.wrapping_sub(origin >> (p.unit & 31))
        };
        let [x, y, z] = [way(p.at[0], ox), way(p.at[1], oy), way(p.at[2], oz)];
        let along = |[a, b, c]: [[u8; 2]; 3]| {
            let terms = [row(a).wrapping_mul(x), row(b).wrapping_mul(y), row(c).wrapping_mul(z)];
            terms[0].wrapping_add(terms[1]).wrapping_add(terms[2])
        };
        let exponents: [u8; 3] =
            match record.get(boxes::FRAME_EXPONENTS..).and_then(|b| b.first_chunk()) {
                Some(&exponents) => exponents,
                None => return frame,
            };
        let rows = [along([a, b, c]), along([d, e, f]), along([g, h, i])];
        for (index, (at, exponent)) in rows.into_iter().zip(exponents).enumerate() {
            let exponent = u32::from(exponent);
            let Axis { step, shift, fine } = if p.unit <= MOST_NEAR_UNIT {
                Axis::near(exponent, p.unit)
            } else {
                Axis::far(exponent, p.unit)
            };
            // Byte 128 lies at the origin, and 127 steps from it lies byte 255.
            let half = step.wrapping_shl(7);
            let least = (0xFF00 >> shift) - MOST;
            let inward = |x: i32| {
                let units = (x.wrapping_add(UP) >> PRODUCT_BITS).wrapping_add(fine);
                greater(least, units)
            };
            frame.from[index] =
                [inward(half.wrapping_add(at)), inward(half.wrapping_sub(step).wrapping_sub(at))];
            frame.shift[index] = shift;
        }
        frame
    }
}

/// A key unit up to which no step of an axis is finer than 2^-7 key units: that of points within 32
/// model sizes.
const MOST_NEAR_UNIT: u32 = 7;

/// The step of an axis.
struct Axis {
    /// In units of the products of matrix and coordinates.
    step: i32,
    /// See [`NodeFrame::shift`].
    shift: u32,
    /// Key units by which planes are too far inward.
    fine: i32,
}

impl Axis {
    #[inline(always)]
    fn near(exponent: u32, unit: u32) -> Axis {
        let bits = (exponent + PRODUCT_BITS).wrapping_sub(unit);
        let shift = (8 + unit).wrapping_sub(exponent) & 15;
        Axis { step: 1i32.wrapping_shl(bits), shift, fine: 0 }
    }

    /// A step below 2^-7 key units counts as 2^-7, so that a plane comes less than one key unit too
    /// far inward.
    #[cold]
    #[inline(never)]
    fn far(exponent: u32, unit: u32) -> Axis {
        let shift = (8 + unit).saturating_sub(exponent);
        let (shift, fine) = if shift > MOST_CUT { (MOST_CUT, 1) } else { (shift, 0) };
        let bits = (exponent + PRODUCT_BITS).wrapping_sub(unit);
        Axis { step: if bits < 31 { 1 << bits } else { 0 }, shift, fine }
    }
}
