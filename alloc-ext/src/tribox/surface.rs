//! Triboxes as a triangle mesh.

use crate::mesh::Mesh;
use meshsweep_core::Tribox;
use meshsweep_core::internal::tribox::FACES;

/// The boundaries of triboxes, triangulated, one after another, counter-clockwise from outside.
/// They share no vertices. For triboxes on a [grid](Tribox::on_grid) every vertex is the exact
/// point where three planes meet, so the mesh encloses all that the triboxes hold.
///
/// A flat tribox gives two sides, a segment or a point nothing. A triangle may have no area where a
/// vertex lies within an edge of a face.
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
