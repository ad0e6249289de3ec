//! The same questions to parry3d, the Rust library that a user without a microcontroller would
//! take: an AABB tree in f32.

use meshsweep_host_tests::workload::Subject;
use meshsweep_host_tests::workload::pose::Pose;
use parry3d::math::{Pose as ParryPose, Rotation, Vector};
use parry3d::query::{PointQuery, Ray, RayCast};
use parry3d::shape::TriMesh;

/// A mesh in parry3d.
pub struct Rival(TriMesh);

impl Rival {
    /// Takes over the mesh.
    ///
    /// # Errors
    /// parry3d's refusal.
    pub fn new(subject: &Subject) -> Result<Self, String> {
        let vertices =
            subject.mesh.positions.iter().map(|&[x, y, z]| Vector::new(x, y, z)).collect();
        TriMesh::new(vertices, subject.mesh.triangles.clone())
            .map(Self)
            .map_err(|error| error.to_string())
    }

    /// parry3d's shape of the mesh.
    #[must_use]
    pub const fn shape(&self) -> &TriMesh {
        &self.0
    }

    /// Bytes that it keeps, the mesh included.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.0.total_memory_size()
    }

    /// Closest point of the surface.
    #[must_use]
    pub fn closest(&self, [x, y, z]: [f32; 3]) -> [f32; 3] {
        let point = self.0.project_local_point(Vector::new(x, y, z), false).point;
        [point.x, point.y, point.z]
    }

    /// Parameter of the first hit of a segment.
    #[must_use]
    pub fn first_hit(&self, segment: [[f32; 3]; 2]) -> Option<f32> {
        self.0.cast_local_ray(&along(segment), 1.0, false)
    }

    /// Whether a segment meets the surface. parry3d 0.31 looks for its first hit.
    #[must_use]
    pub fn meets(&self, segment: [[f32; 3]; 2]) -> bool {
        self.0.intersects_local_ray(&along(segment), 1.0)
    }
}

/// A pose for parry3d, rounded to f32.
#[must_use]
pub fn parry(pose: &Pose) -> ParryPose {
    let [x, y, z, w] = pose.turn.to_array().map(|part| part as f32);
    let shift = Vector::from_array(pose.shift.to_array().map(|x| x as f32));
    ParryPose::from_parts(shift, Rotation::from_xyzw(x, y, z, w).normalize())
}

/// The segment is the ray up to 1.
fn along([a, b]: [[f32; 3]; 2]) -> Ray {
    let direction = Vector::new(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
    Ray::new(Vector::new(a[0], a[1], a[2]), direction)
}
