//! Keys of the children of a node: a bound, and the number of the child in its low bits.
//!
//! Keys are integers below 2^31 that compare as their bounds do: squares of integers, or the bits
//! of an f32 that is not negative.

use crate::geom::fan::WIDTH;
use crate::num::{lesser, of_eight};

/// The low bits of a key hold the number of the child.
pub const CHILD_MASK: u32 = WIDTH as u32 - 1;

/// Key where a node has no child: above every bound.
pub const NO_CHILD: u32 = 0x7F00_0000;

/// Whether the target has vector registers, so that unwanted children cost nothing.
pub const WIDE: bool = cfg!(any(target_arch = "x86_64", target_arch = "aarch64"));

/// The least key. Its low bits hold the number of the nearest child.
#[inline(always)]
pub fn least_key(keys: &[u32; WIDTH]) -> u32 {
    if !WIDE {
        return keys.iter().fold(NO_CHILD, |least, &key| least.min(key));
    }
    of_eight(keys.map(u32::cast_signed), lesser).cast_unsigned()
}

/// The same numbers, forced into memory. Otherwise the compiler undoes the vectorisation: it
/// computes values one by one if they are used one by one.
#[inline(always)]
pub fn in_memory<T>(numbers: T) -> T {
    core::hint::black_box(numbers)
}
