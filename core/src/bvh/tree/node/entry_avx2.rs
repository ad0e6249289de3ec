//! A segment against eight boxes, in registers of 256 bits. The keys are those of `entry_lanes`,
//! whose order of steps this file keeps.

use super::keys::{CHILD_MASK, NO_CHILD, OTHER_BITS};
use super::slab_ray::SlabRay;
use crate::bvh::tree::format::layout::{BOXES_BYTES, boxes};
use crate::geom::fan::WIDTH;
use core::arch::x86_64::*;
use wide::bytemuck::cast;

/// Where the steps are read from: 16 bytes up to the end of the record.
const STEPS: usize = BOXES_BYTES - 16;

/// Keys of a node's children, as [`box_entries`](super::box_entries()) has them.
#[target_feature(enable = "avx2")]
#[inline]
pub(crate) fn keys(
    record: &[u8; BOXES_BYTES],
    ray: &SlabRay,
    count: u32,
    parent_bound: f32,
    limit: f32,
) -> Option<[u32; WIDTH]> {
    // Eight rows, so that `& 7` needs no bounds check. Rows 6 and 7 are never chosen.
    let rows = record.as_chunks::<WIDTH>().0.first_chunk::<8>()?;
    let origin = four::<{ boxes::ORIGIN }>(record);
    let step = four::<STEPS>(record);
    let step = _mm_shuffle_ps::<0b11_11_10_01>(step, step);
    let (from, inverse, grow): (__m128, __m128, __m128) =
        (cast(ray.origin), cast(ray.inverse), cast(ray.grow));
    let from = _mm_sub_ps(origin, from);
    let from = _mm_sub_ps(from, _mm_mul_ps(step, _mm_set1_ps(128.0)));
    let start = _mm_mul_ps(from, inverse);
    let (enter, leave) = (_mm_sub_ps(start, grow), _mm_add_ps(start, grow));
    let step = _mm_mul_ps(step, inverse);
    let [nx, ny, nz] = ray.near;
    let (sx, sy, sz) = (splat::<0>(step), splat::<1>(step), splat::<2>(step));
    let place = |row: usize, step: __m256, start: __m256| {
        let bytes = _mm_cvtsi64_si128(i64::from_ne_bytes(rows[row & 7]));
        let planes = _mm256_cvtepi32_ps(_mm256_cvtepu8_epi32(bytes));
        _mm256_add_ps(_mm256_mul_ps(planes, step), start)
    };
    let first = _mm256_max_ps(
        _mm256_max_ps(_mm256_set1_ps(parent_bound), place(nz, sz, splat::<2>(enter))),
        _mm256_max_ps(place(ny, sy, splat::<1>(enter)), place(nx, sx, splat::<0>(enter))),
    );
    let last = _mm256_min_ps(
        _mm256_min_ps(_mm256_set1_ps(limit), place(nz ^ 1, sz, splat::<2>(leave))),
        _mm256_min_ps(place(ny ^ 1, sy, splat::<1>(leave)), place(nx ^ 1, sx, splat::<0>(leave))),
    );
    let entered = _mm256_cmp_ps::<_CMP_LE_OQ>(first, last);
    let bits: __m256 = cast(_mm256_set1_epi32(!CHILD_MASK.cast_signed()));
    let none: __m256 = cast(_mm256_set1_epi32(NO_CHILD.cast_signed()));
    let keys = _mm256_blendv_ps(none, _mm256_and_ps(first, bits), entered);
    let other_bits = OTHER_BITS.get(count as usize).unwrap_or(&OTHER_BITS[0]);
    Some(cast(_mm256_or_ps(keys, cast(*other_bits))))
}

/// Four numbers of the record, from byte `AT` on.
#[target_feature(enable = "avx2")]
#[inline]
fn four<const AT: usize>(record: &[u8; BOXES_BYTES]) -> __m128 {
    let bytes = record.get(AT..).and_then(|bytes| bytes.first_chunk::<16>());
    cast(bytes.copied().unwrap_or_default())
}

/// A register's number `LANE` in all lanes.
#[target_feature(enable = "avx2")]
#[inline]
fn splat<const LANE: i32>(numbers: __m128) -> __m256 {
    let number = match LANE {
        0 => numbers,
        1 => _mm_shuffle_ps::<0b01_01_01_01>(numbers, numbers),
        _ => _mm_shuffle_ps::<0b10_10_10_10>(numbers, numbers),
    };
    _mm256_broadcastss_ps(number)
}
