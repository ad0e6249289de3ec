//! Planes of a placement's program that keep new faces above the mesh, without a margin.

use super::star::{Frame, StarFace};
use super::tolerance::ROUNDING;
use crate::geom::{Frontier, Plane};
use crate::lp::HalfSpace;
use crate::tight::proof::{Obstacle, Tetrahedron};
use glam::DVec3;
use std::cell::Cell;

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
        let height = Cell::new(self.tolerance());
        let turned = |q: DVec3| {
            let normal = edge.cross(q - a);
            let length = normal.length();
            // A point on the edge gives no plane.
            if length <= least {
                return None;
            }
            let normal = normal / length;
            let above = normal.dot(a - self.x);
            (above > height.get()).then(|| {
                height.set(above);
                Plane { normal, offset: normal.dot(a) }
            })
        };
        let Plane { normal, .. } = self.highest(face, edges, turned)?;
        let offset = normal.dot(self.frame.local(a)) + self.clearance / self.frame.radius;
        Some(HalfSpace { normal, offset })
    }

    /// The plane that keeps the vertex above the mesh below a face that vanishes.
    pub fn raised(&self, face: &StarFace, edges: bool) -> Option<HalfSpace> {
        let normal = face.normal;
        let below = normal.dot(self.x);
        let height = Cell::new(self.tolerance());
        let raised = |q: DVec3| {
            let offset = normal.dot(q);
            (offset - below > height.get()).then(|| {
                height.set(offset - below);
                Plane { normal, offset }
            })
        };
        self.highest(face, edges, raised)?;
        let radius = self.frame.radius;
        let clearance = (self.obstacle.margin() + self.clearance) / radius;
        let offset = normal.dot(self.frame.local(self.x)) + height.get() / radius + clearance;
        Some(HalfSpace { normal, offset })
    }

    /// The last plane that `raise` returned for points of the mesh between an old face and the
    /// vertex. Each plane must be above the one before, so that points below it need not be
    /// visited.
    fn highest(
        &self,
        face: &StarFace,
        edges: bool,
        raise: impl Fn(DVec3) -> Option<Plane>,
    ) -> Option<Plane> {
        let tetrahedron = Tetrahedron::new(&face.ring_first(), self.x);
        let [points, triangles] = self.near;
        if edges {
            self.obstacle.highest_piece(triangles, &tetrahedron, raise)
        } else {
            self.obstacle.highest_point(points, &tetrahedron, raise)
        }
    }
}
