//! From a path to a [`RawMesh`]: choice of format, and the checks that all formats share.

use std::path::Path;

use super::{MeshError, RawMesh, obj, ply, stl};

/// Reads a mesh file: `.ply` (ASCII, binary of either byte order), `.obj`, `.stl` (ASCII or binary,
/// told apart by content). Polygons are split into fans about their first vertex.
///
/// Memory is bounded by a small multiple of the file's size, also if its header announces more.
///
/// # Errors
/// The file cannot be read, is of another kind, does not follow its format, ends early, holds a
/// coordinate that is not finite, names a vertex that is not there, or holds no face.
pub fn read(path: &Path) -> Result<RawMesh, MeshError> {
    let bytes = std::fs::read(path).map_err(|error| MeshError::Unreadable {
        file: path.to_owned(),
        reason: error.to_string(),
    })?;
    read_bytes(path, bytes)
}

/// As [`read`], for a file's content in memory; `path` gives the format by its extension, and the
/// name for messages.
///
/// # Errors
/// As [`read`], except that nothing is opened.
pub fn read_bytes(path: &Path, bytes: Vec<u8>) -> Result<RawMesh, MeshError> {
    let extension = path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
    let mesh = match extension.as_deref() {
        Some("ply" | "obj" | "stl") if bytes.trim_ascii().is_empty() => {
            return Err(MeshError::NoTriangles { file: path.to_owned() });
        }
        Some("ply") => ply::read(path, &bytes)?,
        Some("obj") => obj::read(path, &bytes)?,
        Some("stl") => stl::read(path, bytes)?,
        _ => return Err(MeshError::UnknownExtension { file: path.to_owned() }),
    };
    check(&mesh)?;
    Ok(mesh)
}

/// Checks the invariants of [`RawMesh`]. Readers have checked before where they can name a line.
pub(super) fn check(mesh: &RawMesh) -> Result<(), MeshError> {
    let file = || mesh.file.clone();
    for (what, count) in [("vertices", mesh.positions.len()), ("triangles", mesh.triangles.len())] {
        // Half-edges are numbered 3·triangle + corner in 32 bits, and the largest number means
        // "none".
        if count >= (u32::MAX / 3) as usize {
            return Err(MeshError::TooMany { file: file(), what, count });
        }
    }
    if mesh.triangles.is_empty() {
        return Err(MeshError::NoTriangles { file: file() });
    }
    if let Some(vertex) = mesh.positions.iter().position(|p| !p.iter().all(|x| x.is_finite())) {
        return Err(MeshError::NotFinite {
            file: file(),
            line: None,
            vertex,
            at: mesh.positions[vertex],
        });
    }
    let vertex_count = mesh.positions.len();
    for (face, triangle) in mesh.triangles.iter().enumerate() {
        if let Some(&index) = triangle.iter().find(|&&v| v as usize >= vertex_count) {
            let index = i64::from(index);
            return Err(MeshError::IndexOutOfRange {
                file: file(),
                line: None,
                face,
                index,
                vertex_count,
            });
        }
    }
    Ok(())
}
