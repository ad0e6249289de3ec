//! A segment against eight axis-aligned boxes in 8 bits.
//!
//! A box plane of byte `v` lies at `origin + (v − 128)·step`, so the parameter at which the segment's line meets it is `v·m + c` with
//! two numbers for each node and axis. Which row of bytes is the near one depends on the direction alone: it is chosen once for each segment.

use super::in_memory;
use super::lanes::{LANE_MASK, NO_CHILD, WIDE};
use crate::blob::layout::{BOXES_BYTES, WIDTH};
use crate::fan::LANES_BELOW;

/// A segment as the boxes see it, grid units. See `core/docs/rounding.md` §9.
#[derive(Clone, Copy, Debug)]
pub struct Slabs {
    origin: [f32; 3],
    inverse: [f32; 3],
    /// By how much earlier and later than its plane a box begins and ends.
    grow: [f32; 3],
    /// Row of the near planes, the far ones are the row's neighbour.
    near: [usize; 3],
}

impl Slabs {
    /// The line through `origin` with `inverse`, by axis the reciprocals of its direction; boxes count as larger by `margin` on each side. Any
    /// numbers will do as long as their products with the model's size stay finite.
    #[inline(always)]
    pub fn new(origin: [f32; 3], inverse: [f32; 3], margin: [f32; 3]) -> Self {
        let [ix, iy, iz] = inverse;
        let [mx, my, mz] = margin;
        let row = |x: f32, axis: usize| 2 * axis + (x.to_bits() >> 31) as usize;
        Slabs {
            origin,
            inverse,
            grow: [mx * ix.abs(), my * iy.abs(), mz * iz.abs()],
            near: [row(ix, 0), row(iy, 1), row(iz, 2)],
        }
    }

    /// Parameter of byte 0 on the near and on the far side, and of one step.
    #[inline(always)]
    fn axis(&self, axis: usize, origin: f32, step: f32) -> (f32, f32, f32) {
        let from = (origin - self.origin[axis]) - 128.0 * step;
        let start = from * self.inverse[axis];
        (start - self.grow[axis], start + self.grow[axis], step * self.inverse[axis])
    }
}

/// Keys of a node's children: the parameter at which the segment enters their boxes, not below `from`, rounded down in the low three bits, which
/// hold the lane. What it does not enter up to `limit`, and lanes from `count` on, is [`NO_CHILD`] or more.
#[inline(always)]
pub fn box_entries(
    record: &[u8; BOXES_BYTES],
    slabs: &Slabs,
    count: u32,
    from: f32,
    limit: f32,
) -> [f32; WIDTH] {
    let mut keys = [NO_CHILD; WIDTH];
    let (rows, _) = record.as_chunks::<WIDTH>();
    let Some(rows) = rows.first_chunk::<8>() else { return keys };
    let (words, _) = record.as_chunks::<4>();
    let Some(words) = words.get(12..).and_then(|words| words.first_chunk::<6>()) else { return keys };
    let [ox, oy, oz, ux, uy, uz] = words.map(f32::from_le_bytes);
    let (nx, fx, mx) = slabs.axis(0, ox, ux);
    let (ny, fy, my) = slabs.axis(1, oy, uy);
    let (nz, fz, mz) = slabs.axis(2, oz, uz);
    let [x, y, z] = slabs.near;
    let near = [&rows[x & 7], &rows[y & 7], &rows[z & 7]];
    let far = [&rows[(x ^ 1) & 7], &rows[(y ^ 1) & 7], &rows[(z ^ 1) & 7]];
    let at = |v: u8, m: f32, c: f32| f32::from(v) * m + c;
    if !WIDE {
        // What is entered only grows and what is left only falls: the first axis without an overlap decides, with the same keys.
        let axes = [(near[0], far[0], mx, nx, fx), (near[1], far[1], my, ny, fy), (near[2], far[2], mz, nz, fz)];
        for (lane, key) in keys.iter_mut().enumerate().take(count as usize) {
            let (mut enter, mut leave) = (from, limit);
            let overlaps = axes.iter().all(|&(near, far, m, n, f)| {
                (enter, leave) = (greater(at(near[lane], m, n), enter), less(at(far[lane], m, f), leave));
                enter <= leave
            });
            if overlaps {
                *key = f32::from_bits(enter.to_bits() & !LANE_MASK | lane as u32);
            }
        }
        return keys;
    }
    let Some(present) = LANES_BELOW.get(count as usize) else { return keys };
    for i in 0..WIDTH {
        let enter_x = at(near[0][i], mx, nx);
        let enter_y = at(near[1][i], my, ny);
        let enter_z = at(near[2][i], mz, nz);
        let leave_x = at(far[0][i], mx, fx);
        let leave_y = at(far[1][i], my, fy);
        let leave_z = at(far[2][i], mz, fz);
        let enter = greater(greater(enter_x, enter_y), greater(enter_z, from));
        let leave = less(less(leave_x, leave_y), less(leave_z, limit));
        let key = if enter <= leave { enter } else { NO_CHILD };
        keys[i] = f32::from_bits(key.to_bits() & !LANE_MASK | i as u32 | !present[i] & NO_CHILD.to_bits());
    }
    if WIDE { in_memory(keys) } else { keys }
}

#[inline(always)]
fn greater(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

#[inline(always)]
fn less(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}
