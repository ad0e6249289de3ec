//! Whether the stored surface shows a point the same side as the input's.
//!
//! A vertex moves by at most the surface error. A point farther from the surface keeps its winding
//! number. But where a wall is thinner than the error, its faces may change places. Then the
//! nearest stored face has its back to a point outside.
//!
//! *What is proved.* The stored surface is a closed manifold, its faces share no points but common
//! corners and edges, and it winds 0 or 1 times around every point that is not on it. So a face has
//! its front to a point exactly if the point's winding number is 0. The proof looks at the stored
//! surface alone. It holds for every input within the error whose winding numbers are 0 and 1. A
//! surface that is inside out is not proved: a thin solid may be stored so.

use super::store::OnGrid;
use crate::mesh::Mesh;
use crate::surface::{Solid, faces, is_degenerate, is_embedded};

/// Whether the stored surface certainly shows every point farther than the surface error the
/// input's side, for a closed mesh that bounds a solid.
///
/// Cost: nothing if no vertex moved. Else one query of a static tree for each triangle, and a test
/// for each pair of connected components.
pub(super) fn are_kept(mesh: &Mesh, grid: &OnGrid) -> bool {
    grid.surface_error == 0.0 || bounds_a_solid(mesh, grid)
}

fn bounds_a_solid(mesh: &Mesh, grid: &OnGrid) -> bool {
    let faces = faces(&grid.positions, &mesh.triangles);
    if faces.iter().any(|face| is_degenerate(&face.at)) || !is_embedded(&faces) {
        return false;
    }
    // Grid coordinates are f32 numbers. `Solid::of` refuses a component whose volume may be 0. Its
    // test of nesting holds for embedded surfaces only.
    let positions = grid.positions.iter().map(|p| p.as_vec3().to_array()).collect();
    Solid::of(&Mesh::new(positions, mesh.triangles.clone())).is_ok()
}
