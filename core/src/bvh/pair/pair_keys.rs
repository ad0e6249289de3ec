//! Lower bounds of the distances of all pairs of children of two nodes, or of triangles of leaves.
//!
//! Boxes are intervals along the axes of both models. The gaps along the three axes of one model
//! form a vector, and its length is a lower bound of the distance. The greater of the two bounds
//! counts. Derivation: `core/docs/rounding.md` §18.

use crate::bvh::tree::axis_intervals::AxisIntervals;
use crate::bvh::tree::node::WIDE;
use crate::bvh::tree::stored_lengths::root_of_bound;
use crate::geom::fan::WIDTH;
use crate::num::greater;
use crate::num::tolerance::{LEAST_STRETCH, U32};
use crate::query::{DIRECTIONS, RelativePose};

/// Pairs of children of two nodes.
pub(crate) const PAIRS: usize = WIDTH * WIDTH;

/// The low bits of a key: the number of the pair, eight times the child of the first node and the
/// child of the second.
const PAIR_MASK: u32 = PAIRS as u32 - 1;

/// Key of no pair, above every bound. Like every key it fits an i32: vectors without unsigned
/// comparison compare keys as signed numbers.
pub(crate) const NO_PAIR: u32 = i32::MAX.cast_unsigned();

/// Bounds of the squared distances of pairs, as the bits of an f32, cut to make room for the
/// number of the pair. A bound that is cut is lower, so it is still a lower bound.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PairKeys(pub(crate) [u32; PAIRS]);

/// The key of a bound.
#[inline(always)]
pub(crate) fn key_of(bound_sq: f32, pair: u32) -> u32 {
    bound_sq.to_bits() & !PAIR_MASK | pair
}

/// The greatest key of a bound that is not above the limit.
#[inline(always)]
pub(crate) fn key_limit(limit_sq: f32) -> u32 {
    limit_sq.to_bits() | PAIR_MASK
}

/// The squared bound in a key.
#[inline(always)]
pub(crate) fn bound_sq_of(key: u32) -> f32 {
    f32::from_bits(key & !PAIR_MASK)
}

/// The indices of a pair: in the first node or leaf, and in the second.
#[inline(always)]
pub(crate) fn indices_of(key: u32) -> [u32; 2] {
    [key >> 3 & 7, key & 7]
}

/// The bit of a pair in [`ChildPairs`](super::skipped::ChildPairs).
#[inline(always)]
pub(crate) fn pair_bit(key: u32) -> u64 {
    1 << (key & PAIR_MASK)
}

/// Lower bound of a distance, from the key of a pair of boxes, common units.
pub(crate) fn distance_of(key: u32) -> f64 {
    root_of_bound(bound_sq_of(key))
}

/// Squared gaps along the second model's axes are multiplied by this. Its axes are longer by the
/// stretch of the pose's matrix.
pub(crate) fn second_factor(pose: &RelativePose) -> f32 {
    let [_, unit] = pose.vertices.units;
    let stretch = pose.vertices.longest / f64::from(unit);
    if stretch < LEAST_STRETCH {
        return 0.0;
    }
    (1.0 / (stretch * stretch)) as f32 * (1.0 - 4.0 * U32)
}

impl PairKeys {
    /// The keys of the pairs `wanted`: a byte for each child of the first node, a bit in it for
    /// each child of the second.
    #[inline(always)]
    pub(crate) fn of(a: &AxisIntervals, b: &AxisIntervals, wanted: u64, factor: f32) -> PairKeys {
        let mut keys = PairKeys([NO_PAIR; PAIRS]);
        for (i, row) in keys.0.as_chunks_mut::<WIDTH>().0.iter_mut().enumerate() {
            let bits = (wanted >> (8 * (i & 7))) as u32 & 0xFF;
            if bits == 0 {
                continue;
            }
            let i = i & (WIDTH - 1);
            let bounds = bounds(a, b, i, bits, factor);
            for (j, (key, bound)) in row.iter_mut().zip(bounds).enumerate() {
                let pair = (i * WIDTH + j) as u32;
                *key = if bits & 1 << (j & 7) != 0 { key_of(bound, pair) } else { NO_PAIR };
            }
        }
        keys
    }

    /// The least key.
    #[inline(always)]
    pub(crate) fn least(&self) -> u32 {
        let mut lanes = [NO_PAIR; WIDTH];
        for row in self.0.as_chunks::<WIDTH>().0 {
            for (least, &key) in lanes.iter_mut().zip(row) {
                *least = lower_key(*least, key);
            }
        }
        lanes.into_iter().fold(NO_PAIR, lower_key)
    }

    /// Keeps the pairs with these bits.
    #[inline(always)]
    pub(crate) fn keep(&mut self, pairs: u64) {
        for (i, row) in self.0.as_chunks_mut::<WIDTH>().0.iter_mut().enumerate() {
            let bits = (pairs >> (WIDTH * (i & 7))) as u32;
            for (j, key) in row.iter_mut().enumerate() {
                *key = if bits & 1 << (j & 7) != 0 { *key } else { NO_PAIR };
            }
        }
    }

    /// Drops a pair.
    #[inline(always)]
    pub(crate) fn drop(&mut self, key: u32) {
        if let Some(slot) = self.0.get_mut((key & PAIR_MASK) as usize) {
            *slot = NO_PAIR;
        }
    }

    /// The bits of the pairs with keys up to a limit, and the least key of all pairs. If no bit is
    /// set, this key is above the limit.
    #[inline(always)]
    pub(crate) fn up_to(&self, limit: u32) -> (u64, u32) {
        let (mut bits, mut least) = (0u64, NO_PAIR);
        if WIDE {
            for (i, row) in self.0.as_chunks::<WIDTH>().0.iter().enumerate() {
                let lanes = row.iter().enumerate();
                let near = lanes.fold(0, |near, (j, &key)| {
                    near | if key.cast_signed() <= limit.cast_signed() {
                        1u32 << (j & 7)
                    } else {
                        0
                    }
                });
                bits |= u64::from(near) << (WIDTH * (i & 7));
            }
            return (bits, self.least());
        }
        for (pair, &key) in self.0.iter().enumerate() {
            bits |= u64::from(key <= limit) << (pair & (PAIRS - 1));
            least = least.min(key);
        }
        (bits, least)
    }
}

/// The lower of two keys.
#[inline(always)]
fn lower_key(a: u32, b: u32) -> u32 {
    if b.cast_signed() < a.cast_signed() { b } else { a }
}

/// Squared bounds of child `i` of the first node with each child of the second.
#[inline(always)]
fn bounds(a: &AxisIntervals, b: &AxisIntervals, i: usize, bits: u32, factor: f32) -> [f32; WIDTH] {
    let sums = |directions: core::ops::Range<usize>| {
        let mut sums = [0f32; WIDTH];
        for d in directions {
            let (low, high) = (&b.low[d % DIRECTIONS], &b.high[d % DIRECTIONS]);
            let (from, to) = (a.low[d % DIRECTIONS][i & 7], a.high[d % DIRECTIONS][i & 7]);
            for (j, (sum, (low, high))) in sums.iter_mut().zip(low.iter().zip(high)).enumerate() {
                if WIDE || bits >> j & 1 != 0 {
                    let gap = greater(0.0, greater(low - to, from - high));
                    *sum += gap * gap;
                }
            }
        }
        sums
    };
    // Three directions are the first model's axes, three the second's.
    let (first, second) = (&sums(0..3), &sums(3..6));
    let mut bounds = *first;
    for (bound, second) in bounds.iter_mut().zip(second) {
        *bound = greater(*bound, second * factor);
    }
    bounds
}
