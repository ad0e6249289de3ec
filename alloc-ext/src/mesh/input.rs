//! A mesh together with its relation to the input file.

use super::Mesh;

/// A mesh and its relation to the input file, as every builder takes it.
#[derive(Clone, Copy, Debug)]
pub struct Input<'a> {
    /// The mesh.
    pub mesh: &'a Mesh,
    /// Distance, in input units, that vertices were moved before (see
    /// [`snap`](crate::surface::snap)); 0 if none were. Every answer's interval includes it.
    pub moved: f64,
    /// Triangles of the input file, at least.
    pub input_triangles: usize,
}

impl Input<'_> {
    /// Largest distance between the mesh and the input surface, input units.
    pub(crate) fn error(&self) -> f64 {
        self.mesh.rounding + self.moved
    }

    /// As [`error`](Self::error), rounded up: every point of the input's surface is within it of
    /// the mesh, in real arithmetic.
    pub(crate) fn error_up(&self) -> f64 {
        if self.error() > 0.0 { self.error().next_up() } else { 0.0 }
    }

    /// Triangles of the input file, above the number of every triangle and wire.
    pub(crate) fn triangle_count(&self) -> u32 {
        let wires = self.mesh.wires.iter().map(|wire| wire.source);
        let numbered = self.mesh.source.iter().copied().chain(wires).max();
        let above = numbered.map_or(0, |number| number as usize + 1);
        self.input_triangles.max(above).max(self.mesh.all_triangles().count()) as u32
    }
}

impl<'a> From<&'a Mesh> for Input<'a> {
    /// See [`Mesh::as_input`].
    fn from(mesh: &'a Mesh) -> Self {
        mesh.as_input()
    }
}

impl Mesh {
    /// The mesh as an input file of its own: no vertex was moved, no triangle dropped.
    #[must_use]
    pub fn as_input(&self) -> Input<'_> {
        Input { mesh: self, moved: 0.0, input_triangles: self.all_triangles().count() }
    }
}
