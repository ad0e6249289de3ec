//! A point against eight boxes on processors without vector registers: two children in each half
//! of a 32-bit word.
//!
//! A plane's place has fifteen bits. The sixteenth is set before a subtraction, and stays set where
//! the difference is not negative: no half borrows from the other.

use super::axis_place::AxisPlace;
use super::frame::KeyPoint;
use super::keys::{CHILD_MASK, NO_CHILD};
use crate::bvh::format::layout::{FRAME_BYTES, boxes};
use crate::geom::fan::WIDTH;

/// The highest bit of both halves.
const HIGH: u32 = 0x8000_8000;

/// A word with a number in both halves. A negative number borrows from the upper half, and the sum
/// with a greater number pays it back.
#[inline(always)]
fn in_both(x: i32) -> u32 {
    x.wrapping_mul(0x0001_0001).cast_unsigned()
}

/// The planes of one axis, less the point.
#[derive(Clone, Copy)]
struct AxisPlanes {
    shift: u32,
    /// The bits of a place in both halves.
    places: u32,
    /// Added to places: [`HIGH`], less the point's own place from the first and from the last
    /// plane. Of a point outside the node, from the plane on its side, without [`HIGH`].
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
    fn set(&mut self, row: &[[u8; 2]; 3], from_origin: &[i32; 3], exponent: u8, unit: u32) {
        let AxisPlace { from, shift } = AxisPlace::of(row, *from_origin, exponent, unit);
        let less_point = from.map(|from| {
            // A plane is never beyond this, so a greater number would say no more.
            let most = i32::from(i16::MAX);
            HIGH.wrapping_sub(in_both(if from < most { from } else { most }))
        });
        let places = in_both(0xFF00 >> shift);
        let [first, last] = from;
        let (side, less_point) = if first <= 0 {
            (Side::Before, [0u32.wrapping_sub(in_both(first)), 0])
        } else if last <= 0 {
            (Side::Behind, [0, 0u32.wrapping_sub(in_both(last))])
        } else {
            (Side::Within, less_point)
        };
        *self = AxisPlanes { shift, places, less_point, side };
    }

    #[inline(always)]
    fn less(&self, bytes: u32, less_point: u32) -> u32 {
        (bytes >> (self.shift & 15) & self.places).wrapping_add(less_point)
    }

    /// The differences that are not negative; the others are 0. `bytes` are the upper ones of each
    /// half.
    #[inline(always)]
    fn above_zero(&self, bytes: u32, less_point: u32) -> u32 {
        let difference = self.less(bytes, less_point);
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
    let (mut odd, mut even) = ([0u32; 2], [0u32; 2]);
    let mut rest = planes;
    for axis in axes {
        let Some((row, next)) = rest.split_first_chunk::<{ 2 * WIDTH }>() else { break };
        let (words, _) = row.as_chunks::<4>();
        let (first, last) = (u32::from_le_bytes(words[0]), u32::from_le_bytes(words[2]));
        let [below, beyond] = axis.less_point;
        let [one, other] = match axis.side {
            Side::Before => [axis.less(first << 8, below), axis.less(first, below)],
            Side::Behind => [axis.less(last << 8, beyond), axis.less(last, beyond)],
            // Of a box whose planes are in order at most one of both is above 0.
            Side::Within => [
                axis.above_zero(first << 8, below) | axis.above_zero(last << 8, beyond),
                axis.above_zero(first, below) | axis.above_zero(last, beyond),
            ],
        };
        add_squares(&mut odd, one);
        add_squares(&mut even, other);
        rest = next;
    }
    let sums = [odd[0], even[0], odd[1], even[1]];
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
    let from_origin = p.from_origin(record);
    for ((axis, row), exponent) in axes.iter_mut().zip(rows).zip(&record[boxes::FRAME_EXPONENTS..])
    {
        axis.set(row, &from_origin, *exponent, p.unit());
    }
    let (fours, _) = keys.as_chunks_mut::<4>();
    for (half, four) in fours.iter_mut().enumerate() {
        let planes = record.get(4 * half..).unwrap_or_default();
        // The last row of the second half ends in the matrix.
        keys_of_four(planes, &axes, parent, 4 * half as u32, four);
    }
    for unused in keys.iter_mut().skip(count as usize) {
        *unused = NO_CHILD;
    }
}
