//! Proof of a box tree from the blob's bytes and the mesh, by a parser and arithmetic that share no
//! code with reader or builder.
//!
//! If [`check_tree`] returns `Ok`, then no descent can miss a triangle but by the rounding of the
//! query itself: every triangle of the mesh is in exactly one leaf, no farther from its place than
//! the header's surface error; every box on the way to it contains it, by exact arithmetic on the
//! stored numbers; and no frame makes a distance longer. Moments are those of the triangles below.

mod contain;
mod moments;
mod parse;
mod proof;
mod surface;

use crate::mesh::Mesh;
use parse::TreeBlob;
pub use proof::TreeProof;

/// Proves that a blob's box tree is one of `mesh`, which no vertex was moved in before but by
/// [`Mesh::rounding`].
///
/// Cost: vertices times depth.
///
/// # Errors
/// The first claim that does not hold, in words.
pub fn check_tree(bytes: &[u8], mesh: &Mesh) -> Result<TreeProof, String> {
    let tree = TreeBlob::parse(bytes)?;
    let vertices = tree.leaves.iter().map(|leaf| leaf.vertices.len()).sum();
    let mut proof = TreeProof { vertices, ..TreeProof::default() };
    let parents = contain::parents(&tree)?;
    contain::stack(&tree)?;
    contain::frames(&tree, &mut proof)?;
    contain::boxes(&tree, &parents, &mut proof)?;
    surface::triangles(&tree, mesh, &mut proof)?;
    surface::claims(&tree, mesh)?;
    moments::moments(&tree, &mut proof)?;
    Ok(proof)
}
