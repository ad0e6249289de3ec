//! The frame that the boxes of a node share, and a query point that is prepared for it.
//!
//! Everything is an integer, so processors without floating point are as fast as others, and the
//! bounds need no allowance for rounding. Lengths are counted in *key units* of 2^h grid units. The
//! exponent h is chosen for each query, so that the model's farthest point is below 2^14 key units
//! along each grid axis. Larger distances along a frame's axis are cut to 2^15 − 1, which keeps
//! them lower bounds. A frame's matrix is a rotation, shrunk so little that no length grows:
//! distances in box coordinates are lower bounds. Proof: `core/docs/rounding.md` §8, "Boxes".
//!
//! Counts of shifts are masked, `& 15` or `& 31`. The mask never changes the value. It spares the
//! overflow branch.

use crate::bvh::tree::format::layout::ROW_BITS;
use crate::num::{SOFT_FLOAT, floored};
use glam::Vec3;

/// Least exponent of a key unit. With it the boxes of a whole model span 15 bits.
const MIN_UNIT_EXPONENT: u32 = 2;

/// Greatest exponent of a key unit. Points so far away that they would need more get the distance
/// of the model's box.
const MAX_UNIT_EXPONENT: u32 = 26;

/// Bits of a coordinate below a key unit.
pub(super) const FRACTION_BITS: u32 = 2;

/// Bits by which a product of matrix and coordinates is finer than a key unit.
pub(super) const PRODUCT_BITS: u32 = ROW_BITS + FRACTION_BITS;

/// Added before a product is cut to key units. It rounds up. It also covers the rounding of the
/// point, of the frame's origin and of a step that is cut: at most 14,420
/// (`core/docs/rounding.md` §8).
pub(super) const ROUND_UP: i32 = (1 << PRODUCT_BITS) - 1 + 14_592;

/// A query point in key units.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct KeyPoint {
    /// From the grid's origin, with two bits below the unit, rounded down.
    pub(super) at: [i32; 3],
    /// A key unit is 2^this grid units.
    pub(super) unit_exponent: u32,
}

impl KeyPoint {
    /// `p` less the grid's origin. No point of the model is farther from it than `farthest` along
    /// any axis; both in grid units, `farthest` below 2^40.
    #[inline(always)]
    pub fn new(p: Vec3, farthest: f32) -> KeyPoint {
        // The least exponent for which `farthest` is below 2^(14 + exponent).
        let exponent = (farthest.to_bits() >> 23).saturating_sub(127 + 13);
        let unit_exponent = exponent.clamp(MIN_UNIT_EXPONENT, MAX_UNIT_EXPONENT);
        let scale = f32::from_bits((127 + FRACTION_BITS - unit_exponent) << 23);
        let whole = |x: f32| {
            if SOFT_FLOAT {
                // What the sum below rounds to a whole number: half a unit of its last place.
                let fine =
                    floored(x, 8 + FRACTION_BITS.cast_signed() - unit_exponent.cast_signed());
                return fine.wrapping_add(if fine < 0 { 1 } else { 2 }) >> 8;
            }
            // A positive number, so that the conversion rounds down.
            ((x * scale + POSITIVE_OFFSET as f32) as i32).wrapping_sub(POSITIVE_OFFSET)
        };
        KeyPoint { at: [whole(p.x), whole(p.y), whole(p.z)], unit_exponent }
    }

    /// Exponent of a key unit.
    #[inline(always)]
    pub fn unit_exponent(&self) -> u32 {
        self.unit_exponent
    }
}

/// Above the magnitude of every coordinate of a [`KeyPoint`].
const POSITIVE_OFFSET: i32 = 1 << 17;

/// Largest distance along an axis, key units. Greater ones count as this.
pub(super) const MAX_DISTANCE: i32 = i16::MAX as i32;

/// Most bits that are cut from a plane's 16 to get key units. A step that would need more counts as
/// 2^-7 key units.
pub(super) const MAX_SHIFT: u32 = 15;
