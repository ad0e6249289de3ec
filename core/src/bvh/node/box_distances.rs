//! Squared distances of a point from eight boxes, in integers.
//!
//! The wide form (`lanes`) has eight 16-bit lanes, which fit one register of the smallest vector
//! units. The narrow form goes axis by axis. Both give the same keys.

use super::frame::NodeFrame;
use super::keys::{CHILD_MASK, NO_CHILD};
use crate::bvh::format::layout::FRAME_BYTES;
use crate::geom::fan::WIDTH;
#[cfg(any(test, not(any(target_arch = "x86_64", target_arch = "aarch64"))))]
use crate::num::greater;

/// Keys of a node's children: half the squared distances from the point, in squares of key units.
/// No key is below the parent's, and the low three bits hold the number of the child. Keys from
/// `count` on are [`NO_CHILD`] or more.
///
/// The key without its low bits is a lower bound.
#[inline(always)]
pub fn box_distances(
    record: &[u8; FRAME_BYTES],
    frame: &NodeFrame,
    count: u32,
    parent: u32,
) -> [u32; WIDTH] {
    let (rows, _) = record.as_chunks::<WIDTH>();
    let Some(rows) = rows.first_chunk::<6>() else { return [NO_CHILD; WIDTH] };
    #[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
    return lanes::keys(rows, frame, count, parent);
    #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
    return narrow(rows, frame, count, parent);
}

/// Rows of bytes: first and last planes of the first axis, of the second, of the third. A last
/// plane is counted from the frame's end.
type Rows = [[u8; WIDTH]; 6];

/// Eight 16-bit lanes, written with vector types: of plain loops a compiler makes twice the
/// instructions.
#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
pub(crate) mod lanes {
    use super::{CHILD_MASK, NO_CHILD, NodeFrame, Rows, WIDTH};
    use crate::geom::fan::LANES_BELOW;
    use wide::bytemuck::cast;
    use wide::{i16x8, i32x8, u8x16, u16x8, u32x8};

    #[inline(always)]
    pub(crate) fn keys(rows: &Rows, frame: &NodeFrame, count: u32, parent: u32) -> [u32; WIDTH] {
        let [lx, hx, ly, hy, lz, hz] = rows;
        let x = outside(lx, hx, frame.from[0], frame.shift[0]);
        let y = outside(ly, hy, frame.from[1], frame.shift[1]);
        let z = outside(lz, hz, frame.from[2], frame.shift[2]);
        let sum = x.widening_mul(x) + y.widening_mul(y) + z.widening_mul(z);
        let half: i32x8 = cast(cast::<_, u32x8>(sum) >> 1u32);
        let far = half.max(i32x8::splat(parent.cast_signed()));
        let Some(&used) = LANES_BELOW.get(count as usize) else { return [NO_CHILD; WIDTH] };
        let used: i32x8 = cast(used);
        let none = i32x8::splat(NO_CHILD.cast_signed());
        let mask = i32x8::splat(!CHILD_MASK.cast_signed());
        let keys = (far & mask & used) | (none & !used) | i32x8::new([0, 1, 2, 3, 4, 5, 6, 7]);
        cast(keys)
    }

    /// Distances along one axis.
    #[inline(always)]
    fn outside(first: &[u8; WIDTH], last: &[u8; WIDTH], from: [i32; 2], shift: u32) -> i16x8 {
        // A plane is never beyond this, so a greater number would say no more.
        let [from_first, from_last] = from.map(|from| from.min(i32::from(i16::MAX)) as i16);
        let place = |row: &[u8; WIDTH]| -> i16x8 {
            let bytes: u8x16 = cast([u64::from_ne_bytes(*row), 0]);
            // Each byte becomes the high one of 16 bits.
            cast(cast::<_, u16x8>(u8x16::unpack_low(u8x16::ZERO, bytes)) >> (shift & 15))
        };
        let below = place(first) - i16x8::splat(from_first);
        let beyond = place(last) - i16x8::splat(from_last);
        below.max(beyond).max(i16x8::ZERO)
    }
}

/// The key of a child from its squared distance.
#[cfg(any(test, not(any(target_arch = "x86_64", target_arch = "aarch64"))))]
#[inline(always)]
fn key(distance_sq: u32, parent: u32, child: u32) -> u32 {
    let (half, parent) = ((distance_sq >> 1).cast_signed(), parent.cast_signed());
    let far = if half > parent { half } else { parent };
    far.cast_unsigned() & !CHILD_MASK | child
}

#[cfg(any(test, not(any(target_arch = "x86_64", target_arch = "aarch64"))))]
#[inline(always)]
pub(crate) fn narrow(rows: &Rows, frame: &NodeFrame, count: u32, parent: u32) -> [u32; WIDTH] {
    let mut keys = [NO_CHILD; WIDTH];
    let mut sum = [0u32; WIDTH];
    let [lx, hx, ly, hy, lz, hz] = rows;
    let NodeFrame { from: [x, y, z], shift: [sx, sy, sz] } = *frame;
    let (used, _) = sum.split_at_mut((count as usize).min(WIDTH));
    add_along(lx, hx, x, sx, used);
    add_along(ly, hy, y, sy, used);
    add_along(lz, hz, z, sz, used);
    for (child, (slot, sum)) in (0u32..).zip(keys.iter_mut().zip(used)) {
        *slot = key(*sum, parent, child);
    }
    keys
}

/// Adds the squared distances along one axis.
#[cfg(any(test, not(any(target_arch = "x86_64", target_arch = "aarch64"))))]
#[inline(never)]
fn add_along(
    first: &[u8; WIDTH],
    last: &[u8; WIDTH],
    [from_first, from_last]: [i32; 2],
    shift: u32,
    sums: &mut [u32],
) {
    let shift = shift & 31;
    let far = |byte: u8, from: i32| ((i32::from(byte) << 8) >> shift).wrapping_sub(from);
    let square = |far: i32| far.wrapping_mul(far).cast_unsigned();
    // Before the first plane or behind the last one, a point is outside of all boxes.
    let (row, from) = if from_first <= 0 { (first, from_first) } else { (last, from_last) };
    if from <= 0 {
        for (sum, &byte) in sums.iter_mut().zip(row) {
            *sum = sum.wrapping_add(square(far(byte, from)));
        }
        return;
    }
    for ((sum, &first), &last) in sums.iter_mut().zip(first).zip(last) {
        let (below, beyond) = (far(first, from_first), far(last, from_last));
        // Of a box whose planes are in order at most one of them is above 0.
        let far = greater(below, beyond);
        if far > 0 {
            *sum = sum.wrapping_add(square(far));
        }
    }
}
