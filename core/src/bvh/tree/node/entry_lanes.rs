//! A segment against eight boxes, in vector registers. The three axes of the planes' origin and
//! step are lanes of one register, then the eight boxes are.

use super::keys::{CHILD_MASK, NO_CHILD, OTHER_BITS};
use super::slab_ray::SlabRay;
use crate::bvh::tree::format::layout::{BOXES_BYTES, boxes};
use crate::geom::fan::WIDTH;
use wide::bytemuck::cast;
use wide::{f32x4, f32x8, i32x8, u8x16};

/// Keys of a node's children, as [`box_entries`](super::box_entries()) has them.
#[inline(always)]
pub(super) fn keys(
    record: &[u8; BOXES_BYTES],
    ray: &SlabRay,
    count: u32,
    parent_bound: f32,
    limit: f32,
) -> Option<[u32; WIDTH]> {
    // Eight rows, so that `& 7` needs no bounds check. Rows 6 and 7 are never chosen.
    let rows = record.as_chunks::<WIDTH>().0.first_chunk::<8>()?;
    let words = record.as_chunks::<4>().0.get(boxes::ORIGIN / 4..)?.first_chunk::<6>()?;
    let [ox, oy, oz, ux, uy, uz] = words.map(f32::from_le_bytes);
    let (origin, step) = (f32x4::new([ox, oy, oz, ux]), f32x4::new([ux, uy, uz, uz]));
    let start = ((origin - ray.origin) - step * f32x4::splat(128.0)) * ray.inverse;
    let (enter, leave) = ((start - ray.grow).to_array(), (start + ray.grow).to_array());
    let step = (step * ray.inverse).to_array();
    let place = |row: usize, axis: usize, start: f32| {
        floats(&rows[row & 7]) * f32x8::splat(step[axis]) + f32x8::splat(start)
    };
    let [nx, ny, nz] = ray.near;
    let (ex, ey, ez) = (place(nx, 0, enter[0]), place(ny, 1, enter[1]), place(nz, 2, enter[2]));
    let lx = place(nx ^ 1, 0, leave[0]);
    let (ly, lz) = (place(ny ^ 1, 1, leave[1]), place(nz ^ 1, 2, leave[2]));
    let first = f32x8::splat(parent_bound).fast_max(ez).fast_max(ey.fast_max(ex));
    let last = f32x8::splat(limit).fast_min(lz).fast_min(ly.fast_min(lx));
    let entered: i32x8 = cast(first.simd_le(last));
    let bits = cast::<_, i32x8>(first) & i32x8::splat(!CHILD_MASK.cast_signed());
    let keys = entered.select(bits, i32x8::splat(NO_CHILD.cast_signed()));
    // The box of an absent child may be any. A count above eight, of a tree that was not checked,
    // has no child.
    let other_bits = OTHER_BITS.get(count as usize).unwrap_or(&OTHER_BITS[0]);
    Some(cast(keys | cast::<_, i32x8>(*other_bits)))
}

/// Eight bytes as floats.
#[inline(always)]
fn floats(row: &[u8; WIDTH]) -> f32x8 {
    let bytes: u8x16 = cast([u64::from_ne_bytes(*row), 0]);
    i32x8::from_u16x8(cast(u8x16::unpack_low(bytes, u8x16::ZERO))).round_float()
}
