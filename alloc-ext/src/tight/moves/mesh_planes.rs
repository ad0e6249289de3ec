//! Planes of a placement's program that keep new faces above the mesh, without a margin.

use super::star::{Frame, StarFace};
use super::tolerance::ROUNDING;
use crate::geom::{Frontier, Plane};
use crate::lp::HalfSpace;
use crate::tight::proof::{Obstacle, Raised, Tetrahedron};
use glam::DVec3;

/// A place for a star's vertex, against which planes are looked for.
pub(super) struct Trial<'a> {
    pub obstacle: &'a Obstacle,
    /// Where searches begin: among the mesh's vertices, and among its triangles.
    pub near: &'a [Frontier; 2],
    pub frame: &'a Frame,
    /// The place, in the mesh's frame.
    pub x: DVec3,
    /// Distance that the vertex keeps from planes, in the mesh's unit.
    pub clearance: f64,
}

impl Trial<'_> {
    /// Heights up to this are rounding.
    pub fn tolerance(&self) -> f64 {
        ROUNDING * self.frame.radius
    }

    /// The plane about a ring edge that keeps the new face above the mesh below the old face.
    pub fn turned(&self, face: &StarFace, ring: [DVec3; 2], edges: bool) -> Option<HalfSpace> {
        let [a, b] = ring;
        let edge = b - a;
        let least = 10.0 * self.tolerance() * edge.length();
        let turned = |q: DVec3| {
            let normal = edge.cross(q - a);
            let length = normal.length();
            // A point on the edge gives no plane.
            (length > least).then(|| {
                let normal = normal / length;
                let height = normal.dot(a - self.x);
                Raised { plane: Plane { normal, offset: normal.dot(a) }, height }
            })
        };
        let Plane { normal, .. } = self.highest(face, edges, turned)?.plane;
        let offset = normal.dot(self.frame.local(a)) + self.clearance / self.frame.radius;
        Some(HalfSpace { normal, offset })
    }

    /// The plane that keeps the vertex above the mesh below a face that vanishes.
    pub fn raised(&self, face: &StarFace, edges: bool) -> Option<HalfSpace> {
        let normal = face.normal;
        let below = normal.dot(self.x);
        let raised = |q: DVec3| {
            let offset = normal.dot(q);
            Some(Raised { plane: Plane { normal, offset }, height: offset - below })
        };
        let Raised { height, .. } = self.highest(face, edges, raised)?;
        let radius = self.frame.radius;
        let clearance = (self.obstacle.margin() + self.clearance) / radius;
        let offset = normal.dot(self.frame.local(self.x)) + height / radius + clearance;
        Some(HalfSpace { normal, offset })
    }

    /// The highest plane that `raise` makes of points of the mesh between an old face and the
    /// vertex. Points below a higher plane need not be visited.
    fn highest(
        &self,
        face: &StarFace,
        edges: bool,
        raise: impl Fn(DVec3) -> Option<Raised>,
    ) -> Option<Raised> {
        let tetrahedron = Tetrahedron::new(&face.ring_first(), self.x);
        let [points, triangles] = self.near;
        let least = self.tolerance();
        if edges {
            self.obstacle.highest_piece(triangles, &tetrahedron, least, raise)
        } else {
            self.obstacle.highest_point(points, &tetrahedron, least, raise)
        }
    }
}
