//! The constraint of a linear program.

use glam::DVec3;

/// The points `x` with `normal · x >= offset`.
///
/// The normal has length 1 to within rounding, or is zero: then the half-space is everything if
/// `offset <= 0` and nothing otherwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfSpace {
    /// Unit vector into the half-space, or zero.
    pub normal: DVec3,
    /// Distance of the bounding plane from the origin, along `normal`, in star radii.
    pub offset: f64,
}
