//! A point against eight boxes, and the least of their keys, in registers of 256 bits. The keys are
//! those of `box_lanes`, whose order of steps this file keeps.
//!
//! Only functions that are compiled for AVX2 can call these without `unsafe`. So the choice lies
//! where the processor is known.

use super::frame::{FRACTION_BITS, KeyPoint, MAX_DISTANCE, MAX_SHIFT, PRODUCT_BITS, ROUND_UP};
use super::keys::{CHILD_MASK, NO_CHILD, OTHER_BITS, TakenLeast};
use crate::bvh::tree::format::layout::{FRAME_BYTES, boxes};
use crate::geom::fan::WIDTH;
use core::arch::x86_64::*;
use wide::bytemuck::cast;

/// Binary exponent of the finest step of planes, in units of the products of matrix and
/// coordinates. A finer one counts as this, so that a plane comes less than one key unit too far
/// inward.
const LEAST_STEP: i32 = (PRODUCT_BITS - (MAX_SHIFT - 8)).cast_signed();

/// [`PRODUCT_BITS`], as shifts want it.
const PRODUCT_SHIFT: i32 = PRODUCT_BITS.cast_signed();

/// Where the rest of the frame is read from: 16 bytes up to the end of the record.
const REST: usize = FRAME_BYTES - 16;

/// Keys of a node's children: see `box_distances`.
#[target_feature(enable = "avx2")]
#[inline]
pub(crate) fn keys(
    record: &[u8; FRAME_BYTES],
    p: &KeyPoint,
    count: u32,
    parent: u32,
) -> [u32; WIDTH] {
    let frame = LaneFrame::of(record, p);
    let half = _mm256_srli_epi32::<1>(frame.distances_sq(record));
    let far = _mm256_max_epi32(half, _mm256_set1_epi32(parent.cast_signed()));
    let bounds = _mm256_and_si256(far, _mm256_set1_epi32(!CHILD_MASK.cast_signed()));
    // A count is at most eight. A greater one, of a tree that was not checked, has no child.
    let other_bits = OTHER_BITS.get(count as usize).unwrap_or(&OTHER_BITS[0]);
    cast(_mm256_or_si256(bounds, cast(*other_bits)))
}

/// Takes the least key of a block: see `keys::take_least`.
#[target_feature(enable = "avx2")]
#[inline]
pub(crate) fn take_least(keys: &[u32; WIDTH], limit: u32) -> TakenLeast {
    let keys: __m256i = cast(*keys);
    let (low, high) = (_mm256_castsi256_si128(keys), _mm256_extracti128_si256::<1>(keys));
    let four = _mm_min_epi32(low, high);
    let two = _mm_min_epi32(four, _mm_shuffle_epi32::<0b01_00_11_10>(four));
    let one = _mm_min_epi32(two, _mm_shuffle_epi32::<0b10_11_00_01>(two));
    let is_least = _mm256_cmpeq_epi32(keys, _mm256_broadcastd_epi32(one));
    let none = _mm256_set1_epi32(NO_CHILD.cast_signed());
    let rest = _mm256_blendv_epi8(keys, none, is_least);
    let beyond = _mm256_cmpgt_epi32(rest, _mm256_set1_epi32(limit.cast_signed()));
    TakenLeast {
        least: _mm_cvtsi128_si32(one).cast_unsigned(),
        rest: cast(rest),
        has_more: _mm256_movemask_epi8(beyond) != -1,
    }
}

/// A query point in a node's frame. Four axes, the last one empty, in the 32 bits of a half: a
/// number of 16 bits twice each.
struct LaneFrame {
    /// In the first 64 bits for the first planes, then for the last ones.
    from: __m256i,
    /// A plane's byte, as the high byte of 16 bits, times this: the high 16 bits are key units.
    plane_factor: __m256i,
}

impl LaneFrame {
    /// See `box_lanes`. Shifts lane by lane take the place of floats.
    #[target_feature(enable = "avx2")]
    #[inline]
    fn of(record: &[u8; FRAME_BYTES], p: &KeyPoint) -> LaneFrame {
        let unit_exponent = p.unit_exponent.cast_signed();
        let along = along(record, offset(record, p));
        let exponents = _mm_shuffle_epi8(rest(record), EXPONENTS.load());
        let exponents =
            _mm_add_epi32(exponents, _mm_set1_epi32(PRODUCT_SHIFT.wrapping_sub(unit_exponent)));
        // A negative exponent gives a step of 0, as it does when a float is cut.
        let step = _mm_sllv_epi32(_mm_set1_epi32(1), exponents);
        let least_step = _mm_set1_epi32(LEAST_STEP);
        let fine = _mm_cmpgt_epi32(least_step, exponents);
        let plane_exponents = _mm_max_epi32(exponents, least_step);
        let up = _mm_add_epi32(
            _mm_set1_epi32(ROUND_UP),
            _mm_and_si128(fine, _mm_set1_epi32(1 << PRODUCT_BITS)),
        );
        // Byte 128 lies at the origin, and 127 steps from it lies byte 255.
        let half = _mm_add_epi32(_mm_slli_epi32::<7>(step), up);
        let first = _mm_add_epi32(half, along);
        let last = _mm_sub_epi32(_mm_sub_epi32(half, step), along);
        let from = _mm_packs_epi32(
            _mm_srai_epi32::<PRODUCT_SHIFT>(first),
            _mm_srai_epi32::<PRODUCT_SHIFT>(last),
        );
        let last_plane =
            _mm_srli_epi32::<PRODUCT_SHIFT>(_mm_sllv_epi32(_mm_set1_epi32(255), plane_exponents));
        let least = _mm_sub_epi32(last_plane, _mm_set1_epi32(MAX_DISTANCE));
        // Greater numbers are cut to 2^15 − 1, beyond all planes.
        let from = _mm_max_epi16(from, _mm_packs_epi32(least, least));
        let factor = _mm_sllv_epi32(
            _mm_set1_epi32(1),
            _mm_sub_epi32(plane_exponents, _mm_set1_epi32(PRODUCT_SHIFT - 8)),
        );
        LaneFrame {
            from: _mm256_broadcastsi128_si256(from),
            plane_factor: _mm256_broadcastsi128_si256(_mm_packus_epi32(factor, factor)),
        }
    }

    /// Squared distances of the children, as numbers of 32 bits without a sign.
    #[target_feature(enable = "avx2")]
    #[inline]
    fn distances_sq(&self, record: &[u8; FRAME_BYTES]) -> __m256i {
        let LaneFrame { from, plane_factor } = *self;
        let (factor_xy, factor_zw) = (
            _mm256_shuffle_epi32::<0b00_00_00_00>(plane_factor),
            _mm256_shuffle_epi32::<0b01_01_01_01>(plane_factor),
        );
        let [x, y, z] = [sixteen::<0>(record), sixteen::<16>(record), sixteen::<32>(record)];
        // Planes of 8 bits less the point, or 0 where that is negative.
        let above = |bytes: __m128i, factor: __m256i, from: __m256i| {
            let high_bytes = _mm256_slli_epi16::<8>(_mm256_cvtepu8_epi16(bytes));
            let place = _mm256_mulhi_epu16(high_bytes, factor);
            _mm256_max_epi16(_mm256_sub_epi16(place, from), _mm256_setzero_si256())
        };
        let none = _mm_setzero_si128();
        // Of a box whose planes are in order at most one of both is above 0.
        let xy = _mm256_or_si256(
            above(_mm_unpacklo_epi8(x, y), factor_xy, _mm256_shuffle_epi32::<0b00_00_00_00>(from)),
            above(_mm_unpackhi_epi8(x, y), factor_xy, _mm256_shuffle_epi32::<0b10_10_10_10>(from)),
        );
        let zw = _mm256_or_si256(
            above(
                _mm_unpacklo_epi8(z, none),
                factor_zw,
                _mm256_shuffle_epi32::<0b01_01_01_01>(from),
            ),
            above(
                _mm_unpackhi_epi8(z, none),
                factor_zw,
                _mm256_shuffle_epi32::<0b11_11_11_11>(from),
            ),
        );
        _mm256_add_epi32(_mm256_madd_epi16(xy, xy), _mm256_madd_epi16(zw, zw))
    }
}

/// The offset of the point from the frame's origin, with [`FRACTION_BITS`] below the key unit.
#[target_feature(enable = "avx2")]
#[inline]
fn offset(record: &[u8; FRAME_BYTES], p: &KeyPoint) -> __m128i {
    let origin = _mm_shuffle_epi8(rest(record), ORIGIN.load());
    let origin = _mm_slli_epi32::<{ FRACTION_BITS.cast_signed() }>(origin);
    let unit = _mm_cvtsi32_si128((p.unit_exponent & 31).cast_signed());
    let [x, y, z] = p.at;
    _mm_sub_epi32(_mm_setr_epi32(x, y, z, 0), _mm_sra_epi32(origin, unit))
}

/// The products of the matrix and `offset`, which is cut into 15 low bits and the high ones.
#[target_feature(enable = "avx2")]
#[inline]
fn along(record: &[u8; FRAME_BYTES], offset: __m128i) -> __m128i {
    let rows = sixteen::<{ boxes::FRAME_ROWS }>(record);
    let first_two = _mm_shuffle_epi8(rows, FIRST_TWO.load());
    let third = _mm_shuffle_epi8(sixteen::<{ boxes::FRAME_ROWS + 2 }>(record), THIRD.load());
    let low = _mm_and_si128(offset, _mm_set1_epi32(0x7FFF));
    let parts = _mm_packs_epi32(low, _mm_srai_epi32::<15>(offset));
    let low = _mm_add_epi32(
        _mm_madd_epi16(first_two, _mm_shuffle_epi32::<0b00_00_00_00>(parts)),
        _mm_madd_epi16(third, _mm_shuffle_epi32::<0b01_01_01_01>(parts)),
    );
    let high = _mm_add_epi32(
        _mm_madd_epi16(first_two, _mm_shuffle_epi32::<0b10_10_10_10>(parts)),
        _mm_madd_epi16(third, _mm_shuffle_epi32::<0b11_11_11_11>(parts)),
    );
    _mm_add_epi32(_mm_slli_epi32::<15>(high), low)
}

/// Bytes to take out of sixteen, each into its place; 255 gives 0.
struct Bytes([u8; 16]);

impl Bytes {
    /// In each of four places `size` bytes that begin at `first`, then `apart` bytes later, and so
    /// on; nothing in the fourth.
    const fn three(first: usize, apart: usize, size: usize) -> Bytes {
        let mut bytes = [u8::MAX; 16];
        let mut axis = 0;
        while axis < 3 {
            let mut byte = 0;
            while byte < size {
                bytes[4 * axis + byte] = (first + apart * axis + byte) as u8;
                byte += 1;
            }
            axis += 1;
        }
        Bytes(bytes)
    }

    #[target_feature(enable = "avx2")]
    #[inline]
    fn load(&self) -> __m128i {
        cast(self.0)
    }
}

/// Of the matrix: the first two entries of each row.
const FIRST_TWO: Bytes = Bytes::three(0, 6, 4);
/// Of the matrix from its second entry on: the third entry of each row.
const THIRD: Bytes = Bytes::three(2, 6, 2);
/// Of the rest of the frame.
const ORIGIN: Bytes = Bytes::three(boxes::FRAME_ORIGIN - REST, 2, 2);
/// Of the rest of the frame.
const EXPONENTS: Bytes = Bytes::three(boxes::FRAME_EXPONENTS - REST, 1, 1);

#[target_feature(enable = "avx2")]
#[inline]
fn rest(record: &[u8; FRAME_BYTES]) -> __m128i {
    sixteen::<REST>(record)
}

/// Sixteen bytes of the record.
#[target_feature(enable = "avx2")]
#[inline]
fn sixteen<const AT: usize>(record: &[u8; FRAME_BYTES]) -> __m128i {
    const { assert!(AT + 16 <= FRAME_BYTES) };
    match record.get(AT..).and_then(|bytes| bytes.first_chunk::<16>()) {
        Some(bytes) => cast(*bytes),
        None => _mm_setzero_si128(),
    }
}
