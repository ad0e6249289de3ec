//! f32 whose products, sums and comparisons are made of integers on targets without instructions
//! for f32: the same bits in half of the time of the compiler's library.
//!
//! The library's functions serve every number. Here numbers that are not normal, and results that
//! may not be, are left to the library. So is every division.

use super::SOFT_FLOAT;
use core::cmp::Ordering;
use core::ops::{Add, Mul, Neg, Sub};

/// An f32. No operand is NaN: without instructions for f32 it would compare as a number.
#[derive(Clone, Copy, Debug)]
pub struct Real(pub f32);

const SIGN: u32 = 1 << 31;

impl Real {
    /// Zero.
    pub const ZERO: Real = Real(0.0);

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

#[inline(always)]
fn exponent(bits: u32) -> u32 {
    bits << 1 >> 24
}

/// The mantissa in the upper 24 bits.
#[inline(always)]
fn mantissa(bits: u32) -> u32 {
    bits << 8 | SIGN
}

/// The number of a mantissa with 24 bits, or of 2^24. Its highest bit adds one to the exponent.
#[inline(always)]
fn packed(sign: u32, exponent: u32, whole: u32) -> f32 {
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

/// `a * b`.
#[inline(never)]
pub fn product(a: f32, b: f32) -> f32 {
    let (x, y) = (a.to_bits(), b.to_bits());
    let (of_x, of_y) = (exponent(x), exponent(y));
    let exponent = of_x.wrapping_add(of_y).wrapping_sub(127);
    if of_x == 0 || of_y == 0 || !is_normal(exponent) || of_x == 255 || of_y == 255 {
        return rare_product(a, b);
    }
    let upper = upper_product(mantissa(x), mantissa(y));
    let (sign, lower) = ((x ^ y) & SIGN, upper << 24);
    if upper >= SIGN {
        // The library knows what is cut.
        if lower == SIGN { a * b } else { packed(sign, exponent + 1, half_up(upper >> 7)) }
    } else if lower << 1 == SIGN {
        a * b
    } else {
        packed(sign, exponent, half_up(upper >> 6))
    }
}

/// The upper word of the product of two words whose lower bytes are 0, rounded down.
#[cfg(target_arch = "arm")]
#[inline(always)]
fn upper_product(x: u32, y: u32) -> u32 {
    // The smallest processors have no wider product than this.
    let (a, b, c, d) = (x >> 20, x << 12 >> 20, y >> 20, y << 12 >> 20);
    let middle = a.wrapping_mul(d).wrapping_add(b.wrapping_mul(c));
    let middle = middle.wrapping_add(b.wrapping_mul(d) >> 12);
    (a.wrapping_mul(c) << 8).wrapping_add(middle >> 4)
}

/// The upper word of the product of two words whose lower bytes are 0, rounded down.
#[cfg(not(target_arch = "arm"))]
#[inline(always)]
fn upper_product(x: u32, y: u32) -> u32 {
    (u64::from(x) * u64::from(y) >> 32) as u32
}

#[cold]
#[inline(never)]
fn rare_product(a: f32, b: f32) -> f32 {
    let (x, y) = (a.to_bits(), b.to_bits());
    // In two parts, of which the compiler makes no comparison of f32.
    let is_zero = |bits: u32| exponent(bits) == 0 && mantissa(bits) == SIGN;
    if is_zero(x) && exponent(y) < 255 || is_zero(y) && exponent(x) < 255 {
        f32::from_bits((x ^ y) & SIGN)
    } else {
        a * b
    }
}

/// `a + b`.
#[inline(never)]
pub fn sum(a: f32, b: f32) -> f32 {
    let (mut x, mut y) = (a.to_bits(), b.to_bits());
    if x << 1 < y << 1 {
        (x, y) = (y, x);
    }
    let (mut of_x, of_y) = (exponent(x), exponent(y));
    if of_y == 0 || !is_normal(of_x) {
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
    if x << 1 == 0 {
        // Both are zero. Machined parts have many.
        return f32::from_bits(x & y);
    }
    let is_zero = exponent(y) == 0 && mantissa(y) == SIGN;
    if is_zero && is_normal(exponent(x)) {
        f32::from_bits(x)
    } else {
        f32::from_bits(x) + f32::from_bits(y)
    }
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
