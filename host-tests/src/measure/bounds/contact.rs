//! Whether a mesh, or its hull, meets its moved copy: what bounds are judged by.
//!
//! parry3d's own test of two triangle meshes is not taken: of 2,000 pairs it says of 7 (rocker
//! arm), 9 (bunny), 12 (horse) that they meet although they do not, of one of them although a plane
//! parts the hulls with 0.4 % of the diagonal to spare. It missed none. Here its trees only tell
//! which triangles to look at.

use meshsweep_core::tribox::Pose as CorePose;
use parry3d::math::{Pose as ParryPose, Vector};
use parry3d::query::details::intersection_test_support_map_support_map;
use parry3d::shape::{SupportMap, TriMesh};
use parry3d::utils::point_cloud_support_point;

use crate::measure::Subject;
use crate::oracle::meets;
use crate::oracle::moved::{self, Place};

use super::convex_hull::ConvexHull;
use super::pose::Pose;

/// Boxes of parry3d's trees are grown by this much of the mesh's diagonal and distance from the
/// origin: some ten roundings to f32.
const GROWN: f32 = 1e-6;

/// A mesh and trees of its triangles.
pub struct Surface<'a> {
    subject: &'a Subject,
    tree: TriMesh,
    reach: f32,
}

impl<'a> Surface<'a> {
    /// Takes over the mesh.
    ///
    /// # Errors
    /// parry3d's refusal.
    pub fn new(subject: &'a Subject) -> Result<Self, String> {
        let vertices: Vec<Vector> =
            subject.mesh.positions.iter().map(|p| Vector::from_array(*p)).collect();
        let reach = vertices.iter().map(|p| p.length()).fold(subject.diagonal() as f32, f32::max);
        let tree = TriMesh::new(vertices, subject.mesh.triangles.clone())
            .map_err(|error| error.to_string())?;
        Ok(Self { subject, tree, reach })
    }

    /// Whether a triangle meets a triangle of the moved copy, whose vertices are rounded to f32.
    /// Exact of those. A part that is wholly inside a part of the copy does not meet it.
    #[must_use]
    pub fn meets_moved(&self, pose: &Pose) -> bool {
        self.candidates(&pose.parry).any(|(a, b)| {
            triangles_meet(self.corners(a), self.corners(b).map(|p| pose.apply_rounded(p)))
        })
    }

    /// The same without rounding: every number of `core` is what it is. `parry` is the same motion
    /// up to rounding.
    #[must_use]
    pub fn meets_exactly(&self, core: &CorePose, parry: &ParryPose) -> bool {
        self.candidates(parry).any(|(a, b)| {
            let first = self.corners(a).map(Place::of);
            let second = self.corners(b).map(|p| Place::moved(p, &core.rotation, core.translation));
            moved::triangles_meet(first.each_ref(), second.each_ref())
        })
    }

    /// parry3d's shape of the mesh.
    #[must_use]
    pub fn shape(&self) -> &TriMesh {
        &self.tree
    }

    /// Triangles, and those of the moved copy, whose boxes meet.
    fn candidates(&self, parry: &ParryPose) -> impl Iterator<Item = (u32, u32)> {
        let wide = Vector::splat(GROWN * (self.reach + parry.translation.length()));
        self.tree.bvh().leaf_pairs(self.tree.bvh(), move |a, b| {
            let b = b.aabb().transform_by(parry);
            a.aabb().mins.cmple(b.maxs + wide).all() && (b.mins - wide).cmple(a.aabb().maxs).all()
        })
    }

    fn corners(&self, triangle: u32) -> [[f32; 3]; 3] {
        self.subject.mesh.triangles[triangle as usize]
            .map(|v| self.subject.mesh.positions[v as usize])
    }
}

/// Two triangles meet exactly if an edge of one meets the other.
fn triangles_meet(a: [[f32; 3]; 3], b: [[f32; 3]; 3]) -> bool {
    let edge_meets =
        |t: [[f32; 3]; 3], other| (0..3).any(|k| meets(t[k], t[(k + 1) % 3], other).is_some());
    edge_meets(a, b) || edge_meets(b, a)
}

/// A hull of which parry3d asks nothing but the farthest vertex.
pub struct Supports(Vec<Vector>);

impl Supports {
    /// The hull's vertices.
    #[must_use]
    pub fn new(hull: &ConvexHull) -> Self {
        Self(
            hull.points
                .iter()
                .map(|p| Vector::from_array(p.to_array().map(|x| x as f32)))
                .collect(),
        )
    }

    /// Whether the hull meets its moved copy, by GJK in f32.
    #[must_use]
    pub fn meets_moved(&self, pose: &ParryPose) -> bool {
        intersection_test_support_map_support_map(pose, self, self)
    }
}

impl SupportMap for Supports {
    fn local_support_point(&self, direction: Vector) -> Vector {
        point_cloud_support_point(direction, &self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::{Pose, Surface, triangles_meet};
    use crate::generate::{Rng, torus};
    use crate::measure::Subject;
    use crate::measure::bounds::enclosing_sphere::Sphere;
    use glam::DVec3;
    use meshsweep::mesh::Mesh;

    const FLAT: [[f32; 3]; 3] = [[0.0; 3], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];

    #[test]
    fn triangles_meet_through_either_or_in_a_plane() {
        let shifted =
            |by: [f32; 3], t: [[f32; 3]; 3]| t.map(|p| [p[0] + by[0], p[1] + by[1], p[2] + by[2]]);
        let spike = [[0.5, 0.5, -1.0], [1.0, 0.5, -1.0], [1.0, 1.0, 1.0]];
        assert!(triangles_meet(FLAT, spike) && triangles_meet(spike, FLAT));
        assert!(!triangles_meet(FLAT, shifted([0.0, 0.0, 1.5], spike)));
        let small = FLAT.map(|p| p.map(|x| 0.25 * x));
        assert!(triangles_meet(FLAT, shifted([1.0, 1.0, 0.0], small)), "inside, in the plane");
        assert!(!triangles_meet(FLAT, shifted([3.0, 3.0, 0.0], small)));
        assert!(!triangles_meet(FLAT, shifted([0.0, 0.0, 1e-30], FLAT)));
    }

    #[test]
    fn trees_leave_no_pair_of_triangles_out() {
        let (positions, triangles) = torus(2.0, 0.5, 10, 6);
        let triangles_read = triangles.len();
        let mesh = Mesh { positions, triangles, ..Mesh::default() };
        let bounds = [[-2.5, -2.5, -0.5], [2.5, 2.5, 0.5]];
        let subject = Subject { name: "torus".to_owned(), mesh, triangles_read, bounds };
        let surface = Surface::new(&subject).expect("a mesh");
        let sphere = Sphere { centre: DVec3::ZERO, radius: 2.5 };
        let mut rng = Rng::new(3);
        let mut met = 0;
        for _ in 0..60 {
            let pose = Pose::random(&mut rng, &sphere, 2.2);
            let moved: Vec<[[f32; 3]; 3]> =
                (0..120).map(|t| surface.corners(t).map(|p| pose.apply_rounded(p))).collect();
            let meets =
                (0..120).any(|a| moved.iter().any(|b| triangles_meet(surface.corners(a), *b)));
            assert_eq!(surface.meets_moved(&pose), meets);
            met += usize::from(meets);
        }
        assert!((10..50).contains(&met), "{met}");
    }
}
