//! Proof of a hull hierarchy from the blob's bytes alone.
//!
//! If [`check_blob`] returns `Ok`, the blob's hulls enclose its surface. Each split is undone in
//! exact integer arithmetic: the vertex that it replaces lies on or outside every plane of the
//! triangles that it brings, so that every step from fine to coarse adds tetrahedra of non-negative
//! volume, and the finest mesh is the surface itself. Bounds (radii, reaches, groups, levels) are
//! checked in `f64` with a margin for its rounding.

mod bounds;
mod deform;
mod forest;
mod levels;
mod parse;
mod replay;
mod report;

pub use parse::Blob;
pub use report::CheckReport;

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
