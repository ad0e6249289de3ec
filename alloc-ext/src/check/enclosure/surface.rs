//! A surface as the proofs of enclosure take it.

use std::collections::HashMap;

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
    /// Of triangles by their corners. Corners at the same place are one vertex.
    pub(crate) fn welded(triangles: impl Iterator<Item = [[f64; 3]; 3]>) -> Self {
        let mut number: HashMap<[u64; 3], u32> = HashMap::new();
        let mut surface = Self::default();
        for corners in triangles {
            let corners = corners.map(|p| {
                // Both zeros are one place.
                *number.entry(p.map(|x| (x + 0.0).to_bits())).or_insert_with(|| {
                    surface.positions.push(p);
                    surface.positions.len() as u32 - 1
                })
            });
            surface.triangles.push(corners);
        }
        surface
    }

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
