//! Proof of a box tree from the blob's bytes and the mesh, by a parser and arithmetic that share no
//! code with reader or builder.
//!
//! If [`check_tree`] returns `Ok`, then no descent can miss a triangle but by the rounding of the
//! query itself: every triangle of the mesh is in exactly one leaf, no farther from its place than
//! the header's surface error; every box on the way to it contains it, by exact arithmetic on the
//! stored numbers; and no frame makes a distance longer. Moments are those of the triangles below,
//! and normals lie in their cones.

mod chosen;
mod cones;
mod contain;
mod moments;
mod parse;
mod proof;
mod surface;

use super::enclosure::Surface;
use super::file::StoredSurface;
use super::finding::Finding;
use super::input::{Given, Stored};
use crate::mesh::{Input, Mesh, RawMesh};
use chosen::Chosen;
use parse::TreeBlob;
pub use proof::TreeProof;

pub(super) const TREE: &str = "box tree";

/// Proves that a blob's box tree is one of `mesh`, which no vertex was moved in before but by
/// [`Mesh::rounding`].
///
/// Cost: vertices times depth.
///
/// # Errors
/// The first claim that does not hold, in words.
pub fn check_tree(bytes: &[u8], mesh: &Mesh) -> Result<TreeProof, String> {
    prove_tree(bytes, mesh.as_input())
}

/// The same of a mesh whose vertices were moved before.
pub(crate) fn prove_tree(bytes: &[u8], input: Input<'_>) -> Result<TreeProof, String> {
    let tree = TreeBlob::parse(bytes)?;
    let mut proof = boxes(&tree)?;
    let chosen = Chosen::of(&tree, input.mesh);
    // What moved the mesh's vertices moved the file's.
    let rounding = input.mesh.rounding;
    let moved = [rounding, input.moved];
    let given = |mesh| Given::of(mesh, moved, tree.scale_exponent);
    let corners = surface::triangles(&tree, &given(&chosen.mesh), tree.triangles(), &mut proof)?;
    surface::closed(&tree, &chosen)?;
    surface::turned(&tree, &chosen, given)?;
    surface::sides(&tree, &corners)?;
    measures(&tree, &corners, &mut proof)?;
    Ok(proof)
}

/// Proves all of a blob's box tree but that it is the tree of a mesh.
pub(super) fn prove_faces(bytes: &[u8]) -> Result<StoredSurface, String> {
    let tree = TreeBlob::parse(bytes)?;
    let stored = stored(&tree);
    let corners = Surface::welded(stored.triangles.iter().map(|(_, corners)| *corners)).triangles;
    measures(&tree, &corners, &mut boxes(&tree)?)?;
    Ok(stored)
}

/// Proves that the file's triangles are as near the stored ones as the header says.
pub(super) fn verify_file(bytes: &[u8], raw: &RawMesh) -> Finding {
    match TreeBlob::parse(bytes) {
        Ok(tree) => stored(&tree).verify(TREE, raw),
        Err(error) => Finding::failed(TREE, error),
    }
}

/// The triangles that a box tree stores, whatever these may be.
fn stored(tree: &TreeBlob) -> StoredSurface {
    let triangles: Vec<Stored> = tree.triangles().collect();
    let (scale_exponent, surface_error) = (tree.scale_exponent, tree.surface_error);
    StoredSurface { triangles, scale_exponent, surface_error }
}

/// Every box holds what is below it.
fn boxes(tree: &TreeBlob) -> Result<TreeProof, String> {
    let vertices = tree.leaves.iter().map(|leaf| leaf.vertices.len()).sum();
    let mut proof = TreeProof { vertices, nodes: tree.nodes.len(), ..TreeProof::default() };
    let parents = contain::parents(tree)?;
    contain::stack(tree)?;
    contain::frames(tree, &mut proof)?;
    contain::boxes(tree, &parents, &mut proof)?;
    Ok(proof)
}

/// What the header, moments and cones say of the stored triangles, whose corners have these
/// numbers.
fn measures(tree: &TreeBlob, corners: &[[u32; 3]], proof: &mut TreeProof) -> Result<(), String> {
    surface::star_radius(tree)?;
    moments::moments(tree, corners, proof)?;
    cones::cones(tree, proof)
}
