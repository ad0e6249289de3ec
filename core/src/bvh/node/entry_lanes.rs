//! A segment against eight boxes, in vector registers.

use super::keys::{CHILD_MASK, NO_CHILD};
use super::slab_ray::{Axis, SlabPlanes};
use crate::geom::fan::WIDTH;
use wide::bytemuck::cast;
use wide::{f32x8, i32x8, u8x16};

/// Eight bytes as floats.
#[inline(always)]
fn floats(row: &[u8; WIDTH]) -> f32x8 {
    let bytes: u8x16 = cast([u64::from_ne_bytes(*row), 0]);
    i32x8::from_u16x8(cast(u8x16::unpack_low(bytes, u8x16::ZERO))).round_float()
}

#[inline(always)]
fn enter(axis: &Axis<'_>) -> f32x8 {
    floats(axis.near) * f32x8::splat(axis.step) + f32x8::splat(axis.enter)
}

#[inline(always)]
fn leave(axis: &Axis<'_>) -> f32x8 {
    floats(axis.far) * f32x8::splat(axis.step) + f32x8::splat(axis.leave)
}

/// Keys of a node's children, as [`box_entries`](super::box_entries()) has them.
#[inline(always)]
pub(super) fn keys(
    SlabPlanes([x, y, z]): &SlabPlanes<'_>,
    count: u32,
    parent_bound: f32,
    limit: f32,
) -> [u32; WIDTH] {
    let first = f32x8::splat(parent_bound).fast_max(enter(z)).fast_max(enter(y).fast_max(enter(x)));
    let last = f32x8::splat(limit).fast_min(leave(z)).fast_min(leave(y).fast_min(leave(x)));
    let entered: i32x8 = cast(first.simd_le(last));
    let bits = cast::<_, i32x8>(first) & i32x8::splat(!CHILD_MASK.cast_signed());
    let keys = entered.select(bits, i32x8::splat(NO_CHILD.cast_signed()));
    // The box of an absent child may be any.
    let absent: i32x8 = cast(ABSENT[(count & 15) as usize]);
    cast(keys.max(absent) | i32x8::new([0, 1, 2, 3, 4, 5, 6, 7]))
}

/// For each count of children, the least keys.
const ABSENT: [[u32; WIDTH]; 16] = {
    let mut table = [[0; WIDTH]; 16];
    let mut count = 0;
    while count < 16 {
        let mut child = count;
        while child < WIDTH {
            table[count][child] = NO_CHILD;
            child += 1;
        }
        count += 1;
    }
    table
};
