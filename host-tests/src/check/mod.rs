//! Proofs from a blob's bytes alone: a parser, exact arithmetic and a replay that share no code
//! with reader or builder.
//!
//! If [`check_blob`] returns `Ok`, the blob's hulls enclose its surface. Each split is undone in
//! exact integer arithmetic: the vertex that it replaces lies on or outside every plane of the
//! triangles that it brings, so that every step from fine to coarse adds tetrahedra of non-negative
//! volume, and the finest mesh is the surface itself. Bounds (radii, reaches, groups, levels) are
//! checked in `f64` with a margin for its rounding.

mod bounds;
mod deform;
mod enclosure;
mod exact;
mod forest;
mod levels;
mod mesh;
mod parse;
mod replay;
mod sections;
mod tree;

pub use enclosure::{
    EnclosureProof, Surface, Winding, check_enclosure, check_enclosure_files, check_margin,
    read_surface,
};
pub use exact::side;
pub use mesh::{Mesh, canonical};
pub use parse::Blob;
pub use tree::{TreeProof, check_tree};

/// What was proved, in numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CheckReport {
    /// Splits replayed.
    pub splits: usize,
    /// Planes that a replaced vertex was found to lie on or outside.
    pub planes: usize,
    /// Of these, the ones that `f64` could not decide.
    pub exact_planes: usize,
    /// Triangles of the finest mesh.
    pub triangles: usize,
    /// Pairs of a triangle of any level and a vertex of the surface that it stands for.
    pub covered: usize,
    /// Pairs of a triangle and a vertex that were followed through all key frames.
    pub key_pairs: usize,
    /// Points of the levels' hulls whose distance to the surface was measured.
    pub samples: usize,
}

/// Proves everything that a blob's tables claim of each other.
///
/// # Errors
/// The first claim that does not hold, in words.
pub fn check_blob(bytes: &[u8]) -> Result<CheckReport, String> {
    let blob = Blob::parse(bytes)?;
    let mut report = CheckReport::default();
    let meshes = replay::replay(&blob, &mut report)?;
    bounds::boxes(&blob)?;
    bounds::reaches(&blob)?;
    bounds::sources(&blob)?;
    bounds::dependencies(&blob)?;
    let forest = forest::Forest::of(&blob)?;
    forest.covers(&blob, &mut report)?;
    bounds::errors(&blob)?;
    forest.capacity(&blob)?;
    bounds::groups(&blob, &forest)?;
    deform::numbers(bytes, &blob)?;
    deform::keys(bytes, &blob, &forest, &mut report)?;
    levels::volumes(&blob, &meshes)?;
    levels::distances(&blob, &meshes, &forest, &mut report)?;
    Ok(report)
}
