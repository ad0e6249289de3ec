//! A point against eight boxes on processors without vector registers: two children in a 32-bit
//! word, one in each half.
//!
//! A plane's place has fifteen bits. The sixteenth is set before a subtraction, and stays set where
//! the difference is not negative: no half borrows from the other.

use super::axis_place::AxisPlace;
use super::frame::{KeyPoint, MAX_DISTANCE};
use super::keys::{CHILD_MASK, NO_CHILD};
use crate::bvh::format::layout::{FRAME_BYTES, boxes};
use crate::geom::fan::WIDTH;

/// The highest bit of both halves.
const HIGH: u32 = 0x8000_8000;

/// A word with a number in both halves. A negative number borrows from the upper half, and the sum
/// with a greater number pays it back.
#[inline(always)]
fn splat_halves(x: i32) -> u32 {
    x.wrapping_mul(0x0001_0001).cast_unsigned()
}

/// The planes of one axis, less the point.
#[derive(Clone, Copy)]
struct AxisPlanes {
    shift: u32,
    /// The bits of a place in both halves.
    places: u32,
    /// Added to places: [`HIGH`] minus the point's place, for the low and the high planes. If the
    /// point lies before or behind all children, only that side is used and no borrow bit is
    /// needed.
    less_point: [u32; 2],
    side: Side,
}

/// On which side of all children a point is along an axis.
#[derive(Clone, Copy, PartialEq)]
enum Side {
    Before,
    Behind,
    /// Neither is certain.
    Within,
}

impl AxisPlanes {
    const NONE: AxisPlanes =
        AxisPlanes { shift: 0, places: 0, less_point: [0; 2], side: Side::Within };

    /// A call, because three copies would not fit the registers.
    #[inline(never)]
    fn set(&mut self, row: &[[u8; 2]; 3], offset: &[i32; 3], exponent: u8, unit_exponent: u32) {
        let AxisPlace { from, shift } = AxisPlace::of(row, *offset, exponent, unit_exponent);
        let less_point = from.map(|from| {
            // No plane is beyond the greatest distance, so a greater number would say no more.
            HIGH.wrapping_sub(splat_halves(if from < MAX_DISTANCE { from } else { MAX_DISTANCE }))
        });
        let places = splat_halves(0xFF00 >> shift);
        let [first, last] = from;
        let (side, less_point) = if first <= 0 {
            (Side::Before, [0u32.wrapping_sub(splat_halves(first)), 0])
        } else if last <= 0 {
            (Side::Behind, [0, 0u32.wrapping_sub(splat_halves(last))])
        } else {
            (Side::Within, less_point)
        };
        *self = AxisPlanes { shift, places, less_point, side };
    }

    /// The planes less the point. `bytes` are the upper ones of each half.
    #[inline(always)]
    fn differences(&self, bytes: u32, less_point: u32) -> u32 {
        (bytes >> (self.shift & 15) & self.places).wrapping_add(less_point)
    }

    /// The differences that are not negative; the others are 0. `bytes` are the upper ones of each
    /// half.
    #[inline(always)]
    fn above_zero(&self, bytes: u32, less_point: u32) -> u32 {
        let difference = self.differences(bytes, less_point);
        let above = difference & HIGH;
        difference & above.wrapping_sub(above >> 15)
    }
}

/// Adds the squares of both halves.
#[inline(always)]
fn add_squares(sums: &mut [u32; 2], halves: u32) {
    let (low, high) = (halves & 0xFFFF, halves >> 16);
    sums[0] = sums[0].wrapping_add(low.wrapping_mul(low));
    sums[1] = sums[1].wrapping_add(high.wrapping_mul(high));
}

/// Keys of four children. `planes` begins at their first planes of the first axis. Not inlined:
/// the loop over the axes, unrolled, would not fit the registers.
#[inline(never)]
fn keys_of_four(planes: &[u8], axes: &[AxisPlanes], parent: u32, child: u32, keys: &mut [u32; 4]) {
    let (mut even, mut odd) = ([0u32; 2], [0u32; 2]);
    let mut rest = planes;
    for axis in axes {
        let Some((row, next)) = rest.split_first_chunk::<{ 2 * WIDTH }>() else { break };
        let (words, _) = row.as_chunks::<4>();
        let (first, last) = (u32::from_le_bytes(words[0]), u32::from_le_bytes(words[2]));
        let [below, beyond] = axis.less_point;
        // `first << 8` brings bytes 0 and 2 to the upper bytes of the halves.
        let [of_even, of_odd] = match axis.side {
            Side::Before => [axis.differences(first << 8, below), axis.differences(first, below)],
            Side::Behind => [axis.differences(last << 8, beyond), axis.differences(last, beyond)],
            // Of a box whose planes are in order at most one of both is above 0.
            Side::Within => [
                axis.above_zero(first << 8, below) | axis.above_zero(last << 8, beyond),
                axis.above_zero(first, below) | axis.above_zero(last, beyond),
            ],
        };
        add_squares(&mut even, of_even);
        add_squares(&mut odd, of_odd);
        rest = next;
    }
    let sums = [even[0], odd[0], even[1], odd[1]];
    for ((slot, sum), child) in keys.iter_mut().zip(sums).zip(child..) {
        let half = sum >> 1;
        *slot = (if half > parent { half } else { parent }) & !CHILD_MASK | child;
    }
}

/// Keys of a node's children, as [`box_distances`](super::box_distances()) has them.
#[inline(always)]
pub(super) fn keys(
    record: &[u8; FRAME_BYTES],
    p: &KeyPoint,
    count: u32,
    parent: u32,
    keys: &mut [u32; WIDTH],
) {
    let mut axes = [AxisPlanes::NONE; 3];
    let (entries, _) = record[boxes::FRAME_ROWS..].as_chunks::<2>();
    let (rows, _) = entries.as_chunks::<3>();
    let offset = p.relative_to_origin(record);
    for ((axis, row), exponent) in axes.iter_mut().zip(rows).zip(&record[boxes::FRAME_EXPONENTS..])
    {
        axis.set(row, &offset, *exponent, p.unit_exponent());
    }
    let (fours, _) = keys.as_chunks_mut::<4>();
    for (half, four) in fours.iter_mut().enumerate() {
        let planes = record.get(4 * half..).unwrap_or_default();
        // Rows of children 4–7 start four bytes later, so the last slice reads four matrix bytes.
        // They are not used.
        keys_of_four(planes, &axes, parent, 4 * half as u32, four);
    }
    for unused in keys.iter_mut().skip(count as usize) {
        *unused = NO_CHILD;
    }
}
