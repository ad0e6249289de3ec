//! Triangles that share no vertices.

use std::path::Path;

use super::super::RawMesh;
use super::super::polygons::Polygons;

/// Three positions for each triangle.
pub(super) fn raw(
    file: &Path,
    positions: Vec<[f64; 3]>,
    polygons: Polygons,
    decimal: bool,
) -> RawMesh {
    let triangles =
        (0..positions.len() as u32 / 3).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    let raw = RawMesh::from_f64(positions, triangles);
    RawMesh { file: file.to_owned(), polygons, decimal, ..raw }
}
