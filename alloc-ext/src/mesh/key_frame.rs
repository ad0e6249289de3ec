//! Meshes of one topology: the first is repaired, and its repairs are applied to the others by
//! index.

use super::report::Finding;
use super::round::round;
use super::weld::weld;
use super::{Mesh, MeshError, RawMesh};
use rustc_hash::FxHashSet;

/// The places of a mesh's vertices at a key frame.
#[derive(Clone, Debug, PartialEq)]
pub struct KeyFrame {
    /// One for each of [`Mesh::positions`], in the file's unit and frame.
    pub positions: Vec<[f32; 3]>,
    /// As [`Mesh::rounding`].
    pub rounding: f64,
}

/// Refuses a mesh whose repair holds at rest only: a triangle without area may have one after a
/// motion, so it must not be dropped, flipped or kept as a wire.
///
/// `mesh` is the repaired `raw`. Then each triangle of the file has the vertices of a triangle of
/// the mesh, or those of an edge of it, and the reverse. So the two are the same surface wherever
/// the vertices move.
///
/// # Errors
/// [`MeshError::Undeformable`]; those of [`repair`](super::repair).
pub fn require_deformable(raw: &RawMesh, mesh: &Mesh) -> Result<(), MeshError> {
    let first_at = welded(raw)?;
    let refuse = |triangle: u32| MeshError::Undeformable { triangle };
    let at = |triangle: [u32; 3]| triangle.map(|v| first_at[v as usize]);
    let mut kept = FxHashSet::default();
    let mut edges = FxHashSet::default();
    for (triangle, &number) in mesh.triangles.iter().zip(&mesh.source) {
        let corners = sorted(triangle.map(|v| mesh.vertex_source[v as usize]));
        if sorted(at(raw.triangles[number as usize])) != corners {
            return Err(refuse(number));
        }
        let [a, b, c] = corners;
        kept.insert(corners);
        edges.extend([[a, a, b], [a, b, b], [a, a, c], [a, c, c], [b, b, c], [b, c, c]]);
        edges.extend([[a; 3], [b; 3], [c; 3]]);
    }
    let is_there = |corners: &[u32; 3]| kept.contains(corners) || edges.contains(corners);
    match raw.triangles.iter().position(|&triangle| !is_there(&sorted(at(triangle)))) {
        Some(triangle) => Err(refuse(triangle as u32)),
        None => Ok(()),
    }
}

/// The vertices of `mesh`, which was repaired from `first`, as they lie in `frame`.
///
/// # Errors
/// - [`MeshError::FrameCount`], [`MeshError::FrameTriangle`]: another topology.
/// - [`MeshError::FrameTorn`]: vertices that repair welded are apart.
/// - Those of [`repair`](super::repair).
pub fn key_frame(first: &RawMesh, mesh: &Mesh, frame: &RawMesh) -> Result<KeyFrame, MeshError> {
    let file = || frame.file.clone();
    let counts = [
        ("vertices", frame.positions.len(), first.positions.len()),
        ("triangles", frame.triangles.len(), first.triangles.len()),
    ];
    for (what, found, wanted) in counts {
        if found != wanted {
            return Err(MeshError::FrameCount { file: file(), what, found, wanted });
        }
    }
    // A polygon may be concave in one frame only. All frames have the triangles of the first mesh.
    let both = frame.fan_triangles().into_iter().zip(first.fan_triangles());
    if let Some((triangle, (found, wanted))) = both.enumerate().find(|(_, (a, b))| a != b) {
        return Err(MeshError::FrameTriangle { file: file(), triangle, found, wanted });
    }
    let (positions, rounding) = round(frame, &frame.positions)?;
    let first_at = welded(first)?;
    for &vertex in first.triangles.iter().flatten() {
        let kept = first_at[vertex as usize];
        if positions[vertex as usize] != positions[kept as usize] {
            return Err(MeshError::FrameTorn { file: file(), vertices: [kept, vertex] });
        }
    }
    let at = |&vertex: &u32| positions[vertex as usize];
    Ok(KeyFrame { positions: mesh.vertex_source.iter().map(at).collect(), rounding })
}

/// For each vertex the first at its place.
fn welded(raw: &RawMesh) -> Result<Vec<u32>, MeshError> {
    let (positions, _) = round(raw, &raw.positions)?;
    Ok(weld(&positions, &mut Finding::default()))
}

fn sorted(mut corners: [u32; 3]) -> [u32; 3] {
    corners.sort_unstable();
    corners
}
