//! The frame that the boxes of a node share, and a query point in it.
//!
//! Everything is an integer, so processors without floating point are as fast as others, and the
//! bounds need no allowance for rounding. Lengths are counted in *key units* of 2^h grid units. The
//! exponent h is chosen for each query, so that all distances from the point fit 15 bits. A frame's
//! matrix is a rotation, shrunk so little that no length grows: distances in box coordinates are
//! lower bounds. Proof: `core/docs/rounding.md` §8, "Boxes".

use crate::bvh::format::layout::{FRAME_BYTES, ROW_BITS, boxes};
use crate::num::greater;
use glam::Vec3;

/// Least exponent of a key unit. With it the boxes of a whole model span 15 bits.
pub const LEAST_UNIT: u32 = 2;

/// Greatest exponent of a key unit. Points so far away that they would need more get the distance
/// of the model's box.
const MOST_UNIT: u32 = 26;

/// Bits of a coordinate below a key unit.
const FRACTION_BITS: u32 = 2;

/// Bits by which a product of matrix and coordinates is finer than a key unit.
const PRODUCT_BITS: u32 = ROW_BITS + FRACTION_BITS;

/// Added before a product is cut to key units. It rounds up, and makes up for the rounding of the
/// coordinates: less than √3 · 2^ROW_BITS together, proved 14,420 (`core/docs/rounding.md` §8).
const UP: i32 = (1 << PRODUCT_BITS) - 1 + 14_592;

/// A query point in key units.
#[derive(Clone, Copy, Debug)]
pub struct KeyPoint {
    /// From the grid's origin, with two bits below the unit, rounded down.
    at: [i32; 3],
    /// A key unit is 2^this grid units.
    unit: u32,
}

impl KeyPoint {
    /// `p` less the grid's origin. No point of the model is farther from it than `farthest` along
    /// any axis; both in grid units, `farthest` below 2^40.
    #[inline(always)]
    pub fn new(p: Vec3, farthest: f32) -> KeyPoint {
        // The least exponent for which `farthest` is below 2^(14 + exponent).
        let exponent = (farthest.to_bits() >> 23).saturating_sub(127 + 13);
        let unit = exponent.clamp(LEAST_UNIT, MOST_UNIT);
        let scale = f32::from_bits((127 + FRACTION_BITS - unit) << 23);
        // A positive number, so that the conversion rounds down.
        let whole = |x: f32| ((x * scale + ABOVE as f32) as i32).wrapping_sub(ABOVE);
        KeyPoint { at: [whole(p.x), whole(p.y), whole(p.z)], unit }
    }

    /// The point less the origin of a node's frame, with two bits below the unit.
    #[inline(always)]
    pub fn from_origin(&self, record: &[u8; FRAME_BYTES]) -> [i32; 3] {
        let (origin, _) = record[boxes::FRAME_ORIGIN..].as_chunks::<2>();
        let mut away = self.at;
        for (x, &origin) in away.iter_mut().zip(origin) {
            let origin = u32::from(u16::from_le_bytes(origin)) << FRACTION_BITS;
            *x = x.wrapping_sub((origin >> (self.unit & 31)).cast_signed());
        }
        away
    }

    /// Exponent of a key unit.
    #[inline(always)]
    pub fn unit(&self) -> u32 {
        self.unit
    }
}

/// Above the magnitude of every coordinate of a [`KeyPoint`].
const ABOVE: i32 = 1 << 17;

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
        let (entries, _) = record[boxes::FRAME_ROWS..].as_chunks::<2>();
        let (rows, _) = entries.as_chunks::<3>();
        let from_origin = p.from_origin(record);
        let exponents = &record[boxes::FRAME_EXPONENTS..];
        for (index, (row, exponent)) in rows.iter().zip(exponents).take(3).enumerate() {
            let axis = AxisPlace::of(row, from_origin, *exponent, p.unit);
            (frame.from[index], frame.shift[index]) = (axis.from, axis.shift);
        }
        frame
    }
}

/// A query point along one axis of a node's frame: an entry of [`NodeFrame`].
#[derive(Clone, Copy, Debug)]
pub struct AxisPlace {
    /// See [`NodeFrame::from`].
    pub from: [i32; 2],
    /// See [`NodeFrame::shift`].
    pub shift: u32,
}

impl AxisPlace {
    /// `row` of the matrix, and the point less the frame's origin.
    #[inline(always)]
    pub fn of([a, b, c]: &[[u8; 2]; 3], [x, y, z]: [i32; 3], exponent: u8, unit: u32) -> AxisPlace {
        let term = |pair: &[u8; 2], x: i32| i32::from(i16::from_le_bytes(*pair)).wrapping_mul(x);
        let at = term(a, x).wrapping_add(term(b, y)).wrapping_add(term(c, z));
        let exponent = u32::from(exponent);
        let Axis { step, shift, fine } = if unit <= MOST_NEAR_UNIT {
            Axis::near(exponent, unit)
        } else {
            Axis::far(exponent, unit)
        };
        let shift = shift & 15;
        // Byte 128 lies at the origin, and 127 steps from it lies byte 255.
        let half = step.wrapping_shl(7);
        let least = (0xFF00 >> shift) - MOST;
        let inward = |x: i32| {
            let units = (x.wrapping_add(UP) >> PRODUCT_BITS).wrapping_add(fine);
            greater(least, units)
        };
        let from =
            [inward(half.wrapping_add(at)), inward(half.wrapping_sub(step).wrapping_sub(at))];
        AxisPlace { from, shift }
    }
}

/// A key unit up to which no step of an axis is finer than 2^-7 key units: that of points within 32
/// model sizes.
const MOST_NEAR_UNIT: u32 = 7;

/// The step of an axis.
pub struct Axis {
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
        let (shift, fine) = if shift > 15 { (15, 1) } else { (shift & 15, 0) };
        let bits = (exponent + PRODUCT_BITS).wrapping_sub(unit);
        Axis { step: if bits < 31 { 1 << bits } else { 0 }, shift, fine }
    }
}

/// Largest distance along an axis, key units. Greater ones count as this.
const MOST: i32 = i16::MAX as i32;
