//! Proof of a hull hierarchy from the blob's bytes alone.
//!
//! If [`check_blob`] returns `Ok`, the blob's hulls enclose its surface. Each split is undone in
//! exact integer arithmetic: the vertex that it replaces lies on or outside every plane of the
//! triangles that it brings, so that every step from fine to coarse adds tetrahedra of non-negative
//! volume, and the finest mesh is the surface itself. Bounds (radii, reaches, groups, levels) are
//! checked in `f64` with a margin for its rounding.
//!
//! With the mesh, [`verify`] proves moreover that the finest surface is the mesh.

mod bounds;
mod deform;
mod forest;
mod levels;
mod parse;
mod replay;
mod report;
mod surface;

use super::file::StoredSurface;
use super::finding::Finding;
use super::input::Given;
use crate::mesh::{Input, KeyFrame, RawMesh};
use forest::Forest;
pub use parse::Blob;
use replay::Hulls;
pub use report::CheckReport;

/// Proves everything that a blob's tables claim of each other.
///
/// # Errors
/// The first claim that does not hold, in words.
pub fn check_blob(bytes: &[u8]) -> Result<CheckReport, String> {
    let (blob, hulls, forest, mut report) = tables(bytes)?;
    levels::distances(&blob, &hulls, &forest, &mut report)?;
    Ok(report)
}

/// All but the distances of the level table.
fn tables(bytes: &[u8]) -> Result<(Blob, Hulls, Forest, CheckReport), String> {
    let blob = Blob::parse(bytes)?;
    let mut report = CheckReport::default();
    let hulls = replay::replay(&blob, &mut report)?;
    bounds::boxes(&blob)?;
    bounds::reaches(&blob)?;
    bounds::sources(&blob)?;
    bounds::dependencies(&blob)?;
    let forest = Forest::of(&blob)?;
    forest.covers(&blob, &mut report)?;
    bounds::errors(&blob)?;
    forest.capacity(&blob)?;
    bounds::groups(&blob, &forest)?;
    deform::numbers(bytes, &blob)?;
    deform::keys(bytes, &blob, &forest, &mut report)?;
    levels::volumes(&blob, &hulls)?;
    Ok((blob, hulls, forest, report))
}

const HULL: &str = "hull hierarchy";
const FRAMES: &str = "key frames";

/// Proves that the file's triangles are as near the finest surface as the header says. None of a
/// blob whose finest levels were cut off.
pub(super) fn verify_file(bytes: &[u8], raw: &RawMesh) -> Option<Finding> {
    let blob = match Blob::parse(bytes) {
        Ok(blob) if blob.is_cut => return None,
        Ok(blob) => blob,
        Err(error) => return Some(Finding::failed(HULL, error)),
    };
    let corners = blob.surface.iter().map(|&triangle| blob.corners(triangle));
    let triangles = blob.source.iter().copied().zip(corners).collect();
    let (scale_exponent, surface_error) = (blob.scale_exponent, blob.surface_error);
    Some(StoredSurface { triangles, scale_exponent, surface_error }.verify(HULL, raw))
}

/// Proves a blob's hull hierarchy and that it is one of the mesh at all key frames.
pub(crate) fn verify(bytes: &[u8], input: Input<'_>, keys: &[KeyFrame], out: &mut Vec<Finding>) {
    let (blob, hulls, forest, mut report) = match tables(bytes) {
        Ok(tables) => tables,
        Err(error) => return out.push(Finding::failed(HULL, error)),
    };
    let words = match blob.encloses {
        true => {
            "every level encloses the finer ones and the finest surface, and radii, groups and \
             reaches cover"
        }
        false => "the splits lead from each level to the next, and radii, groups and reaches cover",
    };
    let counts = [
        ("split", report.splits),
        ("plane", report.planes),
        ("exact plane", report.exact_planes),
        ("covered vertex", report.covered),
    ];
    out.push(Finding::proved(HULL, words, &counts));
    out.push(match levels::distances(&blob, &hulls, &forest, &mut report) {
        Err(error) => Finding::failed(HULL, error),
        Ok(()) if report.undecided_levels > 0 => Finding::not_proved(
            HULL,
            format!("how far {} levels are from the surface", report.undecided_levels),
        ),
        Ok(()) => Finding::proved(
            HULL,
            "every level is as near the surface as the level table says",
            &[("level", blob.levels.len()), ("triangle", report.level_triangles)],
        ),
    });
    if blob.is_cut {
        let why = "that it is the mesh's: its finest levels were cut off";
        return out.push(Finding::not_proved(HULL, why.to_owned()));
    }
    let given = Given::new(input, blob.scale_exponent);
    let places = match surface::triangles(&blob, &given) {
        Ok(places) => places,
        Err(error) => return out.push(Finding::failed(HULL, error)),
    };
    out.push(match surface::wires(&blob, &given) {
        Err(error) => Finding::failed(HULL, error),
        Ok(0) => Finding::proved(
            HULL,
            "the finest surface has every triangle of the mesh, by its number, within the error",
            &[("triangle", blob.surface.len()), ("exact corner", places.1)],
        ),
        Ok(_) => Finding::not_proved(HULL, "how far triangles without area are from it".to_owned()),
    });
    match surface::numbers(bytes, &blob, &given, &places) {
        Err(error) => out.push(Finding::failed("vertex numbers", error)),
        Ok(0) => {}
        Ok(vertices) => out.push(Finding::proved(
            "vertex numbers",
            "every vertex of the finest surface has its number in the mesh file",
            &[("vertex", vertices)],
        )),
    }
    match surface::frames(bytes, &blob, &given, keys, &places) {
        Err(error) => out.push(Finding::failed(FRAMES, error)),
        Ok(0) => {}
        Ok(vertices) => out.push(Finding::proved(
            FRAMES,
            "every vertex is within the error of the frame's mesh, and radii may be interpolated",
            &[("key frame", keys.len()), ("place", vertices), ("covered vertex", report.key_pairs)],
        )),
    }
}
