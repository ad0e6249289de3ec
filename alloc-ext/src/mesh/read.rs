//! From a path to a [`RawMesh`]: choice of format, and the checks that all formats share.

use std::path::Path;

use super::{FORMATS, MeshError, RawMesh, collada, gltf, obj, off, ply, stl, threemf};

/// Reads a mesh file, whose extension gives its format:
/// - `.ply`: ASCII, or binary of either byte order; faces and triangle strips.
/// - `.obj`: polygons. Free-form curves and surfaces are left out and counted.
/// - `.stl`: ASCII or binary, told apart by content.
/// - `.off`: text, with normals, colours and texture coordinates or without.
/// - `.glb`, `.gltf`: the triangles of all nodes of all scenes, in metres. Without scenes, those of
///   all nodes or meshes. Nodes that no scene reaches are left out and counted. Buffers are read
///   from `data:` or from files beside it. Skins, morphs, Draco and meshopt are refused.
/// - `.3mf`: the objects of the build, in the unit that the file tells. Supports, items that are
///   not to be printed, objects that no item builds, negative parts and modifiers are left out and
///   counted.
/// - `.dae`: COLLADA 1.4 and 1.5, the triangles and polygons of all nodes of the scene, in the unit
///   that the file tells. Axes stay as they are written: `up_axis` turns nothing. Controllers are
///   refused.
///
/// Text is UTF-8 or UTF-16, with a byte order mark or without. Lines end with CR, LF or both. OFF
/// and PLY of one element on each line are read so only: a lost number or a wrong count is refused.
///
/// A polygon of n corners becomes n − 2 triangles: the fan about its first corner, or ears if that
/// corner does not see all of it. Nodes, items and components put copies in
/// place; one that mirrors keeps the outside outside.
///
/// Memory is bounded by a multiple of the file's size, also if its header announces more: a small
/// one, but 128 for a compressed file. A scene of copies may reach 2²⁴ vertices and triangles.
///
/// # Errors
/// The file cannot be read, is empty, is of another kind, does not follow its format, ends early,
/// holds a coordinate that is not finite, names a vertex that is not there, or holds no face.
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
/// As [`read`], except that nothing is opened but the files that a `.gltf` names beside `path`.
pub fn read_bytes(path: &Path, bytes: Vec<u8>) -> Result<RawMesh, MeshError> {
    let extension = path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
    let mesh = match extension.as_deref() {
        Some(kind) if FORMATS.contains(&kind) && bytes.trim_ascii().is_empty() => {
            return Err(MeshError::Empty { file: path.to_owned() });
        }
        Some("ply") => ply::read(path, &bytes)?,
        Some("obj") => obj::read(path, &bytes)?,
        Some("stl") => stl::read(path, &bytes)?,
        Some("off") => off::read(path, &bytes)?,
        Some("gltf" | "glb") => gltf::read(path, &bytes)?,
        Some("3mf") => threemf::read(path, &bytes)?,
        Some("dae") => collada::read(path, &bytes)?,
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
        return Err(MeshError::NoTriangles { file: file(), instead: mesh.left_out.instead() });
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
