//! Squared distances of a point from eight boxes, in vector registers. The keys are those of
//! `two_in_word`.
//!
//! The frame comes first, with the axes in the lanes of one register. Then come the boxes, with two
//! axes of a child side by side: one instruction squares both and adds the squares. A fourth axis
//! is empty. Its planes are all at byte 0, and the point lies between them.

use super::frame::{FRACTION_BITS, KeyPoint, MAX_DISTANCE, MAX_SHIFT, PRODUCT_BITS, ROUND_UP};
use super::keys::{CHILD_MASK, OTHER_BITS};
use crate::bvh::tree::format::layout::{FRAME_BYTES, boxes};
use crate::geom::fan::WIDTH;
use wide::bytemuck::cast;
use wide::{f32x4, i16x8, i32x4, i32x8, u8x16, u16x8, u32x8};

/// One number for each axis, repeated: x and y alternate in `xy`, z and the empty axis in `zw`.
struct AxisPairs {
    xy: i16x8,
    zw: i16x8,
}

impl AxisPairs {
    #[inline(always)]
    fn repeat(xy: i32, zw: i32) -> AxisPairs {
        AxisPairs { xy: cast(i32x4::splat(xy)), zw: cast(i32x4::splat(zw)) }
    }
}

/// A query point in a node's frame, ready for the boxes. See `axis_place`, which has one axis.
struct LaneFrame {
    from_first: AxisPairs,
    from_last: AxisPairs,
    /// A plane's byte, as the high byte of 16 bits, times this: the high 16 bits are key units.
    plane_factor: AxisPairs,
}

/// Keys of a node's children: see `box_distances`. `keys` stay if the count is more than eight.
#[inline(always)]
pub fn keys(
    record: &[u8; FRAME_BYTES],
    p: &KeyPoint,
    count: u32,
    parent: u32,
    keys: &mut [u32; WIDTH],
) {
    let rows = record.as_chunks::<WIDTH>().0.first_chunk::<6>();
    let (Some(rows), Some(frame), Some(&other_bits)) =
        (rows, LaneFrame::of(record, p), OTHER_BITS.get(count as usize))
    else {
        return;
    };
    let half: i32x8 = cast(cast::<_, u32x8>(frame.distances_sq(rows)) >> 1u32);
    let far = half.max(i32x8::splat(parent.cast_signed()));
    *keys = cast((far & i32x8::splat(!CHILD_MASK.cast_signed())) | cast::<_, i32x8>(other_bits));
}

/// A key unit in units of the products of matrix and coordinates.
const KEY_UNIT: f32 = (1 << PRODUCT_BITS) as f32;

/// The finest step of planes. A finer one counts as this, so that a plane comes less than one key
/// unit too far inward.
const LEAST_STEP: f32 = KEY_UNIT / (1 << (MAX_SHIFT - 8)) as f32;

impl LaneFrame {
    /// The steps of `axis_place`, for all axes at once.
    #[inline(always)]
    fn of(record: &[u8; FRAME_BYTES], p: &KeyPoint) -> Option<LaneFrame> {
        let along = along(record, offset(record, p)?)?;
        let exponents = word(record, boxes::FRAME_EXPONENTS)?;
        let exponents = u8x16::unpack_low(cast([exponents, 0, 0, 0]), u8x16::ZERO);
        // Powers of two are made as floats, because there are no shifts lane by lane.
        let bias = (127 + PRODUCT_BITS).wrapping_sub(p.unit_exponent).cast_signed();
        let step: f32x4 = cast((first_four(exponents) + i32x4::splat(bias)) << 23u32);
        let fine = step.simd_lt(f32x4::splat(LEAST_STEP));
        let plane_step = step.fast_max(f32x4::splat(LEAST_STEP));
        let step = step.fast_trunc_int();
        let up =
            i32x4::splat(ROUND_UP) + (cast::<_, i32x4>(fine) & i32x4::splat(1 << PRODUCT_BITS));
        // Byte 128 lies at the origin, and 127 steps from it lies byte 255.
        let half = (step << 7u32) + up;
        let from = [half + along, half - step - along].map(|x| x >> PRODUCT_BITS);
        let last_plane = (plane_step * f32x4::splat(255.0 / KEY_UNIT)).fast_trunc_int();
        let least = last_plane - i32x4::splat(MAX_DISTANCE);
        // Greater numbers are cut to 2^15 − 1, beyond all planes.
        let from: [i32; 4] = cast(shorts(from).max(shorts([least; 2])));
        // Negative, because 2^15 would be cut.
        let plane_factor = (plane_step * f32x4::splat(-256.0 / KEY_UNIT)).fast_trunc_int();
        let plane_factor: [i32; 4] = cast(i16x8::ZERO - shorts([plane_factor; 2]));
        Some(LaneFrame {
            from_first: AxisPairs::repeat(from[0], from[1]),
            from_last: AxisPairs::repeat(from[2], from[3]),
            plane_factor: AxisPairs::repeat(plane_factor[0], plane_factor[1]),
        })
    }

    /// Squared distances of the children, as numbers of 32 bits without a sign. Rows of bytes:
    /// first and last planes of the first axis, of the second, of the third.
    #[inline(always)]
    fn distances_sq(&self, [lx, hx, ly, hy, lz, hz]: &[[u8; WIDTH]; 6]) -> i32x8 {
        let [lx, hx, ly, hy, lz, hz] =
            [lx, hx, ly, hy, lz, hz].map(|row| -> u8x16 { cast([u64::from_ne_bytes(*row), 0]) });
        let (first_xy, last_xy) = (u8x16::unpack_low(lx, ly), u8x16::unpack_low(hx, hy));
        let (first_zw, last_zw) =
            (u8x16::unpack_low(lz, u8x16::ZERO), u8x16::unpack_low(hz, u8x16::ZERO));
        let LaneFrame { from_first, from_last, plane_factor } = self;
        let place = |bytes: u8x16, factor: i16x8| -> i16x8 {
            cast(cast::<_, u16x8>(bytes).mul_keep_high(cast(factor)))
        };
        // Bytes that come behind zeros are the high ones of 16 bits.
        let four = |half: fn(u8x16, u8x16) -> u8x16| {
            let below_xy = place(half(u8x16::ZERO, first_xy), plane_factor.xy) - from_first.xy;
            let below_zw = place(half(u8x16::ZERO, first_zw), plane_factor.zw) - from_first.zw;
            let beyond_xy = place(half(u8x16::ZERO, last_xy), plane_factor.xy) - from_last.xy;
            let beyond_zw = place(half(u8x16::ZERO, last_zw), plane_factor.zw) - from_last.zw;
            // Of a box whose planes are in order at most one of both is above 0.
            let xy = below_xy.max(i16x8::ZERO) | beyond_xy.max(i16x8::ZERO);
            let zw = below_zw.max(i16x8::ZERO) | beyond_zw.max(i16x8::ZERO);
            xy.dot(xy) + zw.dot(zw)
        };
        cast([four(u8x16::unpack_low), four(u8x16::unpack_high)])
    }
}

/// The offset of the point from the frame's origin, with [`FRACTION_BITS`] below the key unit. The
/// fourth lane may be any number.
#[inline(always)]
fn offset(record: &[u8; FRAME_BYTES], p: &KeyPoint) -> Option<i32x4> {
    let origin = u64::from_le_bytes(*record.get(boxes::FRAME_ORIGIN..)?.first_chunk::<8>()?);
    let origin = first_four(cast([origin, 0])) << FRACTION_BITS;
    let [x, y, z] = p.at;
    Some(i32x4::new([x, y, z, p.unit_exponent.cast_signed()]) - (origin >> (p.unit_exponent & 31)))
}

/// The products of the matrix and `offset`.
///
/// The instruction multiplies 16 bits and adds neighbours. So `offset` is cut into 15 low bits
/// and the high ones, and each row into its first two entries, and its third with a 0.
#[inline(always)]
fn along(record: &[u8; FRAME_BYTES], offset: i32x4) -> Option<i32x4> {
    let row = |axis: usize| boxes::FRAME_ROWS + 6 * axis;
    let entries = |at: usize| -> Option<i16x8> {
        let words = [word(record, row(0) + at)?, word(record, row(1) + at)?];
        Some(cast([words[0], words[1], word(record, row(2) + at)?, 0]))
    };
    let (first_two, third) = (entries(0)?, entries(4)? & cast::<_, i16x8>(i32x4::splat(0xFFFF)));
    let low = offset & i32x4::splat(0x7FFF);
    let [low_xy, low_z, high_xy, high_z]: [i32; 4] = cast(shorts([low, offset >> 15u32]));
    let sums =
        |xy: i32, z: i32| first_two.dot(cast(i32x4::splat(xy))) + third.dot(cast(i32x4::splat(z)));
    Some((sums(high_xy, high_z) << 15u32) + sums(low_xy, low_z))
}

/// Four bytes of the record.
#[inline(always)]
fn word(record: &[u8; FRAME_BYTES], at: usize) -> Option<i32> {
    Some(i32::from_le_bytes(*record.get(at..)?.first_chunk::<4>()?))
}

/// The first four of eight numbers without a sign.
#[inline(always)]
fn first_four(numbers: u8x16) -> i32x4 {
    let [first, _]: [i32x4; 2] = cast(i32x8::from_u16x8(cast(numbers)));
    first
}

/// Numbers cut to 16 bits, with their sign.
#[inline(always)]
fn shorts(numbers: [i32x4; 2]) -> i16x8 {
    i16x8::from_i32x8_saturate(cast(numbers))
}
