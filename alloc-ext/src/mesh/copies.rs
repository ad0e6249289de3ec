//! A mesh of the copies that a scene puts in place.

use std::path::Path;

use super::placement::Placement;
use super::{MeshError, RawMesh};

/// Most vertices, and most triangles, of a scene whose file has fewer bytes than that. A scene may
/// name one mesh any number of times, so that its size would not bound the memory.
const MOST: usize = 1 << 24;

/// Most copies, those of nothing included.
const MOST_COPIES: usize = 1 << 20;

/// A mesh that grows by copies.
pub(super) struct Copies {
    pub(super) raw: RawMesh,
    most: usize,
    copies: usize,
    corners: usize,
}

impl Copies {
    /// Of a file of so many bytes.
    pub(super) fn new(file: &Path, bytes: usize) -> Self {
        let raw = RawMesh { file: file.to_owned(), ..RawMesh::from_f64(Vec::new(), Vec::new()) };
        Self { raw, most: bytes.clamp(MOST, u32::MAX as usize / 3), copies: 0, corners: 0 }
    }

    /// Counts a copy.
    pub(super) fn count(&mut self) -> Result<(), MeshError> {
        self.copies += 1;
        self.within("copies of meshes", self.copies, MOST_COPIES)
    }

    /// Counts corners that are read for a copy: a strip may have any number without a triangle.
    pub(super) fn count_corners(&mut self, corners: usize) -> Result<(), MeshError> {
        self.corners = self.corners.saturating_add(corners);
        self.within("corners", self.corners, self.most.saturating_mul(3))
    }

    /// Puts vertices in place; the number of the first.
    pub(super) fn put(
        &mut self,
        positions: &[[f64; 3]],
        placement: &Placement,
    ) -> Result<u32, MeshError> {
        let first = self.raw.positions.len();
        self.within("vertices", first + positions.len(), self.most)?;
        let mut largest = 0f64;
        for &position in positions {
            let (at, error) = placement.put(position);
            if !at.iter().all(|x| x.is_finite()) || !error.is_finite() {
                let vertex = self.raw.positions.len();
                return Err(MeshError::NotFinite {
                    file: self.raw.file.clone(),
                    line: None,
                    vertex,
                    at,
                });
            }
            largest = largest.max(error);
            self.raw.positions.push(at);
        }
        self.raw.error = self.raw.error.max(largest);
        u32::try_from(first).map_err(|_| self.too_many("vertices", first))
    }

    /// Adds triangles of vertices from `first` on, wound the other way if the placement mirrors.
    pub(super) fn join(
        &mut self,
        triangles: &[[u32; 3]],
        first: u32,
        placement: &Placement,
    ) -> Result<(), MeshError> {
        self.within("triangles", self.raw.triangles.len() + triangles.len(), self.most)?;
        let mirrors = placement.mirrors();
        self.raw.triangles.extend(triangles.iter().map(|triangle| {
            let [a, b, c] = triangle.map(|v| v + first);
            if mirrors { [a, c, b] } else { [a, b, c] }
        }));
        Ok(())
    }

    fn within(&self, what: &'static str, count: usize, most: usize) -> Result<(), MeshError> {
        if count <= most.min(u32::MAX as usize) {
            return Ok(());
        }
        Err(MeshError::Malformed {
            file: self.raw.file.clone(),
            line: None,
            place: "the scene".into(),
            reason: format!("it makes {count} {what}; {most} are read"),
        })
    }

    fn too_many(&self, what: &'static str, count: usize) -> MeshError {
        MeshError::TooMany { file: self.raw.file.clone(), what, count }
    }
}
