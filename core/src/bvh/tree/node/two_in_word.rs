//! A point against eight boxes on processors without vector registers: two children in a 32-bit
//! word, one in each half.
//!
//! A plane's place is its byte times the step, less the point: one multiply-add for two children.
//! Places have fifteen bits. Where a side is not certain, the sixteenth is set before the
//! subtraction, and stays set where the difference is not negative: no half borrows from the other.

use super::axis_place::{FINEST, axis_place};
use super::frame::{KeyPoint, MAX_DISTANCE, PRODUCT_BITS, ROUND_UP};
use super::keys::{CHILD_MASK, NO_CHILD};
use super::opened_node::{OpenedNode, Pushed, Pusher};
use crate::bvh::tree::format::layout::{FRAME_BYTES, boxes};
use crate::geom::fan::WIDTH;
use crate::num::{SOFT_FLOAT, greater, lesser};
use crate::query::ScratchEntry;

/// Squared distance of an absent child: its key is above every limit.
const ABSENT: u32 = NO_CHILD << 1;

/// The highest bit of both halves.
const HIGH: u32 = 0x8000_8000;

/// Bytes 0 and 2 of a word, and bytes 1 and 3, each in a half.
#[inline(always)]
fn halves(bytes: &[u8; 4]) -> [u32; 2] {
    if SOFT_FLOAT {
        // Processors without an FPU read a word at any place byte by byte. By reference: from a
        // word the compiler would take the bytes again.
        let [a, b, c, d] = bytes;
        let both = |low: &u8, high: &u8| u32::from(*low) | u32::from(*high) << 16;
        return [both(a, c), both(b, d)];
    }
    let word = u32::from_le_bytes(*bytes);
    [word & 0x00FF_00FF, word >> 8 & 0x00FF_00FF]
}

/// Words of four planes in a frame.
const PLANE_WORDS: usize = boxes::FRAME_ROWS / 4;

/// Two words of the first axis's low planes, two of its high ones, and so on.
type PlaneWords = [[u8; 4]; PLANE_WORDS];

/// A word with a number of sixteen bits in both halves.
#[inline(always)]
fn splat_halves(x: i32) -> u32 {
    x.cast_unsigned() | x.cast_unsigned() << 16
}

/// The planes of one axis, less the point.
#[derive(Clone, Copy)]
struct AxisPlanes {
    /// Key units in a step, up to 128.
    step: u32,
    /// Added to places, for the low and the high planes: minus the point's place, and [`HIGH`] if
    /// both sides count. The first serves if only one side does.
    less_point: [u32; 2],
    side: Side,
}

/// On which side of all children a point is along an axis.
#[derive(Clone, Copy, PartialEq)]
#[repr(u32)]
enum Side {
    Before,
    Behind,
    /// Neither is certain.
    Within,
}

impl AxisPlanes {
    const NONE: AxisPlanes = AxisPlanes { step: 0, less_point: [0; 2], side: Side::Within };

    /// The two numbers are those of [`axis_place`]. One that is negative is cut to `least`.
    #[inline(always)]
    fn new([first, last]: [i32; 2], step: u32, least: i32) -> AxisPlanes {
        let both = |[first, last]: [i32; 2]| {
            let less_point = [splat_halves((1 << 15) - first), splat_halves((1 << 15) - last)];
            AxisPlanes { step, less_point, side: Side::Within }
        };
        if (first | last) >> 15 == 0 {
            both([first, last])
        } else if first > 0 && last > 0 {
            // No plane is beyond the greatest distance, so a greater number would say no more.
            both([lesser(first, MAX_DISTANCE), lesser(last, MAX_DISTANCE)])
        } else {
            let (from, side) =
                if first <= 0 { (first, Side::Before) } else { (last, Side::Behind) };
            let less_point = splat_halves(greater(from, least).wrapping_neg());
            AxisPlanes { step, less_point: [less_point, 0], side }
        }
    }

    /// The planes less the point. `bytes` has one in each half.
    #[inline(always)]
    fn differences(&self, bytes: u32, less_point: u32) -> u32 {
        bytes.wrapping_mul(self.step).wrapping_add(less_point)
    }

    /// The differences that are not negative; the others are 0.
    #[inline(always)]
    fn above_zero(&self, bytes: u32, less_point: u32) -> u32 {
        let difference = self.differences(bytes, less_point);
        let above = difference & HIGH;
        difference & above.wrapping_sub(above >> 15)
    }
}

/// Squared distances of four children from the point, in squares of key units. `words` begins with
/// their low planes of the first axis. A call, for in the caller the loop would not fit the
/// registers.
#[inline(never)]
fn squares_of_four(words: &[[u8; 4]; PLANE_WORDS - 1], axes: &[AxisPlanes; 3]) -> [u32; 4] {
    let [mut a, mut b, mut c, mut d] = [0u32; 4];
    for (k, axis) in axes.iter().enumerate() {
        let bytes = |at: usize| halves(&words[4 * k + at]);
        let [below, beyond] = axis.less_point;
        let (even, odd);
        if axis.side == Side::Within {
            let ([low, odd_low], [high, odd_high]) = (bytes(0), bytes(2));
            // Of a box whose planes are in order at most one of both is above 0.
            even = axis.above_zero(low, below) | axis.above_zero(high, beyond);
            odd = axis.above_zero(odd_low, below) | axis.above_zero(odd_high, beyond);
        } else {
            let [bytes, odd_bytes] = if axis.side == Side::Before { bytes(0) } else { bytes(2) };
            even = axis.differences(bytes, below);
            odd = axis.differences(odd_bytes, below);
        }
        a = plus_square(a, i32::from(even as i16));
        b = plus_square(b, i32::from(odd as i16));
        c = plus_square(c, even.cast_signed() >> 16);
        d = plus_square(d, odd.cast_signed() >> 16);
    }
    [a, b, c, d]
}

#[inline(always)]
fn plus_square(sum: u32, x: i32) -> u32 {
    sum.wrapping_add(x.wrapping_mul(x).cast_unsigned())
}

/// By how much the exponents of a frame's steps are above a key unit's, each in a byte. `None`: one
/// is below.
#[inline(always)]
fn coarse_steps(record: &[u8; FRAME_BYTES], p: &KeyPoint) -> Option<u32> {
    const HIGH: u32 = 0x80_8080;
    let exponents = record[boxes::FRAME_EXPONENTS..].first_chunk()?;
    // An exponent is below 10, and a unit's below 27.
    let unit = p.unit_exponent() | p.unit_exponent() << 8 | p.unit_exponent() << 16;
    let beyond = (u32::from_le_bytes(*exponents) | HIGH).wrapping_sub(unit);
    if beyond & HIGH == HIGH { Some(beyond ^ HIGH) } else { None }
}

/// Sets the axes of a frame whose steps are not finer than a key unit. Then a plane's place is a
/// whole number of key units.
#[inline(always)]
fn set_coarse(axes: &mut [AxisPlanes; 3], record: &[u8; FRAME_BYTES], p: &KeyPoint, steps: u32) {
    let (entries, _) = record[boxes::FRAME_ROWS..].as_chunks::<2>();
    let (rows, _) = entries.as_chunks::<3>();
    let [x, y, z] = p.relative_to_origin(record);
    for k in 0..3 {
        // As `axis_place` has it, with the step taken out of the sum that is rounded.
        let [a, b, c] = rows[k];
        let term = |pair: [u8; 2], x: i32| i32::from(i16::from_le_bytes(pair)).wrapping_mul(x);
        let at = term(a, x).wrapping_add(term(b, y)).wrapping_add(term(c, z));
        let half = 128 << (steps >> (8 * k) & 7);
        let step = half >> 7;
        // ⌊(ROUND_UP − at) / 2^PRODUCT_BITS⌋ is minus the other quotient.
        let down = at.wrapping_sub(ROUND_UP - ((1 << PRODUCT_BITS) - 1));
        let up = down.wrapping_add(2 * ROUND_UP - ((1 << PRODUCT_BITS) - 1));
        let first = (up >> PRODUCT_BITS).wrapping_add(half);
        let last = (half - step).wrapping_sub(down >> PRODUCT_BITS);
        let least = 2 * half - step - MAX_DISTANCE;
        axes[k] = AxisPlanes::new([first, last], step.cast_unsigned(), least);
    }
}

/// The axes of any frame. Whether a step is finer than a key unit: then its planes are to be cut.
#[cfg_attr(meshsweep_small, inline(always))]
#[cfg_attr(not(meshsweep_small), cold, inline(never))]
fn any_axes(record: &[u8; FRAME_BYTES], p: &KeyPoint) -> ([AxisPlanes; 3], bool) {
    let (entries, _) = record[boxes::FRAME_ROWS..].as_chunks::<2>();
    let (rows, _) = entries.as_chunks::<3>();
    let offset = p.relative_to_origin(record);
    let above = |axis| above_unit(record, p, axis);
    let (x, y, z) = (above(0), above(1), above(2));
    let axis = |k: usize, above| any_axis(&rows[k], &offset, above);
    ([axis(0, x), axis(1, y), axis(2, z)], (x | y | z) < 0)
}

/// An axis of any frame. In small code a call: a loop over axes would keep its numbers in memory.
#[cfg_attr(meshsweep_small, inline(never))]
#[cfg_attr(not(meshsweep_small), inline(always))]
fn any_axis(row: &[[u8; 2]; 3], offset: &[i32; 3], above: i32) -> AxisPlanes {
    // A byte stands for the high one of sixteen bits, of which the low ones are cut off.
    // Counts of at most 15 bits, but for the bytes of an unchecked tree.
    let (down, up) = (8 - greater(above, -FINEST), greater(above, 0));
    let least = 0xFF00i32.wrapping_shr(down.cast_unsigned()) - MAX_DISTANCE;
    let step = 1u32.wrapping_shl(up.cast_unsigned());
    AxisPlanes::new(axis_place(row, *offset, above), step, least)
}

/// The exponent of an axis's step less that of a key unit.
#[inline(always)]
fn above_unit(record: &[u8; FRAME_BYTES], p: &KeyPoint, axis: usize) -> i32 {
    let exponent = record[boxes::FRAME_EXPONENTS + axis];
    i32::from(exponent).wrapping_sub(p.unit_exponent().cast_signed())
}

/// The bits by which planes are to be cut, so that their step is no finer than a key unit.
#[inline(always)]
fn bits_to_cut(record: &[u8; FRAME_BYTES], p: &KeyPoint, axis: usize) -> u32 {
    greater(0, lesser(-above_unit(record, p, axis), FINEST)).cast_unsigned()
}

/// Four planes, cut by up to seven bits.
#[inline(always)]
fn cut(by: u32, planes: [u8; 4]) -> [u8; 4] {
    ((u32::from_le_bytes(planes) >> by) & (0x0101_0101 * (0xFF >> by))).to_le_bytes()
}

/// All planes, cut. One by one: an array of zeros to write to would be a call of `memset`.
#[cold]
#[inline(never)]
fn cut_planes(record: &[u8; FRAME_BYTES], p: &KeyPoint, words: &PlaneWords) -> PlaneWords {
    let [a, b, c, d, e, f, g, h, i, j, k, l] = *words;
    let by = bits_to_cut(record, p, 0);
    let (a, b, c, d) = (cut(by, a), cut(by, b), cut(by, c), cut(by, d));
    let by = bits_to_cut(record, p, 1);
    let (e, f, g, h) = (cut(by, e), cut(by, f), cut(by, g), cut(by, h));
    let by = bits_to_cut(record, p, 2);
    let (i, j, k, l) = (cut(by, i), cut(by, j), cut(by, k), cut(by, l));
    [a, b, c, d, e, f, g, h, i, j, k, l]
}

/// Squared distances of the children from the point, in squares of key units.
#[inline(always)]
fn squares(record: &[u8; FRAME_BYTES], p: &KeyPoint, count: u32) -> [u32; WIDTH] {
    let (mut axes, is_fine, mut fine);
    let (words, _) = record.as_chunks::<4>();
    let Some(mut words) = words.first_chunk::<PLANE_WORDS>() else { return [ABSENT; WIDTH] };
    if cfg!(meshsweep_small) {
        // One way for all frames.
        (axes, is_fine) = any_axes(record, p);
        if is_fine {
            // Less code. Not a copy: that would be a call of `memcpy`, for which alone firmware
            // would link it. Of equal bytes it would be a call of `memclr` or `memset`.
            fine = [[0, 1, 2, 3]; PLANE_WORDS];
            for (at, (to, word)) in fine.iter_mut().zip(words).enumerate() {
                *to = cut(bits_to_cut(record, p, at >> 2 & 3), *word);
            }
            words = &fine;
        }
    } else if let Some(steps) = coarse_steps(record, p) {
        axes = [AxisPlanes::NONE; 3];
        set_coarse(&mut axes, record, p, steps);
    } else {
        (axes, _) = any_axes(record, p);
        fine = cut_planes(record, p, words);
        words = &fine;
    }
    let (Some(first), Some(second)) = (words.first_chunk(), words.last_chunk()) else {
        return [ABSENT; WIDTH];
    };
    let [a, b, c, d] = squares_of_four(first, &axes);
    let [e, f, g, h] = squares_of_four(second, &axes);
    let mut squares = [a, b, c, d, e, f, g, h];
    // Planes of absent children have no meaning. Small code does not look at them.
    let mut absent = if cfg!(meshsweep_small) { WIDTH } else { count as usize };
    while absent < WIDTH {
        // Of equal bytes the loop would become a call of `memset`.
        squares[absent & (WIDTH - 1)] = ABSENT;
        absent += 1;
    }
    squares
}

/// Keys of a node's children, as [`box_distances`](super::box_distances()) has them.
#[inline(never)]
pub(super) fn keys(
    record: &[u8; FRAME_BYTES],
    p: &KeyPoint,
    count: u32,
    parent: u32,
    keys: &mut [u32; WIDTH],
) {
    for (child, (key, square)) in (0..).zip(keys.iter_mut().zip(squares(record, p, count))) {
        let square = if cfg!(meshsweep_small) && child >= count { ABSENT } else { square };
        *key = key_of(square, parent, child);
    }
}

/// A child's key: at least that of its parent.
#[inline(always)]
fn key_of(square: u32, parent: u32, child: u32) -> u32 {
    let half = square >> 1;
    (if half > parent { half } else { parent }) & !CHILD_MASK | child
}

/// Pushes the wanted children of a node, without keys of the others.
#[inline(never)]
pub(super) fn push(
    record: &[u8; FRAME_BYTES],
    p: &KeyPoint,
    opened: &OpenedNode,
    slots: &mut [ScratchEntry; WIDTH],
) -> Pushed {
    let &OpenedNode { node, count, bound, limit } = opened;
    let mut pusher = Pusher::new(node, slots);
    let looked_at = if cfg!(meshsweep_small) { count } else { WIDTH as u32 };
    for (child, &square) in (0..looked_at).zip(&squares(record, p, count)) {
        // The limit's low bits are ones, so the key need not be made first.
        if square >> 1 <= limit {
            pusher.push(key_of(square, bound, child));
        }
    }
    pusher.finish()
}
