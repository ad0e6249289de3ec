//! Vectors of big integers, and the way from `f64` to them and back.

use glam::DVec3;
use num_bigint::BigInt;
use num_traits::{FromPrimitive, ToPrimitive, Zero};

/// A whole number of any size.
pub type Integer = BigInt;

/// Every input is a multiple of `2^-SHIFT`.
pub const SHIFT: i32 = 64;

/// What 1 becomes.
#[must_use]
pub fn unit() -> f64 {
    2f64.powi(SHIFT)
}

/// `value · 2^SHIFT`.
///
/// # Panics
/// If that is not a whole number.
#[must_use]
pub fn integer(value: f64) -> Integer {
    // Multiplying by a power of two is exact.
    let scaled = value * unit();
    assert!(scaled.fract() == 0.0, "{value} has digits below 2^-{SHIFT}");
    Integer::from_f64(scaled).expect("finite, for the fraction of infinity is no number")
}

/// `numerator / denominator` to within two units of the last place, also where neither fits an
/// `f64`.
#[must_use]
pub fn ratio(numerator: &Integer, denominator: &Integer) -> f64 {
    let bits = |n: &Integer| i64::try_from(n.bits()).expect("fits the memory");
    let shift = 128 + bits(denominator) - bits(numerator);
    let quotient = if shift >= 0 {
        (numerator << shift.unsigned_abs()) / denominator
    } else {
        numerator / (denominator << shift.unsigned_abs())
    };
    // In two steps, for the power of two alone could overflow.
    let half = (shift / 2) as i32;
    quotient.to_f64().unwrap_or(f64::NAN) * 2f64.powi(-half) * 2f64.powi(half - shift as i32)
}

/// The point `homogeneous / weight`, coordinates rounded.
#[must_use]
pub fn point(homogeneous: &Vector, weight: &Integer) -> DVec3 {
    let [x, y, z] = &homogeneous.0;
    DVec3::new(ratio(x, weight), ratio(y, weight), ratio(z, weight))
}

/// `v · 2^SHIFT`.
///
/// # Panics
/// As [`integer`].
#[must_use]
pub fn shifted(v: DVec3) -> Vector {
    Vector([integer(v.x), integer(v.y), integer(v.z)])
}

/// `v` with every component rounded to a multiple of `2^-SHIFT`, so that [`shifted`] accepts it.
#[must_use]
pub fn representable(v: DVec3) -> DVec3 {
    (v * unit()).round() / unit()
}

/// Three big integers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Vector(pub [Integer; 3]);

impl Vector {
    /// Three zeros.
    #[must_use]
    pub fn zero() -> Self {
        Self([Integer::zero(), Integer::zero(), Integer::zero()])
    }

    /// Whether all three are zero.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.0.iter().all(Zero::is_zero)
    }

    /// The scalar product.
    #[must_use]
    pub fn dot(&self, other: &Self) -> Integer {
        let ([a, b, c], [x, y, z]) = (&self.0, &other.0);
        a * x + b * y + c * z
    }

    /// The vector product.
    #[must_use]
    pub fn cross(&self, other: &Self) -> Self {
        let ([a, b, c], [x, y, z]) = (&self.0, &other.0);
        Self([b * z - c * y, c * x - a * z, a * y - b * x])
    }

    /// The sum.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        let ([a, b, c], [x, y, z]) = (&self.0, &other.0);
        Self([a + x, b + y, c + z])
    }

    /// The multiple.
    #[must_use]
    pub fn times(&self, factor: &Integer) -> Self {
        let [a, b, c] = &self.0;
        Self([a * factor, b * factor, c * factor])
    }
}
