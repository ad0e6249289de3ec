//! The distance of wires from the surface, which a hull hierarchy carries in its surface error.

use crate::bvh::exact_blob;
use crate::error::BuildError;
use crate::hausdorff::{farthest, nearest_in};
use crate::mesh::Mesh;
use crate::number::AtMost;
use glam::Vec3;
use meshsweep_core::Bvh;

/// Upper bound of the distance from a point of a [wire](crate::mesh::Wire) to the triangles with an
/// area, input units; 0 without wires, infinite without triangles.
///
/// The split tables hold triangles with an area only. So the hull hierarchy treats the wires as
/// points of the surface that were moved onto it by at most this distance.
///
/// Cost: a box tree of the mesh, and some dozen closest points for each wire.
///
/// # Errors
/// [`BuildError`] of the box tree.
pub fn wires_off_surface(mesh: &Mesh) -> Result<f64, BuildError> {
    if mesh.wires.is_empty() {
        return Ok(0.0);
    }
    if mesh.triangles.is_empty() {
        return Ok(f64::INFINITY);
    }
    let surface = mesh.without_wires();
    let bytes = exact_blob(&surface)?;
    let tree = Bvh::open(&bytes).map_err(BuildError::Reopen)?;
    let wires = mesh.wire_corners().map(|corners| corners.map(|p| Vec3::from(p).as_dvec3()));
    Ok(farthest(wires, 0.0, nearest_in(&tree, &surface)).upper)
}

/// Says how far the points of triangles without area lie off the surface, if any do.
#[must_use]
pub fn wires_note(off: f64) -> Option<String> {
    (off > 0.0).then(|| {
        format!(
            "triangles without area lie up to {} off the surface: hulls may leave them out by as \
             much",
            AtMost(off)
        )
    })
}
