//! Triboxes as a triangle mesh.

use crate::mesh::Mesh;
use meshsweep_core::Tribox;
use meshsweep_core::internal::tribox::FACES;

/// The boundaries of triboxes, triangulated, one after another; they share no vertices. For
/// triboxes on a [grid](Tribox::on_grid) every vertex is where three planes meet, exactly, so that
/// the mesh encloses what they hold.
///
/// Counter-clockwise from outside. A flat tribox gives two sides, one with less than two dimensions
/// nothing. Where a vertex lies within an edge of a face a triangle may have no area.
#[must_use]
pub fn surface(triboxes: &[Tribox]) -> Mesh {
    let mut positions: Vec<[f32; 3]> = Vec::new();
    let mut triangles = Vec::new();
    for tribox in triboxes.iter().filter(|tribox| !tribox.is_empty()) {
        let boundary = tribox.boundary().cleaned();
        let mut number = [None; meshsweep_core::internal::tribox::VERTICES];
        for face in 0..FACES {
            let corners: Vec<u32> = boundary
                .face(face)
                .iter()
                .map(|&vertex| {
                    *number[vertex as usize].get_or_insert_with(|| {
                        positions.push(boundary.vertices[vertex as usize]);
                        positions.len() as u32 - 1
                    })
                })
                .collect();
            triangles.extend(corners.windows(2).skip(1).map(|edge| [corners[0], edge[0], edge[1]]));
        }
    }
    Mesh::new(positions, triangles)
}
