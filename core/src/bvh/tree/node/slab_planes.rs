//! The planes of a node's boxes as a segment meets them, one box after the other.

use super::keys::{CHILD_MASK, NO_CHILD};
#[cfg(not(any(meshsweep_wide, meshsweep_soft_float)))]
use super::opened_node::{OpenedNode, Pushed, Pusher};
use super::slab_ray::{ByAxis, SlabRay};
use crate::bvh::tree::format::layout::{BOXES_BYTES, boxes};
use crate::geom::fan::WIDTH;
use crate::num::{greater, lesser};
#[cfg(not(any(meshsweep_wide, meshsweep_soft_float)))]
use crate::query::ScratchEntry;

impl SlabRay {
    /// Parameter of byte 0 on the near and on the far side, and of one step.
    #[inline(always)]
    fn axis(&self, axis: usize, origin: f32, step: f32) -> (f32, f32, f32) {
        let SlabRay { origin: at, inverse, grow, .. } = self;
        let (at, inverse, grow) = (along(at, axis), along(inverse, axis), along(grow, axis));
        let from = (origin - at) - 128.0 * step;
        let start = from * inverse;
        (start - grow, start + grow, step * inverse)
    }
}

#[cfg(not(meshsweep_wide))]
#[inline(always)]
fn along(numbers: &ByAxis, axis: usize) -> f32 {
    numbers[axis]
}

/// For a test.
#[cfg(meshsweep_wide)]
fn along(numbers: &ByAxis, axis: usize) -> f32 {
    numbers.to_array()[axis]
}

/// Planes of the boxes along one axis, in the order in which the segment meets them.
pub(super) struct Axis<'a> {
    pub(super) near: &'a [u8; WIDTH],
    pub(super) far: &'a [u8; WIDTH],
    /// Parameters of byte 0, and of a step.
    pub(super) enter: f32,
    pub(super) leave: f32,
    pub(super) step: f32,
}

/// The planes of a node's boxes along the three axes.
pub(crate) struct SlabPlanes<'a>(pub(super) [Axis<'a>; 3]);

impl<'a> SlabPlanes<'a> {
    #[inline(always)]
    pub(crate) fn of(record: &'a [u8; BOXES_BYTES], ray: &SlabRay) -> Option<Self> {
        // Eight rows, so that `& 7` needs no bounds check. Rows 6 and 7 are never chosen.
        let rows = record.as_chunks::<WIDTH>().0.first_chunk::<8>()?;
        let words = record.as_chunks::<4>().0.get(boxes::ORIGIN / 4..)?.first_chunk::<6>()?;
        // Not by `map`: the compiler does not inline that at `opt-level = "s"`.
        let float = |axis: usize| f32::from_le_bytes(words[axis]);
        let [ox, oy, oz] = [float(0), float(1), float(2)];
        let [ux, uy, uz] = [float(3), float(4), float(5)];
        let along = |axis: usize, origin: f32, unit: f32| {
            let (enter, leave, step) = ray.axis(axis, origin, unit);
            let row = ray.near[axis];
            Axis { near: &rows[row & 7], far: &rows[(row ^ 1) & 7], enter, leave, step }
        };
        Some(SlabPlanes([along(0, ox, ux), along(1, oy, uy), along(2, oz, uz)]))
    }

    /// Key of one child, if the segment enters its box between two parameters, given by their bits.
    ///
    /// It stops at the first axis on which the box is missed. From axis to axis the entry only
    /// grows and the exit only falls, so the keys are those of eight lanes. Parameters are compared
    /// by their bits: a negative one is below the bound as an entry, and the box is missed with it
    /// as an exit. The bits of −0 would compare as negative. No sum is −0, because `grow` is
    /// positive.
    #[inline(always)]
    pub(crate) fn entry(&self, child: usize, [bound, limit]: [u32; 2]) -> Option<u32> {
        let (mut enter, mut leave) = (bound.cast_signed(), limit.cast_signed());
        for axis in &self.0 {
            // `child` is below 8, but LLVM does not see it on all targets.
            let (near, far) = (axis.near[child % WIDTH], axis.far[child % WIDTH]);
            enter = greater(enter, axis.at(near, axis.enter));
            if enter > leave {
                return None;
            }
            leave = lesser(leave, axis.at(far, axis.leave));
            if enter > leave {
                return None;
            }
        }
        Some(enter.cast_unsigned() & !CHILD_MASK | child as u32)
    }

    /// Pushes the children that the segment enters, one after the other.
    #[cfg(not(any(meshsweep_wide, meshsweep_soft_float)))]
    #[inline(always)]
    pub(super) fn push(&self, opened: &OpenedNode, slots: &mut [ScratchEntry; WIDTH]) -> Pushed {
        let mut pusher = Pusher::new(opened.node, slots);
        for child in 0..lesser(opened.count as usize, WIDTH) {
            if let Some(key) = self.entry(child, [opened.bound, opened.limit]) {
                pusher.push(key);
            }
        }
        pusher.finish()
    }

    /// Keys of the first `count` children, one after the other.
    #[inline(always)]
    pub(crate) fn keys(&self, count: u32, range: [u32; 2]) -> [u32; WIDTH] {
        let mut keys = [NO_CHILD; WIDTH];
        for (child, key) in keys.iter_mut().enumerate().take(count as usize) {
            *key = self.entry(child, range).unwrap_or(NO_CHILD);
        }
        keys
    }
}

impl Axis<'_> {
    /// The bits of the parameter of a plane.
    #[inline(always)]
    pub(super) fn at(&self, plane: u8, start: f32) -> i32 {
        (f32::from(plane) * self.step + start).to_bits().cast_signed()
    }
}
