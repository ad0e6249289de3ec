//! Numbers of 106 bits: unevaluated sums of two `f64` (Dekker 1971; Knuth, TAOCP 4.2.2).
//!
//! The relative error of one operation is below 2^-102 while nothing overflows and no product falls
//! below 2^-960. Sums of two `f64` are exact, so differences of `f32` coordinates lose nothing
//! however far apart their exponents are (up to 2^106).

use std::ops::{Add, Div, Mul, Neg, Sub};

/// An unevaluated sum `hi + lo`, `|lo| ≤ ½ ulp(hi)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Double {
    /// The sum rounded to `f64`.
    pub hi: f64,
    /// What rounding left.
    pub lo: f64,
}

/// Three numbers of 106 bits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vector(pub [Double; 3]);

/// `a + b` exactly.
fn two_sum(a: f64, b: f64) -> Double {
    let hi = a + b;
    let b_part = hi - a;
    let a_part = hi - b_part;
    Double { hi, lo: (a - a_part) + (b - b_part) }
}

/// `a · b` exactly, by splitting each factor into halves of 26 bits.
fn two_product(a: f64, b: f64) -> Double {
    let halves = |x: f64| {
        let c = 134_217_729.0 * x;
        let high = c - (c - x);
        (high, x - high)
    };
    let hi = a * b;
    let ((ah, al), (bh, bl)) = (halves(a), halves(b));
    Double { hi, lo: ((ah * bh - hi) + ah * bl + al * bh) + al * bl }
}

impl Double {
    /// Zero.
    pub const ZERO: Double = Double { hi: 0.0, lo: 0.0 };
    /// One.
    pub const ONE: Double = Double { hi: 1.0, lo: 0.0 };

    /// An `f64`, exactly.
    #[must_use]
    pub fn new(x: f64) -> Self {
        Double { hi: x, lo: 0.0 }
    }

    /// Square root; 0 for what is not positive.
    #[must_use]
    pub fn sqrt(self) -> Self {
        if self.hi <= 0.0 {
            return Double::ZERO;
        }
        // One step of Newton's method doubles the 53 bits of the hardware's root.
        let root = Double::new(self.hi.sqrt());
        root + (self - root * root) * Double::new(0.5 / root.hi)
    }

    /// Whether it is above zero.
    #[must_use]
    pub fn is_positive(self) -> bool {
        self.hi > 0.0 || (self.hi == 0.0 && self.lo > 0.0)
    }

    /// Into [0, 1].
    #[must_use]
    pub fn clamp_unit(self) -> Self {
        if !self.is_positive() {
            Double::ZERO
        } else if (self - Double::ONE).is_positive() {
            Double::ONE
        } else {
            self
        }
    }
}

impl Add for Double {
    type Output = Double;

    fn add(self, other: Double) -> Double {
        let (s, t) = (two_sum(self.hi, other.hi), two_sum(self.lo, other.lo));
        let c = two_sum(s.hi, s.lo + t.hi);
        two_sum(c.hi, c.lo + t.lo)
    }
}

impl Neg for Double {
    type Output = Double;

    fn neg(self) -> Double {
        Double { hi: -self.hi, lo: -self.lo }
    }
}

impl Sub for Double {
    type Output = Double;

    fn sub(self, other: Double) -> Double {
        self + -other
    }
}

impl Mul for Double {
    type Output = Double;

    fn mul(self, other: Double) -> Double {
        let p = two_product(self.hi, other.hi);
        two_sum(p.hi, p.lo + (self.hi * other.lo + self.lo * other.hi))
    }
}

impl Div for Double {
    type Output = Double;

    fn div(self, other: Double) -> Double {
        let first = self.hi / other.hi;
        let rest = self - other * Double::new(first);
        let second = rest.hi / other.hi;
        let rest = rest - other * Double::new(second);
        two_sum(first, second) + Double::new(rest.hi / other.hi)
    }
}

impl Vector {
    /// Three `f32`, exactly.
    #[must_use]
    pub fn new(p: [f32; 3]) -> Self {
        Vector(p.map(|x| Double::new(f64::from(x))))
    }

    /// The difference.
    #[must_use]
    pub fn minus(&self, other: &Self) -> Self {
        Vector(std::array::from_fn(|k| self.0[k] - other.0[k]))
    }

    /// The sum.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        Vector(std::array::from_fn(|k| self.0[k] + other.0[k]))
    }

    /// The multiple.
    #[must_use]
    pub fn times(&self, factor: Double) -> Self {
        Vector(self.0.map(|x| x * factor))
    }

    /// The scalar product.
    #[must_use]
    pub fn dot(&self, other: &Self) -> Double {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        a * x + b * y + c * z
    }

    /// The vector product.
    #[must_use]
    pub fn cross(&self, other: &Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        Vector([b * z - c * y, c * x - a * z, a * y - b * x])
    }

    /// Sum of the absolute coordinates, in `f64`.
    #[must_use]
    pub fn norm_1(&self) -> f64 {
        self.0.iter().map(|x| x.hi.abs()).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_and_products_keep_106_bits() {
        let tiny = 2f64.powi(-100);
        let x = Double::ONE + Double::new(tiny);
        assert_eq!((x - Double::ONE).hi, tiny);
        assert_eq!((x * x - Double::ONE - Double::new(2.0 * tiny)).hi, 0.0);
        let third = Double::ONE / Double::new(3.0);
        assert!((third * Double::new(3.0) - Double::ONE).hi.abs() < 1e-30);
        let root = Double::new(2.0).sqrt();
        assert!((root * root - Double::new(2.0)).hi.abs() < 1e-30);
    }
}
