//! f32 whose products, sums and comparisons are made of integers on targets without instructions
//! for f32: the same bits in half of the time of the compiler's library.
//!
//! The library's functions serve every number. Here numbers that are not normal, and results that
//! may not be, are left to the library. So is every division.

use super::SOFT_FLOAT;
use core::cmp::Ordering;
use core::ops::{Add, Mul, Neg, Sub};
use glam::Vec3;

/// An f32. No operand is NaN: without instructions for f32 it would compare as a number.
#[derive(Clone, Copy, Debug)]
pub struct Real(pub f32);

const SIGN: u32 = 1 << 31;

/// `a · b`.
#[inline(always)]
pub fn dot(a: Vec3, b: Vec3) -> f32 {
    let ([ax, ay, az], [bx, by, bz]) = (reals(a), reals(b));
    (ax * bx + ay * by + az * bz).0
}

/// `a − b`.
#[inline(always)]
pub fn difference(a: Vec3, b: Vec3) -> Vec3 {
    let ([ax, ay, az], [bx, by, bz]) = (reals(a), reals(b));
    Vec3::new((ax - bx).0, (ay - by).0, (az - bz).0)
}

/// The coordinates.
#[inline(always)]
pub fn reals(v: Vec3) -> [Real; 3] {
    [Real(v.x), Real(v.y), Real(v.z)]
}

/// `x as f32`, for a number below 2^24 in magnitude.
#[inline(always)]
pub fn float(x: i32) -> f32 {
    if SOFT_FLOAT { small_float(x) } else { x as f32 }
}

#[inline(never)]
fn small_float(x: i32) -> f32 {
    let size = x.unsigned_abs();
    let count = bit_length(size);
    if count == 0 || count > 24 {
        return x as f32;
    }
    packed(x.cast_unsigned() & SIGN, 126 + count, size << (24 - count))
}

/// `x · 2^exponent`, rounded down, if that is below 2^30 in magnitude; else no number of meaning.
#[inline(never)]
pub fn floored(x: f32, exponent: i32) -> i32 {
    let bits = x.to_bits();
    let size = (mantissa(bits) >> 8).cast_signed();
    let number = if bits & SIGN == 0 { size } else { -size };
    match (self::exponent(bits).cast_signed()).wrapping_add(exponent).wrapping_sub(150) {
        up @ 0.. => number.wrapping_shl(up.cast_unsigned()),
        down => number >> down.wrapping_neg().min(31),
    }
}

/// The number of bits of a number. The smallest processors have no instruction for it, and the
/// compiler's function for them takes twice as long.
#[inline(always)]
pub fn bit_length(x: u32) -> u32 {
    if cfg!(meshsweep_short_products) { bit_length_by_table(x) } else { 32 - x.leading_zeros() }
}

#[inline(never)]
fn bit_length_by_table(x: u32) -> u32 {
    const OF_FOUR: [u8; 16] = [0, 1, 2, 2, 3, 3, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4];
    let (mut x, mut count) = (x, 0);
    if x >> 16 != 0 {
        (x, count) = (x >> 16, 16);
    }
    if x >> 8 != 0 {
        (x, count) = (x >> 8, count + 8);
    }
    if x >> 4 != 0 {
        (x, count) = (x >> 4, count + 4);
    }
    count + u32::from(OF_FOUR[x as usize & 15])
}

impl Real {
    /// Zero.
    pub const ZERO: Real = Real(0.0);

    /// The product with a power of two between 2^-40 and 2^40.
    #[inline(always)]
    pub fn times_power(self, power: f32) -> Real {
        let bits = self.0.to_bits();
        if SOFT_FLOAT && is_usual(exponent(bits)) {
            let by = power.to_bits().wrapping_sub(1f32.to_bits());
            return Real(f32::from_bits(bits.wrapping_add(by)));
        }
        self * Real(power)
    }

    /// The order of these integers is that of the numbers.
    #[inline(always)]
    fn order(self) -> i32 {
        let bits = self.0.to_bits();
        let size = (bits & !SIGN).cast_signed();
        if bits & SIGN == 0 { size } else { -size }
    }
}

impl Mul for Real {
    type Output = Real;

    #[inline(always)]
    fn mul(self, other: Real) -> Real {
        Real(if SOFT_FLOAT { product(self.0, other.0) } else { self.0 * other.0 })
    }
}

impl Add for Real {
    type Output = Real;

    #[inline(always)]
    fn add(self, other: Real) -> Real {
        Real(if SOFT_FLOAT { sum(self.0, other.0) } else { self.0 + other.0 })
    }
}

impl Neg for Real {
    type Output = Real;

    #[inline(always)]
    fn neg(self) -> Real {
        Real(-self.0)
    }
}

impl Sub for Real {
    type Output = Real;

    #[inline(always)]
    fn sub(self, other: Real) -> Real {
        Real(if SOFT_FLOAT { sum(self.0, -other.0) } else { self.0 - other.0 })
    }
}

impl PartialEq for Real {
    #[inline(always)]
    fn eq(&self, other: &Real) -> bool {
        if SOFT_FLOAT { self.order() == other.order() } else { self.0 == other.0 }
    }
}

impl PartialOrd for Real {
    #[inline(always)]
    fn partial_cmp(&self, other: &Real) -> Option<Ordering> {
        if SOFT_FLOAT {
            Some(self.order().cmp(&other.order()))
        } else {
            self.0.partial_cmp(&other.0)
        }
    }

    #[inline(always)]
    fn lt(&self, other: &Real) -> bool {
        if SOFT_FLOAT { self.order() < other.order() } else { self.0 < other.0 }
    }

    #[inline(always)]
    fn le(&self, other: &Real) -> bool {
        if SOFT_FLOAT { self.order() <= other.order() } else { self.0 <= other.0 }
    }

    #[inline(always)]
    fn gt(&self, other: &Real) -> bool {
        other < self
    }

    #[inline(always)]
    fn ge(&self, other: &Real) -> bool {
        other <= self
    }
}

/// Of bits that came as bits: of those of an f32 the compiler would make a comparison of f32, which
/// is a call.
#[inline(always)]
fn is_zero(bits: u32) -> bool {
    bits << 1 == 0
}

#[inline(always)]
pub(super) fn exponent(bits: u32) -> u32 {
    bits << 1 >> 24
}

/// The mantissa in the upper 24 bits.
#[inline(always)]
pub(super) fn mantissa(bits: u32) -> u32 {
    bits << 8 | SIGN
}

/// The number of a mantissa with 24 bits, or of 2^24. Its highest bit adds one to the exponent.
#[inline(always)]
pub(super) fn packed(sign: u32, exponent: u32, whole: u32) -> f32 {
    f32::from_bits((exponent.wrapping_sub(1) << 23).wrapping_add(whole) | sign)
}

/// Half of a number, rounded up.
#[inline(always)]
fn half_up(x: u32) -> u32 {
    (x + 1) >> 1
}

/// Whether an exponent, biased, is that of a normal number even if one is added.
#[inline(always)]
fn is_normal(exponent: u32) -> bool {
    exponent.wrapping_sub(1) < 253
}

/// Whether a number is from 2^-63 to 2^64. No product of two of these leaves the range of normal
/// numbers.
#[inline(always)]
fn is_usual(exponent: u32) -> bool {
    exponent.wrapping_sub(64) < 127
}

/// `a * b`.
#[inline(always)]
pub fn product(a: f32, b: f32) -> f32 {
    product_of_bits(a.to_bits(), b.to_bits())
}

#[inline(never)]
fn product_of_bits(x: u32, y: u32) -> f32 {
    let (of_x, of_y) = (exponent(x), exponent(y));
    if !is_usual(of_x) || !is_usual(of_y) {
        // Machined parts have many zeros.
        if is_zero(x) && of_y < 255 || is_zero(y) && of_x < 255 {
            return f32::from_bits((x ^ y) & SIGN);
        }
        return rare_product(x, y);
    }
    let (whole, carry) = rounded_product(mantissa(x), mantissa(y));
    packed((x ^ y) & SIGN, of_x + of_y - 127 + carry, whole)
}

/// The product of two mantissas in the upper 24 bits, rounded: a mantissa of 24 bits, or 2^24, and
/// what is added to the exponent.
#[inline(always)]
pub(super) fn rounded_product(x: u32, y: u32) -> (u32, u32) {
    let mut upper = upper_product(x, y);
    let carry = upper >> 31;
    if carry == 0 {
        upper <<= 1;
    }
    let mut whole = half_up(upper >> 7);
    // Half of the last bit, if all that is cut is 0: to even.
    if upper << 24 == SIGN && (x >> 8).wrapping_mul(y >> 8) << 16 == 0 {
        whole &= !1;
    }
    (whole, carry)
}

/// The upper word of the product of two words whose lower bytes are 0, rounded down.
#[cfg(meshsweep_short_products)]
#[inline(always)]
fn upper_product(x: u32, y: u32) -> u32 {
    // The smallest processors have no wider product than this.
    let (a, b, c, d) = (x >> 20, x << 12 >> 20, y >> 20, y << 12 >> 20);
    let middle = a.wrapping_mul(d).wrapping_add(b.wrapping_mul(c));
    let middle = middle.wrapping_add(b.wrapping_mul(d) >> 12);
    (a.wrapping_mul(c) << 8).wrapping_add(middle >> 4)
}

/// The upper word of the product of two words whose lower bytes are 0, rounded down.
#[cfg(not(meshsweep_short_products))]
#[inline(always)]
fn upper_product(x: u32, y: u32) -> u32 {
    ((u64::from(x) * u64::from(y)) >> 32) as u32
}

#[cold]
#[inline(never)]
fn rare_product(x: u32, y: u32) -> f32 {
    f32::from_bits(x) * f32::from_bits(y)
}

/// `a + b`.
#[inline(always)]
pub fn sum(a: f32, b: f32) -> f32 {
    sum_of_bits(a.to_bits(), b.to_bits())
}

#[inline(never)]
fn sum_of_bits(mut x: u32, mut y: u32) -> f32 {
    if x << 1 < y << 1 {
        (x, y) = (y, x);
    }
    let (mut of_x, of_y) = (exponent(x), exponent(y));
    if of_y == 0 || !is_normal(of_x) {
        if is_zero(y) && is_normal(of_x) {
            return f32::from_bits(x);
        }
        return rare_sum(x, y);
    }
    let apart = of_x - of_y;
    if apart > 25 {
        // Less than a quarter of the last bit, even below a power of two.
        return f32::from_bits(x);
    }
    let smaller = mantissa(y) >> 1;
    let cut = smaller >> apart;
    let mut upper = mantissa(x) >> 1;
    let less;
    if (x ^ y) < SIGN {
        less = 0;
        upper += cut;
        if upper < SIGN {
            upper <<= 1;
        } else {
            of_x += 1;
        }
    } else {
        less = 1;
        upper = (upper - cut) << 1;
        if upper == 0 {
            return 0.0;
        }
        while upper < SIGN {
            upper <<= 1;
            of_x = of_x.wrapping_sub(1);
        }
        if !is_normal(of_x) {
            return rare_sum(x, y);
        }
    }
    let mut whole = half_up(upper >> 7);
    if upper << 24 == SIGN {
        // Half of the last bit, but for what was cut.
        whole = if cut << apart == smaller { whole & !1 } else { whole - less };
    }
    packed(x & SIGN, of_x, whole)
}

/// `x` is the greater in magnitude.
#[cold]
#[inline(never)]
fn rare_sum(x: u32, y: u32) -> f32 {
    if is_zero(x) {
        // Both are zero.
        return f32::from_bits(x & y);
    }
    f32::from_bits(x) + f32::from_bits(y)
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Noise(u64);

    impl Noise {
        fn bits(&mut self) -> u32 {
            self.0 = self
                .0
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (self.0 >> 32) as u32
        }

        /// Numbers near each other, near powers of two, near the ends of f32's range, and zeros.
        fn number(&mut self) -> f32 {
            let bits = self.bits();
            let exponent = match self.bits() % 8 {
                0 => bits >> 23 & 0xFF,
                1 => 253 + bits % 3,
                2 => bits % 3,
                _ => 115 + bits % 30,
            };
            let mantissa = match self.bits() % 6 {
                0 => 0,
                1 => 0x7F_FFFF,
                2 => 1 << (self.bits() % 23),
                3 => bits & 0x7F_F000,
                _ => self.bits() & 0x7F_FFFF,
            };
            let number = f32::from_bits(self.bits() & SIGN | exponent << 23 | mantissa);
            if number.is_nan() { f32::INFINITY } else { number }
        }
    }

    #[test]
    fn products_sums_and_order_are_those_of_the_processor() {
        let mut noise = Noise(41);
        let same = |x: f32, y: f32| x.to_bits() == y.to_bits() || x.is_nan() && y.is_nan();
        for round in 0..4_000_000 {
            let a = noise.number();
            let b = match round % 4 {
                0 => f32::from_bits(a.to_bits() ^ (noise.bits() & SIGN | 1 << (noise.bits() % 8))),
                _ => noise.number(),
            };
            if b.is_nan() {
                continue;
            }
            assert!(same(product(a, b), a * b), "{a:e} * {b:e}");
            assert!(same(sum(a, b), a + b), "{a:e} + {b:e}");
            let (x, y) = (Real(a).order(), Real(b).order());
            assert_eq!((x < y, x == y), (a < b, a == b), "{a:e} {b:e}");
        }
    }
}
