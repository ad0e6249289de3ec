//! Which triangles of a mesh tell sides where the file has them, for builders that store no
//! triangles.

use super::build::MAX_TRIANGLES;
use super::sides::{Sided, Sides};
use super::store::store;
use super::stored_triangles::{Copies, StoredTriangles};
use crate::error::BuildError;
use crate::geom::{Face, faces};
use crate::mesh::Mesh;
use glam::DVec3;
use meshsweep_core::internal::num::exp2;

/// What tells the sides of a closed mesh.
#[derive(Debug)]
pub(crate) struct FileSides {
    /// Per triangle whether it tells no side; empty if all tell sides. In front of each other
    /// triangle the winding number is 0, behind it 1.
    pub sideless: Vec<bool>,
    /// The triangles, in a frame of their own.
    pub faces: Vec<Face>,
    /// Per triangle how often the file winds it, if the mesh winds some otherwise.
    pub times: Option<Vec<i32>>,
    /// Whether components are left whose winding no number tells.
    pub is_mixed: bool,
    /// Power of two: units of that frame in one of the file.
    scale: f64,
}

impl FileSides {
    /// Of a mesh; `None` if it is not closed, or has no winding for sides.
    ///
    /// Cost: that of [`Fronts::of`](crate::surface::Fronts::of).
    pub fn of(mesh: &Mesh) -> Result<Option<Self>, BuildError> {
        let stored = StoredTriangles::of(mesh, Copies::First, MAX_TRIANGLES)?;
        let Some(sided) = stored.sided else { return Ok(None) };
        let sided = Sided::new(sided, &stored);
        let mut grid = store(mesh.as_input(), true);
        let scale = exp2(-grid.scale_exponent - grid.exponent);
        // Exact: f32 numbers times a power of two.
        grid.positions = grid.places(mesh);
        let Sides { sideless, .. } = sided.sides(&grid);
        let times = sided.times(&grid.positions);
        let is_mixed = times.as_ref().is_some_and(|times| times.contains(&0));
        let faces = faces(&grid.positions, &mesh.triangles);
        Ok(Some(Self { sideless, faces, times, is_mixed, scale }))
    }

    /// A point of the file in the frame of the faces.
    pub fn place(&self, p: DVec3) -> DVec3 {
        p * self.scale
    }
}
