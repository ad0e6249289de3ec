//! Vectors of three numbers, f32 or f64.

use crate::num::tolerance::{DETERMINANT, U32, U64, UNDERFLOW_LOSS};
use core::ops::{Add, Mul, Sub};

/// A precision of vectors.
pub trait Precision:
    Copy + PartialOrd + From<f32> + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self>
{
    /// Zero.
    const ZERO: Self;
    /// Rounding of a determinant, as a part of the product of its vectors' 1-norms.
    const DETERMINANT: Self;
    /// Upper limit of the loss of a determinant and its bound by underflow.
    const UNDERFLOW_LOSS: Self;
    /// The absolute value.
    fn abs(self) -> Self;
}

impl Precision for f32 {
    const ZERO: f32 = 0.0;
    const DETERMINANT: f32 = DETERMINANT * U32;
    const UNDERFLOW_LOSS: f32 = UNDERFLOW_LOSS;
    #[inline(always)]
    fn abs(self) -> f32 {
        f32::abs(self)
    }
}

impl Precision for f64 {
    const ZERO: f64 = 0.0;
    const DETERMINANT: f64 = DETERMINANT as f64 * U64;
    const UNDERFLOW_LOSS: f64 = f64::MIN_POSITIVE;
    #[inline(always)]
    fn abs(self) -> f64 {
        f64::abs(self)
    }
}

/// A place or a direction.
pub(crate) type Point<T> = [T; 3];

#[inline(always)]
pub(crate) fn minus<T: Precision>([ax, ay, az]: Point<T>, [bx, by, bz]: Point<T>) -> Point<T> {
    [ax - bx, ay - by, az - bz]
}

#[inline(always)]
pub(crate) fn cross<T: Precision>([ax, ay, az]: Point<T>, [bx, by, bz]: Point<T>) -> Point<T> {
    [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx]
}

#[inline(always)]
pub(crate) fn dot<T: Precision>([ax, ay, az]: Point<T>, [bx, by, bz]: Point<T>) -> T {
    ax * bx + ay * by + az * bz
}

/// Sum of absolute coordinates: an upper bound of the length that needs no square root.
#[inline(always)]
pub(crate) fn norm_1<T: Precision>(v: impl Into<Point<T>>) -> T {
    let [x, y, z] = v.into();
    x.abs() + y.abs() + z.abs()
}

/// The transpose of a matrix.
pub(crate) fn transposed<T: Copy>(
    &[[a, b, c], [d, e, f], [g, h, i]]: &[Point<T>; 3],
) -> [Point<T>; 3] {
    [[a, d, g], [b, e, h], [c, f, i]]
}
