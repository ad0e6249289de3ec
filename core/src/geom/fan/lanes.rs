//! Lanes of the wide kernels.

#[cfg(meshsweep_wide)]
pub use vector::{LANES, Lanes, PIECES, lanes_below, least};

/// Most triangles of a leaf, most children of a node, and lanes of the wide kernels.
pub const WIDTH: usize = 8;

/// For each count, all ones in the lanes below it. A table of bits: the compiler would turn a
/// comparison of lanes into branches.
pub const LANES_BELOW: [[u32; WIDTH]; WIDTH + 1] = {
    let mut table = [[0; WIDTH]; WIDTH + 1];
    let mut count = 0;
    while count <= WIDTH {
        let mut lane = 0;
        while lane < count {
            table[count][lane] = u32::MAX;
            lane += 1;
        }
        count += 1;
    }
    table
};

#[cfg(meshsweep_wide)]
mod vector {
    use super::{LANES_BELOW, WIDTH};
    use crate::num::lesser;
    use wide::f32x4;

    /// A register's lanes. Where registers have 128 bits, a kernel looks at half of its lanes after
    /// the other half: eight lanes at once would not fit into the registers.
    #[cfg(target_feature = "avx")]
    pub type Lanes = wide::f32x8;

    /// A register's lanes.
    #[cfg(not(target_feature = "avx"))]
    pub type Lanes = f32x4;

    /// Lanes of a register.
    pub const LANES: usize = size_of::<Lanes>() / size_of::<f32>();

    /// Registers of eight lanes.
    pub const PIECES: usize = WIDTH / LANES;

    /// All ones in the lanes below `count`, which is at most eight.
    #[inline(always)]
    pub fn lanes_below(count: usize) -> Option<[Lanes; PIECES]> {
        Some(wide::bytemuck::cast(*LANES_BELOW.get(count)?))
    }

    /// The least of eight numbers.
    #[inline(always)]
    pub fn least(numbers: [Lanes; PIECES]) -> f32 {
        let [low, high]: [f32x4; 2] = wide::bytemuck::cast(numbers);
        let four = low.fast_min(high);
        let [_, _, c, d] = four.to_array();
        let [a, b, ..] = four.fast_min(f32x4::new([c, d, c, d])).to_array();
        lesser(a, b)
    }
}
