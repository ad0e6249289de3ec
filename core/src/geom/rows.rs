//! A 3×3 matrix in f32, by its rows.

use crate::num::dot;
use glam::Vec3;

/// The rows of a matrix.
pub(crate) type Rows = [Vec3; 3];

/// The product of a matrix and a vector.
#[inline(always)]
pub(crate) fn turned([x, y, z]: &Rows, v: Vec3) -> Vec3 {
    Vec3::new(dot(*x, v), dot(*y, v), dot(*z, v))
}

/// The columns of a matrix.
#[inline(always)]
pub(crate) fn columns([x, y, z]: &Rows) -> Rows {
    [Vec3::new(x.x, y.x, z.x), Vec3::new(x.y, y.y, z.y), Vec3::new(x.z, y.z, z.z)]
}
