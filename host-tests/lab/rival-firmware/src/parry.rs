//! parry3d's mesh as a program would use it: built from vertices and triangles at start, all
//! options at their defaults.
//!
//! Without std its square roots are libm's, in software: more than a third of a closest point's
//! instructions.

use parry3d::math::Vector;
use parry3d::query::{PointQuery, Ray, RayCast};
use parry3d::shape::TriMesh;

extern crate alloc;
use alloc::vec::Vec;

/// A mesh in parry3d.
pub struct Parry(TriMesh);

impl Parry {
    /// Takes over a mesh; `None` if parry3d refuses it.
    pub fn new(
        vertices: impl Iterator<Item = [f32; 3]>,
        triangles: impl Iterator<Item = [u32; 3]>,
    ) -> Option<Self> {
        let vertices: Vec<Vector> = vertices.map(Vector::from_array).collect();
        TriMesh::new(vertices, triangles.collect()).ok().map(Self)
    }

    /// Closest point of the surface.
    #[allow(dead_code, reason = "each image asks its own questions")]
    #[inline(never)]
    pub fn closest(&self, point: [f32; 3]) -> [f32; 3] {
        self.0.project_local_point(Vector::from_array(point), false).point.to_array()
    }

    /// Parameter of a segment's first hit.
    #[allow(dead_code, reason = "each image asks its own questions")]
    #[inline(never)]
    pub fn first_hit(&self, a: [f32; 3], b: [f32; 3]) -> Option<f32> {
        let (a, b) = (Vector::from_array(a), Vector::from_array(b));
        self.0.cast_local_ray(&Ray::new(a, b - a), 1.0, false)
    }
}
