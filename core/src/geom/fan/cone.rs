//! The cone of a leaf's normals.
//!
//! After Galin & Akkouche 2005, section 6.4, and Shirman & Abi-Ezzi 1993. All triangles of a fan
//! share its centre. So the way from the centre to the eye says for each of them on which side the
//! eye is, and no bounding sphere is needed. A slip of the paper: a fan is back-facing if `n₀·d ≤
//! −sin α`, not `≤ sin α`.

use crate::num::tolerance::{CONE_SINE, LEAST_DENOMINATOR};
use glam::Vec3;

/// A cone that contains all normals of a leaf's triangles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalCone {
    /// Its axis: integers, not normalised.
    pub axis: Vec3,
    /// Sine of its half-angle, which is below a right angle; rounded up.
    pub sine: f32,
}

impl NormalCone {
    /// Whether no triangle with its normal in the cone faces the eye, for certain. `way` leads from
    /// a common point of all these triangles to the eye, or towards an eye at infinity. It may have
    /// any length that f32 can square. With a length of 0 nothing is certain.
    #[inline]
    pub fn is_behind(&self, way: Vec3) -> bool {
        let dot = |a: Vec3, b: Vec3| a.x * b.x + a.y * b.y + a.z * b.z;
        let against = -dot(self.axis, way);
        let length_sq = dot(way, way);
        let sine = self.sine + CONE_SINE;
        against > 0.0
            && length_sq > LEAST_DENOMINATOR
            && against * against > dot(self.axis, self.axis) * length_sq * (sine * sine)
    }
}
