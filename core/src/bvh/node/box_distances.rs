//! Squared distances of a point from eight boxes, in integers.
//!
//! The wide form (`lanes`) has eight 16-bit lanes, which fit one register of the smallest vector
//! units. Other processors take two children in a word (`pairs`). Both give the same keys.

use super::frame::KeyPoint;
use crate::bvh::format::layout::FRAME_BYTES;
use crate::geom::fan::WIDTH;

/// Keys of a node's children: half the squared distances from the point, in squares of key units.
/// No key is below the parent's, and the low three bits hold the number of the child. Keys from
/// `count` on are [`NO_CHILD`](super::NO_CHILD) or more.
///
/// The key without its low bits is a lower bound.
#[inline(always)]
pub fn box_distances(
    record: &[u8; FRAME_BYTES],
    p: &KeyPoint,
    count: u32,
    parent: u32,
    keys: &mut [u32; WIDTH],
) {
    #[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
    lanes::keys(record, p, count, parent, keys);
    #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
    super::pairs::keys(record, p, count, parent, keys);
}

/// Eight 16-bit lanes, written with vector types: of plain loops a compiler makes twice the
/// instructions.
#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
pub(crate) mod lanes {
    use super::{FRAME_BYTES, KeyPoint, WIDTH};
    use crate::bvh::node::frame::NodeFrame;
    use crate::bvh::node::keys::{CHILD_MASK, NO_CHILD};
    use crate::geom::fan::LANES_BELOW;
    use wide::bytemuck::cast;
    use wide::{i16x8, i32x8, u8x16, u16x8, u32x8};

    #[inline(always)]
    pub(crate) fn keys(
        record: &[u8; FRAME_BYTES],
        p: &KeyPoint,
        count: u32,
        parent: u32,
        keys: &mut [u32; WIDTH],
    ) {
        // First and last planes of the first axis, of the second, of the third.
        let Some(rows) = record.as_chunks::<WIDTH>().0.first_chunk::<6>() else { return };
        let frame = NodeFrame::of(record, p);
        let [lx, hx, ly, hy, lz, hz] = rows;
        let x = outside(lx, hx, frame.from[0], frame.shift[0]);
        let y = outside(ly, hy, frame.from[1], frame.shift[1]);
        let z = outside(lz, hz, frame.from[2], frame.shift[2]);
        let sum = x.widening_mul(x) + y.widening_mul(y) + z.widening_mul(z);
        let half: i32x8 = cast(cast::<_, u32x8>(sum) >> 1u32);
        let far = half.max(i32x8::splat(parent.cast_signed()));
        let Some(&used) = LANES_BELOW.get(count as usize) else { return };
        let used: i32x8 = cast(used);
        let none = i32x8::splat(NO_CHILD.cast_signed());
        let mask = i32x8::splat(!CHILD_MASK.cast_signed());
        *keys = cast((far & mask & used) | (none & !used) | i32x8::new([0, 1, 2, 3, 4, 5, 6, 7]));
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
        // Of a box whose planes are in order at most one of them is above 0.
        below.max(i16x8::ZERO) | beyond.max(i16x8::ZERO)
    }
}
