//! Which matrices are rotations. Derivation: `core/docs/rounding.md` §25.

use crate::geom::{self, Pose, Rows};
use crate::num::tolerance::{RIGID, TRIBOX_TURN, U32};
use crate::num::{dot, each, greater};
use crate::query::error::QueryError;
use glam::Vec3;

/// How far a matrix is from a rotation or a reflection: the largest row sum of `RRᵀ − 1`, which
/// bounds the 2-norm of `RᵀR − 1`. Rounded; not a number if an entry is none.
#[inline(always)]
pub(crate) fn skew(&[a, b, c]: &Rows) -> f32 {
    let (aa, bb, cc) = ((dot(a, a) - 1.0).abs(), (dot(b, b) - 1.0).abs(), (dot(c, c) - 1.0).abs());
    let (ab, bc, ca) = (dot(a, b).abs(), dot(b, c).abs(), dot(c, a).abs());
    // An entry that is no number is in each of the three.
    greater(greater(aa + ab + ca, bb + ab + bc), cc + bc + ca)
}

/// The same of a pose's matrix.
#[inline(always)]
pub(crate) fn skew_of(rows: &[[f32; 3]; 3]) -> f32 {
    skew(&each(*rows, Vec3::from_array))
}

/// An upper bound of the factor by which a matrix makes lengths longer, from its [`skew`].
#[inline(always)]
pub(crate) fn longest(skew: f32) -> f32 {
    (1.0 + 0.5 * skew) * (1.0 + 32.0 * U32)
}

/// Whether a matrix of this [`skew`] is a rotation up to [`RIGID`], and no mirror.
#[inline(always)]
pub(crate) fn is_rotation(&[a, b, c]: &[[f32; 3]; 3], skew: f32) -> bool {
    skew <= RIGID && geom::dot(geom::cross(a, b), c) > 0.0
}

/// Whether rows are those of a rotation, as near as f32 holds one: up to [`TRIBOX_TURN`].
pub(crate) fn is_turn(rows: &[[f32; 3]; 3]) -> bool {
    let skew = skew_of(rows);
    is_rotation(rows, skew) && skew <= TRIBOX_TURN
}

/// Refuses a matrix that is no rotation, unless the pose says that it may be any.
#[inline(always)]
pub(crate) fn check_rigid(pose: &Pose) -> Result<(), QueryError> {
    if pose.is_affine || is_rotation(&pose.rotation, skew_of(&pose.rotation)) {
        Ok(())
    } else {
        Err(refused(pose))
    }
}

/// The same, and the matrix's [`skew`].
#[inline(always)]
pub(crate) fn checked_skew(pose: &Pose) -> Result<f32, QueryError> {
    let skew = skew_of(&pose.rotation);
    if pose.is_affine || is_rotation(&pose.rotation, skew) { Ok(skew) } else { Err(refused(pose)) }
}

#[cold]
fn refused(pose: &Pose) -> QueryError {
    let mut entries = pose.rotation.iter().flatten();
    if entries.all(|x| x.is_finite()) { QueryError::NotRigid } else { QueryError::NotFinite }
}
