//! Keys of the children of a node: a bound, and the number of the child in its low bits.
//!
//! Keys are integers below 2^31 that compare as their bounds do: squares of integers, or the bits
//! of an f32 that is not negative.

use crate::geom::fan::WIDTH;

/// The low bits of a key hold the number of the child.
pub const CHILD_MASK: u32 = WIDTH as u32 - 1;

/// Key where a node has no child: above every bound.
pub const NO_CHILD: u32 = 0x7F00_0000;

/// Whether the target computes all eight children at once, in vector registers.
pub const WIDE: bool = cfg!(meshsweep_wide);

/// The least key. Its low bits hold the number of the nearest child.
#[cfg(not(meshsweep_wide))]
#[inline(always)]
pub fn least_key(keys: &[u32; WIDTH]) -> u32 {
    keys.iter().fold(NO_CHILD, |least, &key| least.min(key))
}

/// The same numbers, forced into memory. Otherwise the compiler undoes the vectorisation: it
/// computes values one by one if they are used one by one.
#[inline(always)]
pub fn in_memory<T>(numbers: T) -> T {
    core::hint::black_box(numbers)
}

#[cfg(meshsweep_wide)]
pub(super) use vector::OTHER_BITS;
#[cfg(meshsweep_wide)]
pub use vector::{TakenLeast, least_key, places_of_wanted, take_least};

#[cfg(meshsweep_wide)]
mod vector {
    use super::{NO_CHILD, WIDTH};
    use wide::bytemuck::cast;
    use wide::{i8x16, i16x8, i32x4, i32x8};

    /// The bits that each key has besides its bound, by child count: the child's number, and from
    /// the count on [`NO_CHILD`].
    pub(crate) const OTHER_BITS: [[u32; WIDTH]; WIDTH + 1] = {
        let mut table = [[0; WIDTH]; WIDTH + 1];
        let mut count = 0;
        while count <= WIDTH {
            let mut child = 0;
            while child < WIDTH {
                table[count][child] = child as u32 | if child < count { 0 } else { NO_CHILD };
                child += 1;
            }
            count += 1;
        }
        table
    };

    /// The least key of a block, and the block without it.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub struct TakenLeast {
        /// The least key. Its low bits hold the number of the nearest child.
        pub least: u32,
        /// The other keys, in their places, and [`NO_CHILD`] in the place of the least.
        pub rest: [u32; WIDTH],
        /// Whether another key is up to the limit.
        pub has_more: bool,
    }

    /// Takes the least key of a block.
    #[inline(always)]
    pub fn take_least(keys: &[u32; WIDTH], limit: u32) -> TakenLeast {
        let least = least_key(keys);
        let keys: i32x8 = cast(*keys);
        let is_least = keys.simd_eq(i32x8::splat(least.cast_signed()));
        let rest = is_least.select(i32x8::splat(NO_CHILD.cast_signed()), keys);
        let has_more = !rest.simd_gt(i32x8::splat(limit.cast_signed())).all();
        TakenLeast { least, rest: cast(rest), has_more }
    }

    /// The least key. Its low bits hold the number of the nearest child.
    #[inline(always)]
    pub fn least_key(keys: &[u32; WIDTH]) -> u32 {
        let [low, high]: [i32x4; 2] = cast(*keys);
        let four = low.min(high);
        let [low, high]: [u64; 2] = cast(four);
        let two = four.min(cast([high, low]));
        // In the register to the last: numbers taken out one by one would come later.
        let [a, b, c, d] = two.to_array();
        let [least, ..] = two.min(i32x4::new([b, a, d, c])).to_array();
        least.cast_unsigned()
    }

    /// For each child, in a byte, how many wanted children come before it; and how many there are
    /// in all. Wanted are keys up to `limit`, except `nearest`.
    #[inline(always)]
    pub fn places_of_wanted(keys: &[u32; WIDTH], nearest: u32, limit: u32) -> (u64, usize) {
        let keys: i32x8 = cast(*keys);
        let [limit, nearest] = [limit, nearest].map(u32::cast_signed);
        let unwanted = keys.simd_gt(i32x8::splat(limit)) | keys.simd_eq(i32x8::splat(nearest));
        let shorts = i16x8::from_i32x8_saturate(unwanted);
        let [unwanted, _]: [u64; 2] = cast(i8x16::from_i16x16_saturate(cast([shorts; 2])));
        // Byte i is the sum of the bytes up to i.
        const ONES: u64 = 0x0101_0101_0101_0101;
        let sums = (!unwanted & ONES).wrapping_mul(ONES);
        (sums << 8, (sums >> 56) as usize)
    }
}
