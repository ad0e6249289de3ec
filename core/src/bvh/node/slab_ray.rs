//! A segment's line and the planes of a node's boxes: axis-aligned, in 8 bits.
//!
//! A box plane of byte `v` lies at `origin + (v − 128)·step`. So the segment's line meets it at the
//! parameter `v·m + c`, where m and c are two numbers for each node and axis. Along each axis the
//! segment meets one row of planes before the other. Which row that is depends on the direction
//! alone, so it is chosen once for each segment.

#[cfg(any(test, not(any(target_arch = "x86_64", target_arch = "aarch64"))))]
use super::keys::{CHILD_MASK, NO_CHILD};
use crate::bvh::format::layout::{BOXES_BYTES, boxes};
use crate::geom::fan::WIDTH;
#[cfg(any(test, not(any(target_arch = "x86_64", target_arch = "aarch64"))))]
use crate::num::{greater, lesser};

/// Most fraction bits of a parameter: the whole segment is 2^24.
#[cfg(any(test, not(any(target_arch = "x86_64", target_arch = "aarch64"))))]
const MOST_BITS: i32 = 24;
/// An axis with fewer fraction bits is steep.
#[cfg(any(test, not(any(target_arch = "x86_64", target_arch = "aarch64"))))]
const FEWEST_BITS: i32 = 14;

#[cfg(any(test, not(any(target_arch = "x86_64", target_arch = "aarch64"))))]
/// The unit of whole parameters, for one segment.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fraction {
    pub(super) bits: i32,
    /// Axes along which the segment is so short that parameters do not fit: a bit for each. They
    /// decide in f32 only.
    pub(super) steep: u32,
}

#[cfg(any(test, not(any(target_arch = "x86_64", target_arch = "aarch64"))))]
impl Fraction {
    #[inline(always)]
    pub(super) fn new(inverse: [f32; 3], far: [f32; 3]) -> Self {
        let mut fraction = Fraction { bits: MOST_BITS, steep: 0 };
        for axis in 0..3 {
            // A plane of a node is not farther than four times `far`.
            let exponent = |x: f32| (x.to_bits() >> 23 & 0xFF).cast_signed() - 126;
            // That is 2 bits. A whole parameter must stay below 2^28: 26 are left.
            let bits = 26 - (exponent(inverse[axis]) + exponent(far[axis]));
            if bits < FEWEST_BITS {
                fraction.steep |= 1 << axis;
            } else {
                fraction.bits = lesser(fraction.bits, bits);
            }
        }
        fraction
    }
}

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
    /// For boards.
    #[cfg(any(test, not(any(target_arch = "x86_64", target_arch = "aarch64"))))]
    pub(super) fraction: Fraction,
}

impl SlabRay {
    /// The line through `origin` with `inverse`, by axis the reciprocals of its direction; boxes
    /// are enlarged by `margin` on each side. `far`: by axis the way to the farthest corner of the
    /// model. The products of all numbers with the model's size must stay finite.
    #[inline(always)]
    #[cfg_attr(any(target_arch = "x86_64", target_arch = "aarch64"), allow(unused_variables))]
    pub fn new(origin: [f32; 3], inverse: [f32; 3], margin: [f32; 3], far: [f32; 3]) -> Self {
        let [ix, iy, iz] = inverse;
        let [mx, my, mz] = margin;
        let row = |x: f32, axis: usize| 2 * axis + (x.to_bits() >> 31) as usize;
        SlabRay {
            origin,
            inverse,
            grow: [mx * ix.abs(), my * iy.abs(), mz * iz.abs()],
            near: [row(ix, 0), row(iy, 1), row(iz, 2)],
            #[cfg(any(test, not(any(target_arch = "x86_64", target_arch = "aarch64"))))]
            fraction: Fraction::new(inverse, far),
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
    #[cfg(any(test, not(any(target_arch = "x86_64", target_arch = "aarch64"))))]
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

    /// Keys of the first `count` children, one after the other.
    #[cfg(any(test, not(any(target_arch = "x86_64", target_arch = "aarch64"))))]
    #[inline(always)]
    pub(crate) fn keys(&self, count: u32, range: [u32; 2]) -> [u32; WIDTH] {
        let mut keys = [NO_CHILD; WIDTH];
        for (child, key) in keys.iter_mut().enumerate().take(count as usize) {
            *key = self.entry(child, range).unwrap_or(NO_CHILD);
        }
        keys
    }
}

#[cfg(any(test, not(any(target_arch = "x86_64", target_arch = "aarch64"))))]
impl Axis<'_> {
    /// The bits of the parameter of a plane.
    #[inline(always)]
    pub(super) fn at(&self, plane: u8, start: f32) -> i32 {
        (f32::from(plane) * self.step + start).to_bits().cast_signed()
    }
}
