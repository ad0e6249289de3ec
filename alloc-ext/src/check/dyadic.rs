//! Numbers m · 2^e: sums and products of floats, without rounding.

use std::cmp::Ordering;
use std::ops::{Add, Mul, Sub};

use num_bigint::BigInt;
use num_traits::{Signed, ToPrimitive, Zero};

use super::vector::{cross, dot};

/// An exact number.
#[derive(Clone, Debug)]
pub struct Dyadic {
    mantissa: BigInt,
    exponent: i32,
}

impl From<f64> for Dyadic {
    /// # Panics
    /// If the number is not finite.
    fn from(x: f64) -> Self {
        assert!(x.is_finite(), "{x} is no number");
        let bits = x.abs().to_bits();
        let (field, fraction) = ((bits >> 52) as i32, bits & ((1 << 52) - 1));
        let (mantissa, exponent) =
            if field == 0 { (fraction, -1074) } else { (fraction | 1 << 52, field - 1075) };
        let zeros = if mantissa == 0 { 0 } else { mantissa.trailing_zeros() };
        let odd = BigInt::from(mantissa >> zeros);
        Self {
            mantissa: if x < 0.0 { -odd } else { odd },
            exponent: exponent + zeros.cast_signed(),
        }
    }
}

impl Dyadic {
    /// The nearest f64, or one of its neighbours.
    pub fn rounded(&self) -> f64 {
        let bits = self.mantissa.bits() as i32;
        // A mantissa of more than 64 bits loses its last ones first: converting it whole could
        // overflow.
        let cut = (bits - 64).max(0);
        let kept = (&self.mantissa >> cut.unsigned_abs()).to_f64().unwrap_or(0.0);
        let exponent = self.exponent + cut;
        let half = exponent / 2;
        kept * 2f64.powi(half) * 2f64.powi(exponent - half)
    }

    /// 1 above 0, −1 below.
    pub fn sign(&self) -> i8 {
        i8::from(self.mantissa.is_positive()) - i8::from(self.mantissa.is_negative())
    }

    /// The same number with an exponent that is not greater than its own.
    fn lowered(&self, exponent: i32) -> BigInt {
        if self.mantissa.is_zero() {
            BigInt::zero()
        } else {
            &self.mantissa << (self.exponent - exponent).unsigned_abs()
        }
    }

    fn combined(&self, other: &Self, with: impl Fn(BigInt, BigInt) -> BigInt) -> Self {
        let exponent = match (self.mantissa.is_zero(), other.mantissa.is_zero()) {
            (true, _) => other.exponent,
            (_, true) => self.exponent,
            _ => self.exponent.min(other.exponent),
        };
        Self { mantissa: with(self.lowered(exponent), other.lowered(exponent)), exponent }
    }
}

impl Add for &Dyadic {
    type Output = Dyadic;
    fn add(self, other: Self) -> Dyadic {
        self.combined(other, |a, b| a + b)
    }
}

impl Sub for &Dyadic {
    type Output = Dyadic;
    fn sub(self, other: Self) -> Dyadic {
        self.combined(other, |a, b| a - b)
    }
}

impl Mul for &Dyadic {
    type Output = Dyadic;
    fn mul(self, other: Self) -> Dyadic {
        Dyadic {
            mantissa: &self.mantissa * &other.mantissa,
            exponent: self.exponent + other.exponent,
        }
    }
}

impl PartialEq for Dyadic {
    fn eq(&self, other: &Self) -> bool {
        (self - other).mantissa.is_zero()
    }
}

impl PartialOrd for Dyadic {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some((self - other).mantissa.cmp(&BigInt::zero()))
    }
}

/// Whether a symmetric matrix has no negative eigenvalue: all its principal minors are at least 0.
pub fn is_semidefinite(m: &[[Dyadic; 3]; 3]) -> bool {
    let pair = |i: usize, j: usize| &(&m[i][i] * &m[j][j]) - &(&m[i][j] * &m[j][i]);
    let all = dot(&m[0], &cross(&m[1], &m[2]));
    (0..3).all(|i| m[i][i].sign() >= 0)
        && [(0, 1), (1, 2), (0, 2)].into_iter().all(|(i, j)| pair(i, j).sign() >= 0)
        && all.sign() >= 0
}

#[cfg(test)]
mod tests {
    use super::{Dyadic, is_semidefinite};

    fn matrix(rows: [[f64; 3]; 3]) -> [[Dyadic; 3]; 3] {
        rows.map(|row| row.map(Dyadic::from))
    }

    #[test]
    fn sums_and_products_do_not_round() {
        let [one, tiny] = [1.0, f64::MIN_POSITIVE * 0.25].map(Dyadic::from);
        let sum = &one + &tiny;
        assert!(sum > one && &sum - &one == tiny);
        assert!(&(&tiny * &tiny) - &tiny < Dyadic::from(0.0));
        assert!((&Dyadic::from(0.1) + &Dyadic::from(0.2)) != Dyadic::from(0.1 + 0.2));
    }

    #[test]
    fn a_matrix_with_a_negative_direction_is_not_semidefinite() {
        assert!(is_semidefinite(&matrix([[0.0; 3]; 3])));
        assert!(is_semidefinite(&matrix([[1.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0, 0.0, 0.0]])));
        assert!(!is_semidefinite(&matrix([[1.0, 1.0, 0.0], [1.0, 0.999, 0.0], [0.0, 0.0, 1.0]])));
        assert!(!is_semidefinite(&matrix([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1e-300]])));
        assert!(!is_semidefinite(&matrix([
            [1.0, -0.6, -0.6],
            [-0.6, 1.0, -0.6],
            [-0.6, -0.6, 1.0]
        ])));
    }
}
