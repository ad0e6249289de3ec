//! The box tree of a mesh for the builders' own distances.

use super::build::{TreeOptions, build};
use crate::mesh::{Mesh, Wire};

/// A blob of a mesh's box tree with vertices in f32, for distances. It numbers triangles, then
/// wires, as the mesh does: two triangles may share a number of the input file.
///
/// # Panics
/// On a mesh of more than [`MAX_TRIANGLES`](super::MAX_TRIANGLES), and, with debug assertions, on
/// infinite coordinates.
#[must_use]
pub fn exact_blob(mesh: &Mesh) -> Vec<u8> {
    let count = mesh.triangles.len() as u32;
    let renumber = |(wire, number): (&Wire, u32)| Wire { source: number, ..*wire };
    let mesh = Mesh {
        wires: mesh.wires.iter().zip(count..).map(renumber).collect(),
        ..Mesh::new(mesh.positions.clone(), mesh.triangles.clone())
    };
    let options = TreeOptions { segments: false, single: true, ..TreeOptions::default() };
    build(mesh.as_input(), &options).0.to_bytes()
}
