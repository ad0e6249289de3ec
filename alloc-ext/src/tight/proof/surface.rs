//! Distances to any triangles.

use crate::mesh::Mesh;
use crate::tight::proof::obstacle::Obstacle;
use glam::DVec3;

/// Any triangles, sorted for distances in `f64`.
#[derive(Clone, Debug)]
pub struct Surface(Obstacle);

impl Surface {
    /// Of a mesh and its wires, in its unit. Cost: O(n log n).
    pub fn new(mesh: &Mesh) -> Self {
        let positions: Vec<DVec3> =
            mesh.positions.iter().map(|p| DVec3::from(p.map(f64::from))).collect();
        let triangles: Vec<[u32; 3]> = mesh.all_triangles().collect();
        Self(Obstacle::new(&positions, &triangles))
    }

    /// Corners of the triangle nearest to a point, and bounds of the distance to all; `None` if
    /// there is none.
    pub fn nearest(&self, point: DVec3) -> Option<([DVec3; 3], [f64; 2])> {
        self.0.nearest(point)
    }
}
