//! A segment's line and the planes of a node's boxes: axis-aligned, in 8 bits.
//!
//! A box plane of byte `v` lies at `origin + (v − 128)·step`. So the segment's line meets it at the
//! parameter `v·m + c`, where m and c are two numbers for each node and axis. Along each axis the
//! segment meets one row of planes before the other. Which row that is depends on the direction
//! alone, so it is chosen once for each segment.

#[cfg(any(all(test, meshsweep_wide), meshsweep_soft_float))]
use crate::num::lesser;

/// Most fraction bits of a parameter: the whole segment is 2^24.
#[cfg(any(all(test, meshsweep_wide), meshsweep_soft_float))]
const MOST_BITS: i32 = 24;
/// An axis with fewer fraction bits is steep.
#[cfg(any(all(test, meshsweep_wide), meshsweep_soft_float))]
const FEWEST_BITS: i32 = 14;

#[cfg(any(all(test, meshsweep_wide), meshsweep_soft_float))]
/// The unit of whole parameters, for one segment.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fraction {
    pub(super) bits: i32,
    /// Axes along which the segment is so short that parameters do not fit: a bit for each. They
    /// decide in f32 only.
    pub(super) steep: u32,
}

#[cfg(any(all(test, meshsweep_wide), meshsweep_soft_float))]
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

/// A number for each axis. In a register, which is stored and read as a whole: three numbers that
/// were stored one by one would have to reach the cache before the register could be read. The
/// fourth number is 0.
#[cfg(meshsweep_wide)]
pub(super) type ByAxis = wide::f32x4;

/// A number for each axis.
#[cfg(not(meshsweep_wide))]
pub(super) type ByAxis = [f32; 3];

#[cfg(meshsweep_wide)]
#[inline(always)]
fn by_axis([x, y, z]: [f32; 3]) -> ByAxis {
    ByAxis::new([x, y, z, 0.0])
}

#[cfg(not(meshsweep_wide))]
#[inline(always)]
fn by_axis(numbers: [f32; 3]) -> ByAxis {
    numbers
}

/// A segment's line, prepared for the slab test: its distance from the planes of a box, axis by
/// axis, as parameters of the segment. Grid units. See `core/docs/rounding.md` §9.
#[derive(Clone, Copy, Debug)]
pub struct SlabRay {
    pub(super) origin: ByAxis,
    pub(super) inverse: ByAxis,
    /// Parameter by which a box begins earlier and ends later than its planes.
    pub(super) grow: ByAxis,
    /// For each axis the row of the planes that the segment meets first. The other row is next to
    /// it.
    pub(super) near: [usize; 3],
    /// For targets without an FPU.
    #[cfg(any(all(test, meshsweep_wide), meshsweep_soft_float))]
    pub(super) fraction: Fraction,
}

impl SlabRay {
    /// The line through `origin` with `inverse`, by axis the reciprocals of its direction; boxes
    /// are enlarged by `margin` on each side. `far`: by axis the way to the farthest corner of the
    /// model. The products of all numbers with the model's size must stay finite.
    #[inline(always)]
    #[cfg_attr(not(meshsweep_soft_float), allow(unused_variables))]
    pub fn new(origin: [f32; 3], inverse: [f32; 3], margin: [f32; 3], far: [f32; 3]) -> Self {
        let [ix, iy, iz] = inverse;
        let [mx, my, mz] = margin;
        let row = |x: f32, axis: usize| 2 * axis + (x.to_bits() >> 31) as usize;
        SlabRay {
            origin: by_axis(origin),
            inverse: by_axis(inverse),
            grow: by_axis([mx * ix.abs(), my * iy.abs(), mz * iz.abs()]),
            near: [row(ix, 0), row(iy, 1), row(iz, 2)],
            #[cfg(any(all(test, meshsweep_wide), meshsweep_soft_float))]
            fraction: Fraction::new(inverse, far),
        }
    }
}
