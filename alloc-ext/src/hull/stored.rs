//! Hulls of a blob's hierarchy as meshes, and moved outward so that they enclose the input.

use crate::mesh::Mesh;
use crate::number::AtMost;
use crate::tight::outset;
use meshsweep_core::internal::format::layout::VertexFormat;
use meshsweep_core::internal::num::exp2;
use meshsweep_core::{Hull, HullFace, VertIdx};

/// Faces of a hull as a mesh in the mesh's unit. The scale is a power of two, so its vertices are
/// exactly the stored ones.
pub fn mesh_of(hull: &Hull<'_>, faces: impl Iterator<Item = HullFace>) -> Mesh {
    placed_mesh(hull, faces, |vertex| hull.vertex(vertex))
}

/// The same with vertices that `place` puts somewhere, as those of a hull that deforms.
pub fn placed_mesh(
    hull: &Hull<'_>,
    faces: impl Iterator<Item = HullFace>,
    place: impl Fn(VertIdx) -> Option<[f32; 3]>,
) -> Mesh {
    let mut number = vec![None; hull.header().vertices as usize];
    let mut positions = Vec::new();
    let mut triangles = Vec::new();
    for face in faces {
        triangles.push(face.corners.map(|vertex: VertIdx| {
            *number[vertex.usize()].get_or_insert_with(|| {
                positions.push(place(vertex).unwrap_or_default());
                positions.len() as u32 - 1
            })
        }));
    }
    Mesh::new(positions, triangles)
}

/// A hull of a hierarchy as [`mesh_of`] gives it, moved outward so that it encloses the input as it
/// was before its vertices moved; as it is, if none did, or if the hierarchy
/// [encloses](Hull::encloses) nothing. It may have fewer faces.
///
/// The stored hulls enclose the surface as stored. The input may stick out of that by
/// [`Hull::surface_error`]. `None` if no move is proved to suffice, or if the surface error is more
/// than rounding explains: it then tells how far triangles without area are from the others.
#[must_use]
pub fn enclosing_input(hierarchy: &Hull<'_>, hull: &Mesh) -> Option<Mesh> {
    let error = f64::from(hierarchy.surface_error());
    if error <= 0.0 || !hierarchy.encloses() {
        return Some(hull.clone());
    }
    let header = hierarchy.header();
    // Local coordinates are below 1. Half the diagonal of a cell, and of a cube of half units in
    // the last place.
    let step = match header.vertex_format {
        VertexFormat::F32 => 0.0,
        _ => exp2(header.grid_exponent),
    };
    let rounding = 0.87 * step + exp2(-24);
    if f64::from(header.surface_error) > rounding {
        return None;
    }
    // A level of a cut blob encloses the surface that is gone. What keeps the distance from the
    // level keeps it from that surface.
    let finest = hierarchy.levels().last().filter(|_| !hierarchy.is_cut());
    let finest = finest.map(|level| mesh_of(hierarchy, hierarchy.faces(&level)));
    outset(hull, finest.as_ref().unwrap_or(hull), error)
}

/// Says that the input may stick out of stored hulls by up to `error`, if that is not 0.
#[must_use]
pub fn sticks_out_note(error: f64) -> Option<String> {
    (error > 0.0).then(|| {
        format!(
            "as stored, levels enclose the mesh with moved vertices; the input may stick out by up \
             to {}; meshsweep hull of the mesh file writes a hull that encloses it",
            AtMost(error)
        )
    })
}
