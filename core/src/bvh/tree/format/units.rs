//! The grid units of a tree, and conversion between them and input units.

use super::header::BvhHeader;
use crate::num::{SOFT_FLOAT, exp2_f32, lesser};
use glam::Vec3;

/// Conversion between input units and grid units, by powers of two.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Units {
    /// Grid units of an input unit.
    inward: Power,
    /// The inverse of `inward`.
    outward: Power,
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
            inward: Power::new(half.wrapping_neg(), rest.wrapping_neg()),
            outward: Power::new(half, rest),
            surface_error: header.surface_error * power(header.grid_exponent.wrapping_neg()),
            has_place_error: false,
        }
    }

    /// A length or coordinate in grid units: exact unless it leaves f32's range.
    #[inline(always)]
    pub(crate) fn inward(&self, x: f32) -> f32 {
        self.inward.times(x)
    }

    /// A place in grid units.
    #[inline(always)]
    pub(crate) fn inward_point(&self, [x, y, z]: [f32; 3]) -> Vec3 {
        Vec3::new(self.inward(x), self.inward(y), self.inward(z))
    }

    /// The exponent of [`inward`](Self::inward)'s power of two.
    #[inline(always)]
    pub(crate) fn inward_exponent(&self) -> i32 {
        self.inward.exponent()
    }

    /// A coordinate in input units, kept finite.
    #[cfg_attr(meshsweep_wide, inline(always))]
    #[cfg_attr(not(meshsweep_wide), inline(never))]
    pub(crate) fn point(&self, p: Vec3) -> [f32; 3] {
        let mut point = p.to_array();
        for x in &mut point {
            let outward = self.outward.times(*x);
            *x = if SOFT_FLOAT && is_finite(outward) { outward } else { kept_finite(outward) };
        }
        point
    }

    /// A lower bound in input units: at least 0, and below f32's normal range 0.
    #[inline(always)]
    pub(crate) fn lower(&self, x: f32) -> f32 {
        at_least(self.outward.times(x))
    }

    /// An upper bound in input units; infinite where f32 ends.
    #[inline(always)]
    pub(crate) fn upper(&self, x: f32) -> f32 {
        if x == 0.0 { 0.0 } else { at_most(self.outward.times(x)) }
    }

    /// A length or coordinate in input units times a power of two.
    #[inline(always)]
    pub(crate) fn outward(&self, x: f32, power: f32) -> f32 {
        x * self.outward.factors[0] * power * self.outward.factors[1]
    }
}

/// A power of two, in two factors within f32's range.
#[derive(Clone, Copy, Debug)]
struct Power {
    factors: [f32; 2],
}

impl Power {
    const fn new(one: i32, other: i32) -> Power {
        Power { factors: [power(one), power(other)] }
    }

    #[inline(always)]
    fn exponent(&self) -> i32 {
        let [one, other] = self.factors;
        ((one.to_bits() >> 23) + (other.to_bits() >> 23)).cast_signed() - 2 * 127
    }

    #[inline(always)]
    fn times(&self, x: f32) -> f32 {
        if SOFT_FLOAT { self.times_in_bits(x) } else { x * self.factors[0] * self.factors[1] }
    }

    /// The same by the exponent, if number and product are in f32's normal range.
    #[inline(never)]
    fn times_in_bits(&self, x: f32) -> f32 {
        let bits = x.to_bits().cast_signed();
        let exponent = bits >> 23 & 0xFF;
        let is_normal = |exponent: i32| exponent > 0 && exponent < 0xFF;
        let by = self.exponent();
        if is_normal(exponent) && is_normal(exponent + by) {
            f32::from_bits(bits.wrapping_add(by << 23).cast_unsigned())
        } else if x == 0.0 {
            x
        } else {
            x * self.factors[0] * self.factors[1]
        }
    }
}

/// A lower bound in f32's normal range, or 0.
#[inline(always)]
pub(crate) fn at_least(x: f32) -> f32 {
    if !is_normal_and_positive(x) {
        0.0
    } else if SOFT_FLOAT {
        f32::from_bits(lesser(x.to_bits(), f32::MAX.to_bits()))
    } else {
        lesser(x, f32::MAX)
    }
}

/// An upper bound in f32's normal range, or infinite.
#[inline(always)]
pub(crate) fn at_most(x: f32) -> f32 {
    if is_normal_and_positive(x) { x } else { f32::MIN_POSITIVE }
}

/// Whether a number is at least the least normal one, or infinite.
#[inline(always)]
fn is_normal_and_positive(x: f32) -> bool {
    const LEAST: u32 = f32::MIN_POSITIVE.to_bits();
    if !SOFT_FLOAT {
        return x >= f32::MIN_POSITIVE;
    }
    x.to_bits().wrapping_sub(LEAST) <= f32::INFINITY.to_bits() - LEAST
}

/// The nearest finite number. Without an FPU it is a call, for else the compiler compares every
/// number, which is a call too.
#[cfg_attr(meshsweep_soft_float, cold, inline(never))]
#[cfg_attr(not(meshsweep_soft_float), inline(always))]
fn kept_finite(x: f32) -> f32 {
    x.clamp(-f32::MAX, f32::MAX)
}

/// Whether a number is finite, by its bits.
#[inline(always)]
fn is_finite(x: f32) -> bool {
    x.to_bits() << 1 < f32::INFINITY.to_bits() << 1
}

/// `2^exponent`, cut to the normal range of f32.
const fn power(exponent: i32) -> f32 {
    let exponent = match exponent {
        ..-126 => -126,
        128.. => 127,
        exponent => exponent,
    };
    exp2_f32(exponent)
}

#[cfg(test)]
mod tests {
    use super::Power;

    #[test]
    fn a_product_by_the_exponent_has_the_bits_of_the_product_by_factors() {
        for (one, other) in
            [(0, 0), (3, 4), (-9, -8), (70, 71), (-100, -99), (-126, -126), (127, 127)]
        {
            let power = Power::new(one, other);
            let mut bits = 0u32;
            while bits < f32::INFINITY.to_bits() {
                for x in [f32::from_bits(bits), -f32::from_bits(bits)] {
                    let product = x * power.factors[0] * power.factors[1];
                    assert_eq!(power.times_in_bits(x).to_bits(), product.to_bits(), "{x:e}");
                }
                bits += 9_973;
            }
        }
    }
}
