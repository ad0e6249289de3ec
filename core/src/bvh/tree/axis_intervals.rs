//! A node's boxes as intervals along six directions: the axes of both trees' boxes.
//!
//! All boxes of a tree have the same axes, so the six directions are the face normals of every pair
//! of boxes. The nine cross products of edges would make the test exact. They are left out, because
//! they separate few more boxes (van den Bergen, *Efficient Collision Detection of Complex
//! Deformable Models using AABB Trees*, 1997).

use super::format::layout::{BOXES_BYTES, boxes};
use super::node::{WIDE, in_memory};
use crate::geom::fan::WIDTH;
use crate::num::lesser;
use crate::query::{DIRECTIONS, ModelFrame};

/// `[direction][child]`, common units.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AxisIntervals {
    pub(crate) low: [[f32; WIDTH]; DIRECTIONS],
    pub(crate) high: [[f32; WIDTH]; DIRECTIONS],
}

/// Along one axis, the sums and the differences of the boxes' high and low bytes: twice the
/// middles, and the lengths.
type SumsAndDifferences = ([f32; WIDTH], [f32; WIDTH]);

impl AxisIntervals {
    /// Intervals of a node's first `count` children.
    #[inline(always)]
    pub(crate) fn of(
        frame: &ModelFrame,
        record: &[u8; BOXES_BYTES],
        count: u32,
    ) -> Option<AxisIntervals> {
        let rows = record.as_chunks::<WIDTH>().0.first_chunk::<6>()?;
        let words = record.as_chunks::<4>().0.get(boxes::ORIGIN / 4..)?.first_chunk::<6>()?;
        let [ox, oy, oz, ux, uy, uz] = words.map(f32::from_le_bytes);
        let [lx, hx, ly, hy, lz, hz] = rows;
        let boxes = [
            sums_and_differences(lx, hx),
            sums_and_differences(ly, hy),
            sums_and_differences(lz, hz),
        ];
        let [x, y, z] = frame.origin;
        let start = [(ox - x) - 128.0 * ux, (oy - y) - 128.0 * uy, (oz - z) - 128.0 * uz];
        let mut intervals =
            AxisIntervals { low: [[0.0; WIDTH]; DIRECTIONS], high: [[0.0; WIDTH]; DIRECTIONS] };
        let out = intervals.low.iter_mut().zip(&mut intervals.high);
        let directions = frame.rows.iter().zip(frame.shift).zip(frame.grow);
        for ((low, high), ((row, shift), grow)) in out.zip(directions) {
            along(row, start, [ux, uy, uz], &boxes, [shift, grow], count, low, high);
        }
        Some(intervals)
    }
}

#[inline(always)]
fn sums_and_differences(low: &[u8; WIDTH], high: &[u8; WIDTH]) -> SumsAndDifferences {
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
    [bx, by, bz]: &[SumsAndDifferences; 3],
    [shift, grow]: [f32; 2],
    count: u32,
    low: &mut [f32; WIDTH],
    high: &mut [f32; WIDTH],
) {
    let from = (a * x + b * y) + (c * z + shift);
    let (nx, ny, nz) = ((a * ux) * 0.5, (b * uy) * 0.5, (c * uz) * 0.5);
    let (wx, wy, wz) = (nx.abs(), ny.abs(), nz.abs());
    let interval = |i: usize| {
        let middle = (nx * bx.0[i] + ny * by.0[i]) + (nz * bz.0[i] + from);
        let half = (wx * bx.1[i] + wy * by.1[i]) + (wz * bz.1[i] + grow);
        (middle - half, middle + half)
    };
    if WIDE {
        for i in 0..WIDTH {
            (low[i], high[i]) = interval(i);
        }
    } else {
        let count = (count as usize).min(WIDTH);
        for (i, (low, high)) in low.iter_mut().zip(high).enumerate().take(count) {
            if i < WIDTH {
                (*low, *high) = interval(i);
            }
        }
    }
}

/// Pairs of children whose intervals meet along every direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pairs {
    /// A byte for each child of the first node, a bit in it for each child of the second.
    pub(crate) bits: [u32; 2],
    /// The pair with the greatest depth. A pair's depth is its least overlap over the directions.
    /// Surfaces most often meet there.
    pub(crate) deepest: [u32; 2],
}

/// All pairs of the first node's `rows` and the second's `columns`, as bits.
#[inline(always)]
pub(crate) fn pairs(a: &AxisIntervals, b: &AxisIntervals, rows: u32, columns: u32) -> Pairs {
    let mut pairs = Pairs { bits: [0; 2], deepest: [0; 2] };
    let mut depth = -1.0;
    let mut left = rows;
    while left != 0 {
        let i = left.trailing_zeros();
        left &= left - 1;
        let depths = if WIDE { wide(a, b, i as usize) } else { narrow(a, b, i as usize, columns) };
        let mut meeting = 0;
        for (j, &deep) in depths.iter().enumerate() {
            meeting |= if deep >= 0.0 { 1 << (j & 7) } else { 0 };
        }
        meeting &= columns;
        let mut open = meeting;
        while open != 0 {
            let j = open.trailing_zeros();
            open &= open - 1;
            let deep = depths[j as usize & 7];
            if deep > depth {
                depth = deep;
                pairs.deepest = [i, j];
            }
        }
        let [low, high] = &mut pairs.bits;
        *(if i < 4 { low } else { high }) |= meeting << (8 * (i & 3));
    }
    pairs
}

/// Least overlap, over the directions, of child `i` of the first node with each child of the
/// second. Negative if they are apart.
#[inline(always)]
pub(crate) fn wide(a: &AxisIntervals, b: &AxisIntervals, i: usize) -> [f32; WIDTH] {
    let i = i & (WIDTH - 1);
    let mut depths = [f32::MAX; WIDTH];
    for d in 0..DIRECTIONS {
        let (from, to) = (a.low[d][i], a.high[d][i]);
        for (depth, (low, high)) in depths.iter_mut().zip(b.low[d].iter().zip(&b.high[d])) {
            *depth = lesser(*depth, lesser(high - from, to - low));
        }
    }
    in_memory(depths)
}

/// The same for the wanted children alone. It stops at the first direction that separates them.
#[inline(always)]
pub(crate) fn narrow(a: &AxisIntervals, b: &AxisIntervals, i: usize, columns: u32) -> [f32; WIDTH] {
    let mut depths = [-1f32; WIDTH];
    for (j, depth) in depths.iter_mut().enumerate() {
        if columns >> j & 1 != 0 {
            let mut least = f32::MAX;
            let directions = a.low.iter().zip(&a.high).zip(b.low.iter().zip(&b.high));
            for ((from, to), (low, high)) in directions {
                let (Some(from), Some(to), Some(low), Some(high)) =
                    (from.get(i), to.get(i), low.get(j), high.get(j))
                else {
                    break;
                };
                least = lesser(least, lesser(high - from, to - low));
                if least < 0.0 {
                    break;
                }
            }
            *depth = least;
        }
    }
    depths
}

#[cfg(test)]
mod tests {
    use super::{AxisIntervals, DIRECTIONS, WIDTH, narrow, wide};

    #[test]
    fn both_kernels_find_the_same_pairs_and_depths() {
        let mut state = 0x1234_5678u32;
        let mut random = move || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) as f32 / 65_536.0 - 128.0
        };
        let mut meeting = 0;
        for round in 0..500 {
            let mut intervals = || {
                let mut intervals = AxisIntervals {
                    low: [[0.0; WIDTH]; DIRECTIONS],
                    high: [[0.0; WIDTH]; DIRECTIONS],
                };
                for (low, high) in
                    intervals.low.iter_mut().flatten().zip(intervals.high.iter_mut().flatten())
                {
                    *low = random();
                    *high = *low + if round % 5 == 0 { 0.0 } else { random().abs() * 2.0 };
                }
                intervals
            };
            let (a, b) = (intervals(), intervals());
            let b = if round % 7 == 0 { a } else { b };
            for i in 0..WIDTH {
                let (first, second) = (wide(&a, &b, i), narrow(&a, &b, i, 0b1011_0111));
                for j in 0..WIDTH {
                    if 0b1011_0111 >> j & 1 == 0 || first[j] < 0.0 {
                        assert!(second[j] < 0.0);
                    } else {
                        assert_eq!(first[j].to_bits(), second[j].to_bits());
                        meeting += 1;
                    }
                }
            }
        }
        assert!(meeting > 1_000, "{meeting}");
    }
}
