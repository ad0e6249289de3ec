//! Squared distances of a point from eight boxes, in integers.
//!
//! The wide form (`box_lanes`) has eight 16-bit lanes, which fit one register of the smallest
//! vector units. The narrow form goes axis by axis. Both give the same keys.

#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
use super::box_lanes;
use super::key_point::KeyPoint;
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
) -> [u32; WIDTH] {
    #[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
    return box_lanes::keys(record, p, count, parent);
    #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
    return narrow::keys(record, p, count, parent);
}

/// Rows of bytes: first and last planes of the first axis, of the second, of the third. A last
/// plane is counted from the frame's end.
pub(super) type Rows = [[u8; WIDTH]; 6];

#[cfg(any(test, not(any(target_arch = "x86_64", target_arch = "aarch64"))))]
pub(super) mod narrow {
    use super::{FRAME_BYTES, KeyPoint, Rows, WIDTH};
    use crate::bvh::node::frame::NodeFrame;
    use crate::bvh::node::keys::{CHILD_MASK, NO_CHILD};
    use crate::num::greater;

    /// The key of a child from its squared distance.
    #[inline(always)]
    fn key(distance_sq: u32, parent: u32, child: u32) -> u32 {
        let (half, parent) = ((distance_sq >> 1).cast_signed(), parent.cast_signed());
        let far = if half > parent { half } else { parent };
        far.cast_unsigned() & !CHILD_MASK | child
    }

    #[inline(always)]
    pub fn keys(record: &[u8; FRAME_BYTES], p: &KeyPoint, count: u32, parent: u32) -> [u32; WIDTH] {
        let mut keys = [NO_CHILD; WIDTH];
        let frame = NodeFrame::of(record, p);
        let Some(rows) = record.as_chunks::<WIDTH>().0.first_chunk::<6>() else { return keys };
        let mut sum = [0u32; WIDTH];
        let [lx, hx, ly, hy, lz, hz]: &Rows = rows;
        let NodeFrame { from: [x, y, z], shift: [sx, sy, sz] } = frame;
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
}
