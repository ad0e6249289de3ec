//! The box tree of a mesh for the builders' own distances.

use super::build::{Purpose, TreeOptions, build_in};
use crate::error::BuildError;
use crate::mesh::{Mesh, Wire};
use crate::progress::Watch;

/// A blob of a mesh's box tree with vertices in f32, for distances. It numbers triangles, then
/// wires, as the mesh does: two triangles may share a number of the input file.
///
/// # Errors
/// As [`build`](super::build).
pub fn exact_blob(mesh: &Mesh) -> Result<Vec<u8>, BuildError> {
    exact_blob_watched(mesh, Watch::NONE)
}

/// [`exact_blob`] under a watch.
pub(crate) fn exact_blob_watched(mesh: &Mesh, watch: Watch<'_>) -> Result<Vec<u8>, BuildError> {
    blob(mesh, Purpose::Asked, watch)
}

/// [`exact_blob`] for about so many questions. Where they are few, a quick build saves more time
/// than its tree costs.
///
/// # Errors
/// As [`build`](super::build).
pub fn blob_for(mesh: &Mesh, questions: usize) -> Result<Vec<u8>, BuildError> {
    let are_few = questions < 4 * mesh.triangles.len();
    let purpose = if are_few { Purpose::AskedLittle } else { Purpose::Asked };
    blob(mesh, purpose, Watch::NONE)
}

fn blob(mesh: &Mesh, purpose: Purpose, watch: Watch<'_>) -> Result<Vec<u8>, BuildError> {
    let count = mesh.triangles.len() as u32;
    let renumber = |(wire, number): (&Wire, u32)| Wire { source: number, ..*wire };
    let mesh = Mesh {
        wires: mesh.wires.iter().zip(count..).map(renumber).collect(),
        ..Mesh::new(mesh.positions.clone(), mesh.triangles.clone())
    };
    let options = TreeOptions::default().with_segments(false).with_f32(true);
    Ok(build_in(mesh.as_input(), &options, purpose, watch)?.0.to_bytes())
}
