//! How far wires are from the surface: what a hull hierarchy carries in its surface error.

use crate::bvh::exact_blob;
use crate::hausdorff::{farthest, nearest_in};
use crate::mesh::Mesh;
use glam::Vec3;
use meshsweep_core::Bvh;

/// A distance, input units, that no point of a [wire](crate::mesh::Wire) is farther than from the
/// triangles with an area; 0 without wires, infinite without triangles.
///
/// The split tables hold triangles with an area only. So the hull hierarchy takes the wires for
/// points of the surface that were moved onto it by this distance at most.
///
/// Cost: a box tree of the mesh, and some dozen closest points for each wire.
#[must_use]
pub fn wires_off_surface(mesh: &Mesh) -> f64 {
    if mesh.wires.is_empty() {
        return 0.0;
    }
    if mesh.triangles.is_empty() {
        return f64::INFINITY;
    }
    let surface = mesh.without_wires();
    let bytes = exact_blob(&surface);
    let tree = Bvh::open(&bytes).expect("just built");
    let wires = mesh.wire_corners().map(|corners| corners.map(|p| Vec3::from(p).as_dvec3()));
    farthest(wires, 0.0, nearest_in(&tree, &surface)).upper
}
