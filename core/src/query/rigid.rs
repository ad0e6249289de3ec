//! Which matrices are rotations. Derivation: `core/docs/rounding.md` §25.

use super::error::QueryError;
use crate::geom::Pose;
use crate::num::greater;
use crate::num::tolerance::{RIGID, U32};

type Rows = [[f32; 3]; 3];

fn dot([a, b, c]: [f32; 3], [x, y, z]: [f32; 3]) -> f32 {
    (a * x + b * y) + c * z
}

/// How far the rows are from orthonormal: the largest row sum of `RRᵀ − 1`, rounded. Not a number
/// if an entry is none.
#[inline(always)]
pub(crate) fn skew(&[a, b, c]: &Rows) -> f32 {
    let (aa, bb, cc) = ((dot(a, a) - 1.0).abs(), (dot(b, b) - 1.0).abs(), (dot(c, c) - 1.0).abs());
    let (ab, bc, ca) = (dot(a, b).abs(), dot(b, c).abs(), dot(c, a).abs());
    // An entry that is no number is in each of the three.
    greater(greater(aa + ab + ca, bb + ab + bc), cc + bc + ca)
}

/// An upper bound of the factor by which a matrix makes lengths longer, from its [`skew`].
#[inline(always)]
pub(crate) fn longest(skew: f32) -> f32 {
    (1.0 + 0.5 * skew) * (1.0 + 32.0 * U32)
}

/// Whether a matrix of this [`skew`] is a rotation up to [`RIGID`], and no mirror.
#[inline(always)]
pub(crate) fn is_rotation(&[a, b, c]: &Rows, skew: f32) -> bool {
    let ([ax, ay, az], [bx, by, bz]) = (a, b);
    let across = [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];
    skew <= RIGID && dot(across, c) > 0.0
}

/// Refuses a matrix that is no rotation, unless the pose says that it may be any.
#[inline(always)]
pub(crate) fn check_rigid(pose: &Pose) -> Result<(), QueryError> {
    if pose.is_affine || is_rotation(&pose.rotation, skew(&pose.rotation)) {
        Ok(())
    } else {
        Err(refused(pose))
    }
}

#[cold]
fn refused(pose: &Pose) -> QueryError {
    let mut entries = pose.rotation.iter().flatten();
    if entries.all(|x| x.is_finite()) { QueryError::NotRigid } else { QueryError::NotFinite }
}
