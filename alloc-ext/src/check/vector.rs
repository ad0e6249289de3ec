//! Vectors of numbers of any kind, exact or not.

use std::ops::{Add, Mul, Sub};

/// Numbers whose references can be calculated with.
pub trait Number: Sized {
    fn plus(&self, other: &Self) -> Self;
    fn minus(&self, other: &Self) -> Self;
    fn times(&self, other: &Self) -> Self;
}

impl<T> Number for T
where
    for<'a> &'a T: Add<Output = T> + Sub<Output = T> + Mul<Output = T>,
{
    fn plus(&self, other: &Self) -> Self {
        self + other
    }
    fn minus(&self, other: &Self) -> Self {
        self - other
    }
    fn times(&self, other: &Self) -> Self {
        self * other
    }
}

/// The difference.
pub fn minus<T: Number>(a: &[T; 3], b: &[T; 3]) -> [T; 3] {
    std::array::from_fn(|k| a[k].minus(&b[k]))
}

/// The scalar product.
pub fn dot<T: Number>(a: &[T; 3], b: &[T; 3]) -> T {
    a[0].times(&b[0]).plus(&a[1].times(&b[1])).plus(&a[2].times(&b[2]))
}

/// The vector product.
pub fn cross<T: Number>(a: &[T; 3], b: &[T; 3]) -> [T; 3] {
    [[1, 2], [2, 0], [0, 1]].map(|[i, j]| a[i].times(&b[j]).minus(&a[j].times(&b[i])))
}
