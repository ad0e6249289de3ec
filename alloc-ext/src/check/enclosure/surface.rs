//! A surface as the proofs of enclosure take it.

/// Corners of a triangle.
pub(crate) type Corners = [[f64; 3]; 3];

/// Triangles by vertex number.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surface {
    /// Vertices.
    pub positions: Vec<[f64; 3]>,
    /// Corners.
    pub triangles: Vec<[u32; 3]>,
}

impl Surface {
    /// Of arrays in memory.
    #[must_use]
    pub fn new(positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Self {
        Self {
            positions: positions.iter().map(|p| p.map(f64::from)).collect(),
            triangles: triangles.to_vec(),
        }
    }

    pub(super) fn corners(&self, triangle: [u32; 3]) -> [[f64; 3]; 3] {
        triangle.map(|v| self.positions[v as usize])
    }
}
