//! The grid units of a tree, and conversion between them and input units.

use super::header::BvhHeader;
use glam::Vec3;

/// Conversion between input units and grid units, by powers of two.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Units {
    /// Grid units of an input unit: a power of two, in two factors within f32's range.
    inward: [f32; 2],
    /// The inverse of `inward`.
    outward: [f32; 2],
    /// Surface error, grid units.
    pub(crate) surface_error: f32,
    /// A part of the surface error is one of the query's place.
    pub(crate) has_place_error: bool,
}

impl Units {
    pub(super) const fn new(header: &BvhHeader, scale_exponent: i32) -> Units {
        let exponent = scale_exponent.wrapping_add(header.grid_exponent);
        let half = exponent / 2;
        let rest = exponent.wrapping_sub(half);
        Units {
            inward: [power(half.wrapping_neg()), power(rest.wrapping_neg())],
            outward: [power(half), power(rest)],
            surface_error: header.surface_error * power(header.grid_exponent.wrapping_neg()),
            has_place_error: false,
        }
    }

    /// A length or coordinate in grid units: exact unless it leaves f32's range.
    #[inline(always)]
    pub(crate) fn inward(&self, x: f32) -> f32 {
        x * self.inward[0] * self.inward[1]
    }

    /// The exponent of [`inward`](Self::inward)'s power of two.
    #[inline(always)]
    pub(crate) fn inward_exponent(&self) -> i32 {
        let [half, rest] = self.inward.map(|power| (power.to_bits() >> 23).cast_signed() - 127);
        half + rest
    }

    /// A coordinate in input units, kept finite.
    #[cfg_attr(any(target_arch = "x86_64", target_arch = "aarch64"), inline(always))]
    #[cfg_attr(not(any(target_arch = "x86_64", target_arch = "aarch64")), inline(never))]
    pub(crate) fn point(&self, p: Vec3) -> [f32; 3] {
        let outward = |x: f32| self.outward(x, 1.0).clamp(-f32::MAX, f32::MAX);
        [outward(p.x), outward(p.y), outward(p.z)]
    }

    /// A lower bound in input units: at least 0, and below f32's normal range 0.
    #[inline(always)]
    pub(crate) fn lower(&self, x: f32) -> f32 {
        at_least(x * self.outward[0] * self.outward[1])
    }

    /// An upper bound in input units; infinite where f32 ends.
    #[inline(always)]
    pub(crate) fn upper(&self, x: f32) -> f32 {
        if x == 0.0 { 0.0 } else { at_most(x * self.outward[0] * self.outward[1]) }
    }

    /// A length or coordinate in input units times a power of two.
    #[inline(always)]
    pub(crate) fn outward(&self, x: f32, power: f32) -> f32 {
        x * self.outward[0] * power * self.outward[1]
    }
}

/// A lower bound in f32's normal range, or 0.
#[inline(always)]
pub(crate) fn at_least(x: f32) -> f32 {
    if x >= f32::MIN_POSITIVE { x.min(f32::MAX) } else { 0.0 }
}

/// An upper bound in f32's normal range, or infinite.
#[inline(always)]
pub(crate) fn at_most(x: f32) -> f32 {
    if x >= f32::MIN_POSITIVE { x } else { f32::MIN_POSITIVE }
}

/// `2^exponent`, exactly, within f32's range.
const fn power(exponent: i32) -> f32 {
    let exponent = match exponent {
        ..-126 => -126,
        128.. => 127,
        exponent => exponent,
    };
    f32::from_bits((127 + exponent).cast_unsigned() << 23)
}
