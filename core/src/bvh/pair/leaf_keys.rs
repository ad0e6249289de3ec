//! Which triangles of two leaves may be near each other, in f32: by their boxes, and along a
//! direction.

use super::leaf_pair::{Corners, LeafPair, SLOTS, TriangleBoxes};
use super::pair_keys::{NO_PAIR, PairKeys, key_of};
use crate::bvh::tree::node::WIDE;
use crate::geom::fan::WIDTH;
use crate::num::tolerance::{LEAST_GAP_SQ, U32};
use crate::num::{greater, lesser, sqrt_approx};

/// The squared gaps between the boxes of triangle `i` and each of the other leaf's triangles, of
/// those with a bit.
#[cfg_attr(meshsweep_small, inline(never))]
#[cfg_attr(not(meshsweep_small), inline(always))]
pub(super) fn box_gaps_sq(
    first: &TriangleBoxes,
    second: &TriangleBoxes,
    i: usize,
    bits: u32,
) -> [f32; WIDTH] {
    let mut sums = [0f32; WIDTH];
    for ((from, to), (low, high)) in
        first.low.iter().zip(&first.high).zip(second.low.iter().zip(&second.high))
    {
        let (Some(&from), Some(&to)) = (from.get(i), to.get(i)) else { continue };
        for (j, (sum, (low, high))) in sums.iter_mut().zip(low.iter().zip(high)).enumerate() {
            if WIDE || bits >> j & 1 != 0 {
                let gap = greater(0.0, greater(low - to, from - high));
                *sum += gap * gap;
            }
        }
    }
    sums
}

/// Keys of the pairs `wanted`, by their boxes: a bit for each pair. Vertices are as computed, so a
/// limit must have room for their error.
#[cfg_attr(meshsweep_small, inline(never))]
#[cfg_attr(not(meshsweep_small), inline(always))]
pub(super) fn keys_of_triangles(
    a: &Corners,
    b: &Corners,
    limit_sq: f32,
    wanted: u64,
) -> Option<PairKeys> {
    let (first, second) = (TriangleBoxes::of(a)?, TriangleBoxes::of(b)?);
    let mut keys = PairKeys([NO_PAIR; WIDTH * WIDTH]);
    let columns = (1u32 << (b.triangles & 15)) - 1;
    let rows = keys.0.as_chunks_mut::<WIDTH>().0.iter_mut();
    for (i, row) in rows.enumerate().take(a.triangles) {
        let bits = (wanted >> (i * WIDTH)) as u32 & columns;
        if bits == 0 {
            continue;
        }
        let sums = box_gaps_sq(&first, &second, i, bits);
        for (j, (key, sum)) in row.iter_mut().zip(sums).enumerate() {
            let is_near = bits & 1 << (j & 7) != 0 && sum <= limit_sq;
            *key = if is_near { key_of(sum, (i * WIDTH + j) as u32) } else { NO_PAIR };
        }
    }
    Some(keys)
}

/// The pairs that are not farther apart along `direction` than the limit: a bit for each.
#[cfg_attr(meshsweep_small, inline(never))]
#[cfg_attr(not(meshsweep_small), inline(always))]
pub(super) fn pairs_along(direction: [f32; 3], limit_sq: f32, a: &Corners, b: &Corners) -> u64 {
    let Some(limit) = limit_along(direction, limit_sq) else { return u64::MAX };
    let (first, second) = (heights(a, direction), heights(b, direction));
    let mut pairs = 0;
    for (i, &top) in first.high.iter().enumerate().take(a.triangles) {
        let mut bits = 0u32;
        for (j, low) in second.low.iter().enumerate() {
            bits |= if low - top <= limit { 1 << (j & 7) } else { 0 };
        }
        pairs |= u64::from(bits) << (i * WIDTH);
    }
    pairs
}

/// Whether the leaves as a whole are within the limit along `direction`.
#[inline(always)]
pub(super) fn may_be_near(direction: [f32; 3], limit_sq: f32, pair: &LeafPair<'_>) -> bool {
    let Some(limit) = limit_along(direction, limit_sq) else { return true };
    let top = vertex_heights(&pair.a, direction).into_iter().fold(f32::MIN, greater);
    let low = vertex_heights(&pair.b, direction).into_iter().fold(f32::MAX, lesser);
    low - top <= limit
}

/// The limit times the length of the direction, rounded up. `None` if the square is too small to be
/// trusted.
#[cfg_attr(meshsweep_small, inline(never))]
#[cfg_attr(not(meshsweep_small), inline(always))]
fn limit_along([x, y, z]: [f32; 3], limit_sq: f32) -> Option<f32> {
    let direction_sq = x * x + y * y + z * z;
    let square = limit_sq * direction_sq;
    let is_trusted = direction_sq >= LEAST_GAP_SQ && square >= LEAST_GAP_SQ;
    is_trusted.then(|| sqrt_approx(square) * (1.0 + 8.0 * U32))
}

/// Triangles along a direction.
pub(super) struct Heights {
    pub(super) low: [f32; WIDTH],
    pub(super) high: [f32; WIDTH],
}

#[inline(always)]
fn vertex_heights(corners: &Corners, [a, b, c]: [f32; 3]) -> [f32; SLOTS] {
    let [x, y, z] = &corners.at;
    let mut at = [0f32; SLOTS];
    for i in 0..SLOTS {
        at[i] = a * x[i] + b * y[i] + c * z[i];
    }
    at
}

#[cfg_attr(meshsweep_small, inline(never))]
#[cfg_attr(not(meshsweep_small), inline(always))]
pub(super) fn heights(corners: &Corners, direction: [f32; 3]) -> Heights {
    let at = vertex_heights(corners, direction);
    let Some((low, high)) = corners.ends(&at) else {
        return Heights { low: [f32::MIN; WIDTH], high: [f32::MAX; WIDTH] };
    };
    Heights { low, high }
}
