//! Boxes of a node as intervals along six directions: the axes of the one tree's boxes, and of the other's.
//!
//! All boxes of a tree have the same axes, so these are the face normals of every pair of boxes. The nine products of edges, which would make the
//! test exact, part few boxes more (van den Bergen, *Efficient Collision Detection of Complex Deformable Models using AABB Trees*, 1997).

use super::placement::{DIRECTIONS, Side};
use crate::blob::layout::{BOXES_BYTES, WIDTH};
use crate::tree::{WIDE, in_memory};

/// `[direction][child]`, common units.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spans {
    low: [[f32; WIDTH]; DIRECTIONS],
    high: [[f32; WIDTH]; DIRECTIONS],
}

/// Twice the middles and twice the half lengths of boxes along an axis, in steps from byte 0.
type Boxes = ([f32; WIDTH], [f32; WIDTH]);

impl Spans {
    /// Intervals of a node's first `count` children.
    #[inline(always)]
    pub(super) fn of(side: &Side, record: &[u8; BOXES_BYTES], count: u32) -> Option<Spans> {
        let rows = record.as_chunks::<WIDTH>().0.first_chunk::<6>()?;
        let words = record.as_chunks::<4>().0.get(12..)?.first_chunk::<6>()?;
        let [ox, oy, oz, ux, uy, uz] = words.map(f32::from_le_bytes);
        let [lx, hx, ly, hy, lz, hz] = rows;
        let boxes = [both(lx, hx), both(ly, hy), both(lz, hz)];
        let [x, y, z] = side.origin;
        let start = [(ox - x) - 128.0 * ux, (oy - y) - 128.0 * uy, (oz - z) - 128.0 * uz];
        let mut spans = Spans { low: [[0.0; WIDTH]; DIRECTIONS], high: [[0.0; WIDTH]; DIRECTIONS] };
        let out = spans.low.iter_mut().zip(&mut spans.high);
        let directions = side.rows.iter().zip(side.shift).zip(side.grow);
        for ((low, high), ((row, shift), grow)) in out.zip(directions) {
            along(row, start, [ux, uy, uz], &boxes, [shift, grow], count, low, high);
        }
        Some(spans)
    }
}

#[inline(always)]
fn both(low: &[u8; WIDTH], high: &[u8; WIDTH]) -> Boxes {
    let (mut sum, mut difference) = ([0f32; WIDTH], [0f32; WIDTH]);
    for i in 0..WIDTH {
        let (low, high) = (f32::from(low[i]), f32::from(high[i]));
        sum[i] = high + low;
        difference[i] = high - low;
    }
    (sum, difference)
}

#[inline(always)]
#[allow(clippy::too_many_arguments, reason = "one direction's numbers, inlined")]
fn along(
    &[a, b, c]: &[f32; 3],
    [x, y, z]: [f32; 3],
    [ux, uy, uz]: [f32; 3],
    [bx, by, bz]: &[Boxes; 3],
    [shift, grow]: [f32; 2],
    count: u32,
    low: &mut [f32; WIDTH],
    high: &mut [f32; WIDTH],
) {
    let from = (a * x + b * y) + (c * z + shift);
    let (nx, ny, nz) = ((a * ux) * 0.5, (b * uy) * 0.5, (c * uz) * 0.5);
    let (wx, wy, wz) = (nx.abs(), ny.abs(), nz.abs());
    let lane = |i: usize| {
        let middle = (nx * bx.0[i] + ny * by.0[i]) + (nz * bz.0[i] + from);
        let half = (wx * bx.1[i] + wy * by.1[i]) + (wz * bz.1[i] + grow);
        (middle - half, middle + half)
    };
    if WIDE {
        for i in 0..WIDTH {
            (low[i], high[i]) = lane(i);
        }
    } else {
        let count = (count as usize).min(WIDTH);
        for (i, (low, high)) in low.iter_mut().zip(high).enumerate().take(count) {
            if i < WIDTH {
                (*low, *high) = lane(i);
            }
        }
    }
}

/// Pairs of children whose intervals meet along every direction: a byte for each of the first node's, of which `rows` are wanted, with a bit for each of the
/// second's, of which `lanes` are.
#[inline(always)]
pub(super) fn pairs(a: &Spans, b: &Spans, rows: u32, lanes: u32) -> [u32; 2] {
    let mut pairs = [0u32; 2];
    let mut left = rows;
    while left != 0 {
        let i = left.trailing_zeros() as usize & (WIDTH - 1);
        left &= left - 1;
        let met = row(a, b, i, lanes) & lanes;
        pairs[i >> 2] |= met << (8 * (i as u32 & 3));
    }
    pairs
}

#[inline(always)]
fn row(a: &Spans, b: &Spans, i: usize, lanes: u32) -> u32 {
    if WIDE {
        let mut bits = [0u32; WIDTH];
        for (j, bit) in bits.iter_mut().enumerate() {
            let mut met = true;
            for d in 0..DIRECTIONS {
                met &= (a.low[d][i] <= b.high[d][j]) & (b.low[d][j] <= a.high[d][i]);
            }
            *bit = if met { 1 << j } else { 0 };
        }
        return in_memory(bits).iter().fold(0, |all, bit| all | bit);
    }
    let mut bits = lanes;
    for d in 0..DIRECTIONS {
        let (Some(&from), Some(&to)) = (a.low[d].get(i), a.high[d].get(i)) else { return 0 };
        for (j, (&low, &high)) in b.low[d].iter().zip(&b.high[d]).enumerate() {
            if bits >> j & 1 != 0 && !((from <= high) & (low <= to)) {
                bits &= !(1 << j);
            }
        }
        if bits == 0 {
            break;
        }
    }
    bits
}
