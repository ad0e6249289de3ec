//! Keys of the children of a node: a bound, and the lane in its low bits.

use crate::geom::fan::WIDTH;
use crate::num::{lesser, of_eight};

/// The low bits of a key hold its lane.
pub const LANE_MASK: u32 = WIDTH as u32 - 1;

/// Key of a lane without a child: above every bound.
pub const NO_CHILD: f32 = f32::from_bits(0x7F00_0000);

/// Whether the target has vector registers, so that unwanted lanes cost nothing.
pub const WIDE: bool = cfg!(any(target_arch = "x86_64", target_arch = "aarch64"));

/// The least key. Its low bits hold the nearest lane.
#[inline(always)]
pub fn nearest_lane(keys: &[f32; WIDTH]) -> f32 {
    if !WIDE {
        let least = keys.iter().fold(NO_CHILD.to_bits(), |least, key| least.min(key.to_bits()));
        return f32::from_bits(least);
    }
    of_eight(*keys, lesser)
}

/// The same lanes, forced into memory. Otherwise the compiler undoes the vectorisation: it computes
/// values lane by lane if they are used lane by lane.
#[inline(always)]
pub fn in_memory<T>(lanes: T) -> T {
    core::hint::black_box(lanes)
}
