//! The triangles of a file by its own numbers: before any vertex was rounded to `f32` or merged,
//! and before any triangle was dropped.
//!
//! Coordinates are those that the reader gives, in `f64`. What lies between them and the file (the
//! text's decimals, transforms, another unit) is a margin, which the proofs add.

use super::enclosure::Surface;
use crate::mesh::RawMesh;

/// The triangles of a file, in a local frame.
pub(super) struct FileSurface {
    pub(super) surface: Surface,
    /// Upper bound of the distance of any vertex from its place in the file, local frame.
    pub(super) error: f64,
}

impl FileSurface {
    /// In the frame whose unit is 2^`scale_exponent`.
    pub(super) fn new(raw: &RawMesh, scale_exponent: i32) -> Self {
        let scale = 2f64.powi(-scale_exponent);
        let positions = raw.positions.iter().map(|p| p.map(|x| x * scale)).collect();
        let surface = Surface { positions, triangles: raw.triangles.clone() };
        Self { surface, error: error(raw) * scale }
    }
}

/// How far a vertex may be from its place in the file.
///
/// A decimal is off by half a unit in the last place on each axis. A decimal whose nearest `f64` is
/// an `f32` counts as that number, so a file of them alone has no error.
fn error(raw: &RawMesh) -> f64 {
    let coordinates = || raw.positions.iter().flatten().copied();
    let is_f32 = coordinates().all(|x| f64::from(x as f32) == x);
    if !raw.decimal || is_f32 {
        return raw.error;
    }
    let largest = coordinates().fold(0f64, |most, x| most.max(x.abs()));
    // √3 halves of 2^-52 are less than one. Below the normal numbers the unit is absolute.
    (raw.error + f64::EPSILON * largest + 2.0 * f64::from_bits(1)).next_up()
}
