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
/// Of -0 it is -1.
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
    // Each way has its own end: no count is kept on it.
    let length = |down: u32| down + u32::from(OF_FOUR[(x >> down) as usize & 15]);
    if x >> 16 == 0 {
        if x >> 8 == 0 {
            if x >> 4 == 0 { length(0) } else { length(4) }
        } else if x >> 12 == 0 {
            length(8)
        } else {
            length(12)
        }
    } else if x >> 24 == 0 {
        if x >> 20 == 0 { length(16) } else { length(20) }
    } else if x >> 28 == 0 {
        length(24)
    } else {
        length(28)
    }
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

    /// Whether it is 0 or less. Of the order of a number and 0 the compiler would make a comparison
    /// of f32, which is a call.
    #[inline(always)]
    pub fn is_at_most_zero(self) -> bool {
        if SOFT_FLOAT { self.0.to_bits().cast_signed() <= 0 } else { self.0 <= 0.0 }
    }

    /// Whether it is 0 or more.
    #[inline(always)]
    pub fn is_at_least_zero(self) -> bool {
        if SOFT_FLOAT { (-self).is_at_most_zero() } else { self.0 >= 0.0 }
    }

    /// The order of these integers is that of the numbers.
    #[inline(always)]
    pub fn order(self) -> i32 {
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
    // The signs are added as well: what is carried out of them leaves the word.
    let head = (x >> 23).wrapping_add(y >> 23).wrapping_sub(127);
    let (upper, is_cut) = upper_product(mantissa(x), mantissa(y));
    if upper < SIGN {
        rounded(head.wrapping_sub(1), upper >> 7, upper << 25, is_cut)
    } else {
        rounded(head, upper >> 8, upper << 24, is_cut)
    }
}

/// The number of a mantissa with 24 bits, rounded. Its highest bit adds one to `head`, the sign and
/// the exponent. `rest` follows the mantissa; `is_cut` tells whether anything follows that.
#[inline(always)]
fn rounded(head: u32, mantissa: u32, rest: u32, is_cut: bool) -> f32 {
    // 2^24 after the rounding adds one more.
    let bits = (head << 23).wrapping_add(mantissa);
    f32::from_bits(if rest < SIGN {
        bits
    } else if rest == SIGN && !is_cut {
        bits.wrapping_add(bits & 1)
    } else {
        bits.wrapping_add(1)
    })
}

/// The product of two mantissas in the upper 24 bits, rounded: a mantissa of 24 bits, or 2^24, and
/// what is added to the exponent.
#[inline(always)]
pub(super) fn rounded_product(x: u32, y: u32) -> (u32, u32) {
    let (mut upper, is_cut) = upper_product(x, y);
    let carry = upper >> 31;
    if carry == 0 {
        upper <<= 1;
    }
    let mut whole = ((upper >> 7) + 1) >> 1;
    // Half of the last bit, if all that is cut is 0: to even.
    if upper << 24 == SIGN && !is_cut {
        whole &= !1;
    }
    (whole, carry)
}

/// The upper word of the product of two words whose lower bytes are 0, rounded down, and whether
/// that cuts anything.
#[cfg(meshsweep_short_products)]
#[inline(always)]
fn upper_product(x: u32, y: u32) -> (u32, bool) {
    // The smallest processors have no wider product than a word.
    let (x, a, b) = (x >> 8, y >> 24, y << 8 >> 16);
    let low = (x & 0xFFFF).wrapping_mul(b);
    let upper = x.wrapping_mul(a).wrapping_add((x >> 16).wrapping_mul(b));
    (upper.wrapping_add(low >> 16), low << 16 != 0)
}

/// The upper word of the product of two words whose lower bytes are 0, rounded down, and whether
/// that cuts anything.
#[cfg(not(meshsweep_short_products))]
#[inline(always)]
fn upper_product(x: u32, y: u32) -> (u32, bool) {
    let product = u64::from(x) * u64::from(y);
    ((product >> 32) as u32, product as u32 != 0)
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
fn sum_of_bits(x: u32, y: u32) -> f32 {
    let differing = x ^ y;
    let swapped = if x << 1 < y << 1 { differing } else { 0 };
    let (x, y) = (x ^ swapped, y ^ swapped);
    let of_x = exponent(x);
    if of_x > 253 {
        return library_sum(x, y);
    }
    if of_x < LEAST_SUMMED {
        return rare_sum(x, y);
    }
    let apart = of_x - exponent(y);
    if apart > 25 {
        // Less than a quarter of the last bit, even below a power of two. Subnormal numbers are too.
        return f32::from_bits(x);
    }
    let (larger, smaller) = (mantissa(x) >> 1, mantissa(y) >> 1);
    let cut = smaller >> apart;
    if differing < SIGN {
        let upper = larger + cut;
        let is_cut = cut << apart != smaller;
        return if upper < SIGN {
            rounded((x >> 23).wrapping_sub(1), upper >> 7, upper << 25, is_cut)
        } else {
            rounded(x >> 23, upper >> 8, upper << 24, is_cut)
        };
    }
    let (mut head, mut upper) = (x >> 23, larger - cut);
    if upper == 0 {
        return 0.0;
    }
    loop {
        (head, upper) = (head.wrapping_sub(1), upper << 1);
        if upper >= SIGN {
            break;
        }
    }
    let (mantissa, rest) = (upper >> 8, upper << 24);
    // What was cut makes it less.
    if rest < SIGN || rest == SIGN && cut << apart != smaller {
        return rounded(head, mantissa, 0, false);
    }
    rounded(head, mantissa, rest, false)
}

/// From this exponent of the larger number on, a difference is 0 or a normal number: if the exponents
/// are at most one apart it is no less than a last bit, else no less than half of the larger number.
const LEAST_SUMMED: u32 = 27;

/// `x` is the greater in magnitude.
#[cold]
#[inline(never)]
fn rare_sum(x: u32, y: u32) -> f32 {
    if is_zero(x) {
        // Both are zero.
        return f32::from_bits(x & y);
    }
    library_sum(x, y)
}

#[cold]
#[inline(never)]
fn library_sum(x: u32, y: u32) -> f32 {
    f32::from_bits(x) + f32::from_bits(y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::noise::Noise;

    impl Noise {
        fn word(&mut self) -> u32 {
            (self.bits() >> 32) as u32
        }

        /// Numbers near each other, near powers of two, near the ends of f32's range, and zeros.
        fn number(&mut self) -> f32 {
            let bits = self.word();
            let exponent = match self.word() % 8 {
                0 => bits >> 23 & 0xFF,
                1 => 253 + bits % 3,
                2 => bits % 3,
                _ => 115 + bits % 30,
            };
            let mantissa = match self.word() % 6 {
                0 => 0,
                1 => 0x7F_FFFF,
                2 => 1 << (self.word() % 23),
                3 => bits & 0x7F_F000,
                _ => self.word() & 0x7F_FFFF,
            };
            let number = f32::from_bits(self.word() & SIGN | exponent << 23 | mantissa);
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
                0 => f32::from_bits(a.to_bits() ^ (noise.word() & SIGN | 1 << (noise.word() % 8))),
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
