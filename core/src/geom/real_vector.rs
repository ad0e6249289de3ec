//! A vector of f32 whose arithmetic boards without instructions for f32 do by integers, see
//! [`Real`]. Elsewhere it is that of the processor.

use crate::num::Real;
use core::ops::{Mul, Neg, Sub};
use glam::Vec3;

/// A vector, with the operations of [`Vec3`] in the same order.
#[derive(Clone, Copy, Debug)]
pub struct RealVector {
    x: Real,
    y: Real,
    z: Real,
}

impl RealVector {
    /// The inner product.
    #[inline(always)]
    pub fn dot(self, other: RealVector) -> Real {
        self.x * other.x + self.y * other.y + self.z * other.z
    }
}

impl From<Vec3> for RealVector {
    #[inline(always)]
    fn from(vector: Vec3) -> RealVector {
        RealVector { x: Real(vector.x), y: Real(vector.y), z: Real(vector.z) }
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
