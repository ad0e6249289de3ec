//! A vector of f32 whose arithmetic boards without instructions for f32 do by integers, see
//! [`Real`]. Elsewhere it is that of the processor.

use crate::num::Real;
use core::ops::{Add, Mul, Neg, Sub};
use glam::Vec3;

/// A vector, with the operations of [`Vec3`] in the same order.
#[derive(Clone, Copy, Debug)]
pub struct RealVector {
    x: Real,
    y: Real,
    z: Real,
}

impl RealVector {
    /// The corners of a triangle. A `map` of the array stays a loop over memory at `"s"`.
    #[inline(always)]
    pub fn corners([a, b, c]: [Vec3; 3]) -> [RealVector; 3] {
        [a.into(), b.into(), c.into()]
    }

    /// The inner product.
    #[inline(always)]
    pub fn dot(self, other: RealVector) -> Real {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    /// The cross product.
    #[inline(always)]
    pub fn cross(self, other: RealVector) -> RealVector {
        let ([a, b, c], [x, y, z]) = (self.to_array(), other.to_array());
        RealVector { x: b * z - y * c, y: c * x - z * a, z: a * y - x * b }
    }

    /// Sum of absolute coordinates: an upper bound of the length.
    #[inline(always)]
    pub fn norm_1(self) -> Real {
        let [x, y, z] = self.to_array();
        Real(x.0.abs()) + Real(y.0.abs()) + Real(z.0.abs())
    }

    #[inline(always)]
    fn to_array(self) -> [Real; 3] {
        [self.x, self.y, self.z]
    }
}

impl From<Vec3> for RealVector {
    #[inline(always)]
    fn from(vector: Vec3) -> RealVector {
        RealVector { x: Real(vector.x), y: Real(vector.y), z: Real(vector.z) }
    }
}

impl From<RealVector> for Vec3 {
    #[inline(always)]
    fn from(RealVector { x, y, z }: RealVector) -> Vec3 {
        Vec3::new(x.0, y.0, z.0)
    }
}

impl Add for RealVector {
    type Output = RealVector;

    #[inline(always)]
    fn add(self, other: RealVector) -> RealVector {
        RealVector { x: self.x + other.x, y: self.y + other.y, z: self.z + other.z }
    }
}

impl Sub for RealVector {
    type Output = RealVector;

    #[inline(always)]
    fn sub(self, other: RealVector) -> RealVector {
        RealVector { x: self.x - other.x, y: self.y - other.y, z: self.z - other.z }
    }
}

impl Neg for RealVector {
    type Output = RealVector;

    #[inline(always)]
    fn neg(self) -> RealVector {
        RealVector { x: -self.x, y: -self.y, z: -self.z }
    }
}

impl Mul<Real> for RealVector {
    type Output = RealVector;

    #[inline(always)]
    fn mul(self, factor: Real) -> RealVector {
        RealVector { x: self.x * factor, y: self.y * factor, z: self.z * factor }
    }
}
