//! A segment against eight axis-aligned boxes in 8 bits.
//!
//! A box plane of byte `v` lies at `origin + (v − 128)·step`. So the segment's line meets it at the
//! parameter `v·m + c`, where m and c are two numbers for each node and axis. Along each axis the
//! segment meets one row of planes before the other. Which row that is depends on the direction
//! alone, so it is chosen once for each segment.

use super::keys::{CHILD_MASK, NO_CHILD, WIDE, in_memory};
use crate::bvh::format::layout::{BOXES_BYTES, boxes};
use crate::geom::fan::{LANES_BELOW, WIDTH};
use crate::num::{greater, lesser};

/// A segment's line, prepared for the slab test: its distance from the planes of a box, axis by
/// axis, as parameters of the segment. Grid units. See `core/docs/rounding.md` §9.
#[derive(Clone, Copy, Debug)]
pub struct SlabRay {
    origin: [f32; 3],
    inverse: [f32; 3],
    /// Parameter by which a box begins earlier and ends later than its planes.
    grow: [f32; 3],
    /// For each axis the row of the planes that the segment meets first. The other row is next to
    /// it.
    near: [usize; 3],
}

impl SlabRay {
    /// The line through `origin` with `inverse`, by axis the reciprocals of its direction; boxes
    /// are enlarged by `margin` on each side. The products of all numbers with the model's size
    /// must stay finite.
    #[inline(always)]
    pub fn new(origin: [f32; 3], inverse: [f32; 3], margin: [f32; 3]) -> Self {
        let [ix, iy, iz] = inverse;
        let [mx, my, mz] = margin;
        let row = |x: f32, axis: usize| 2 * axis + (x.to_bits() >> 31) as usize;
        SlabRay {
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

/// Keys of a node's children: the parameters at which the segment enters their boxes. No key is
/// below `parent_bound`, and the low three bits hold the number of the child. Boxes that the
/// segment does not enter up to `limit`, and keys from `count` on, have [`NO_CHILD`] or more.
#[inline(always)]
pub fn box_entries(
    record: &[u8; BOXES_BYTES],
    ray: &SlabRay,
    count: u32,
    parent_bound: f32,
    limit: f32,
) -> [u32; WIDTH] {
    let Some(planes) = SlabPlanes::of(record, ray) else { return [NO_CHILD; WIDTH] };
    if WIDE {
        wide(&planes, count, parent_bound, limit)
    } else {
        narrow(&planes, count, parent_bound, limit)
    }
}

/// Planes of the boxes along one axis, in the order in which the segment meets them.
struct Axis<'a> {
    near: &'a [u8; WIDTH],
    far: &'a [u8; WIDTH],
    /// Parameters of byte 0, and of a step.
    enter: f32,
    leave: f32,
    step: f32,
}

/// The planes of a node's boxes along the three axes.
pub(crate) struct SlabPlanes<'a>([Axis<'a>; 3]);

impl<'a> SlabPlanes<'a> {
    #[inline(always)]
    pub(crate) fn of(record: &'a [u8; BOXES_BYTES], ray: &SlabRay) -> Option<Self> {
        // Eight rows, so that `& 7` needs no bounds check. Rows 6 and 7 are never chosen.
        let rows = record.as_chunks::<WIDTH>().0.first_chunk::<8>()?;
        let words = record.as_chunks::<4>().0.get(boxes::ORIGIN / 4..)?.first_chunk::<6>()?;
        let [ox, oy, oz, ux, uy, uz] = words.map(f32::from_le_bytes);
        let along = |axis: usize, origin: f32, unit: f32| {
            let (enter, leave, step) = ray.axis(axis, origin, unit);
            let row = ray.near[axis];
            Axis { near: &rows[row & 7], far: &rows[(row ^ 1) & 7], enter, leave, step }
        };
        Some(SlabPlanes([along(0, ox, ux), along(1, oy, uy), along(2, oz, uz)]))
    }
}

#[inline(always)]
pub(crate) fn wide(
    SlabPlanes([x, y, z]): &SlabPlanes<'_>,
    count: u32,
    parent_bound: f32,
    limit: f32,
) -> [u32; WIDTH] {
    let mut keys = [NO_CHILD; WIDTH];
    let Some(present) = LANES_BELOW.get(count as usize) else { return keys };
    let none = f32::from_bits(NO_CHILD);
    let at = |v: u8, step: f32, start: f32| f32::from(v) * step + start;
    for i in 0..WIDTH {
        let enter_x = at(x.near[i], x.step, x.enter);
        let enter_y = at(y.near[i], y.step, y.enter);
        let enter_z = at(z.near[i], z.step, z.enter);
        let leave_x = at(x.far[i], x.step, x.leave);
        let leave_y = at(y.far[i], y.step, y.leave);
        let leave_z = at(z.far[i], z.step, z.leave);
        let enter = greater(greater(parent_bound, enter_z), greater(enter_y, enter_x));
        let leave = lesser(lesser(limit, leave_z), lesser(leave_y, leave_x));
        let key = if enter <= leave { enter } else { none };
        // The box of an absent child may be any: its key is overwritten.
        let bits = key.to_bits() & !CHILD_MASK & present[i] | NO_CHILD & !present[i];
        keys[i] = bits | i as u32;
    }
    in_memory(keys)
}

/// Stops at the first axis on which the box is missed. From axis to axis the entry only grows and
/// the exit only falls, so the keys are those of `wide`. Parameters are compared by their bits: a
/// negative one is below `parent_bound` as an entry, and the box is missed with it as an exit. The
/// bits of −0 would compare as negative. No sum is −0, because `grow` is positive.
#[inline(always)]
pub(crate) fn narrow(
    SlabPlanes(axes): &SlabPlanes<'_>,
    count: u32,
    parent_bound: f32,
    limit: f32,
) -> [u32; WIDTH] {
    let mut keys = [NO_CHILD; WIDTH];
    let [parent_bound, limit] = [parent_bound, limit].map(|t| t.to_bits().cast_signed());
    for (child, key) in keys.iter_mut().enumerate().take(count as usize) {
        let (mut enter, mut leave) = (parent_bound, limit);
        let overlaps = axes.iter().all(|axis| {
            // `child` is below 8, but LLVM does not see it on all targets.
            let (Some(&near), Some(&far)) = (axis.near.get(child), axis.far.get(child)) else {
                return false;
            };
            let at = |v: u8, start: f32| (f32::from(v) * axis.step + start).to_bits().cast_signed();
            enter = greater(enter, at(near, axis.enter));
            if enter > leave {
                return false;
            }
            leave = lesser(leave, at(far, axis.leave));
            enter <= leave
        });
        if overlaps {
            *key = enter.cast_unsigned() & !CHILD_MASK | child as u32;
        }
    }
    keys
}
