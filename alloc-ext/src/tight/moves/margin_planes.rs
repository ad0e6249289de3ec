//! Planes of a placement's linear program that keep a margin between the hull and the mesh.
//!
//! The mesh grown by the margin is a ball around each point of the mesh. A new face must not cut
//! into a ball. Two kinds of points are in the way: points that the edit cuts off, in the
//! tetrahedron between an old face and the new vertex, and points that the new face is too near to.
//!
//! - *Touching planes.* A ball below the face adds the plane through the ring edge that touches the
//!   ball. Of these planes the steepest is kept, as without a margin.
//! - *Pushing planes.* A ball beside the face, near an edge that moves or near the vertex, has no
//!   touching plane, or one that asks too much. There the point of the face that is nearest to the
//!   mesh is pushed away from it. That point moves as the vertex does, times its weight. A pushing
//!   plane is right only near the place where it was made. So pushing planes are searched last, and
//!   all of them are kept.
//!
//! All is floating point. The editor proves or refuses the result.

use super::mesh_planes::Trial;
use super::star::StarFace;
use crate::geom::{Bounds, Plane, Triangle};
use crate::lp::HalfSpace;
use crate::tight::proof::{Clearance, Nearest, Tetrahedron};
use glam::DVec3;
use meshsweep_core::internal::geom::point_triangle;
use std::cell::Cell;

/// Weights below this are rounding: such a point does not move with the vertex.
const LIGHT: f64 = 1e-6;

/// Fraction of the clearance below which a point counts as too near.
const LEAST_CLEARANCE: f64 = 0.5;

/// A new face, the tetrahedron that its vertex sweeps, and the planes found for it so far.
pub(super) struct FaceMargin<'a> {
    trial: &'a Trial<'a>,
    ring: [DVec3; 2],
    /// The new face: its vertex first.
    face: Triangle,
    normal: DVec3,
    tetrahedron: Tetrahedron,
    /// The highest touching plane, and a plane parallel to it through the ball's centre. Higher
    /// balls have their centres above the second plane.
    touching: Cell<Option<(Plane, Plane)>>,
    /// Height of the highest touching plane above the vertex.
    height: Cell<f64>,
    /// The pushing plane of the nearest point so far.
    pushing: Cell<Option<HalfSpace>>,
    /// The distance of this point from the mesh.
    distance: Cell<f64>,
}

impl<'a> FaceMargin<'a> {
    /// Of a star's face with a ring edge.
    pub fn new(trial: &'a Trial<'a>, old: &StarFace, ring: [DVec3; 2]) -> Self {
        let x = trial.x;
        let face = [x, ring[0], ring[1]];
        Self {
            trial,
            ring,
            face,
            normal: (ring[0] - x).cross(ring[1] - x).normalize_or_zero(),
            tetrahedron: Tetrahedron::new(&old.corners, x),
            touching: Cell::new(None),
            height: Cell::new(trial.tolerance()),
            pushing: Cell::new(None),
            distance: Cell::new(f64::INFINITY),
        }
    }

    fn margin(&self) -> f64 {
        self.trial.obstacle.margin()
    }

    /// The highest touching plane of the vertices of the mesh that are in the way.
    pub fn plane_over_vertices(&self) -> Option<HalfSpace> {
        let far = self.margin() + self.trial.clearance;
        self.trial.obstacle.visit_points(
            &self.trial.near[0],
            |of| self.may_hold_vertex(of),
            |q| {
                // All of the tetrahedron is above the new face.
                let height = self.normal.dot(q - self.face[0]);
                if self.is_lower(q) || height < -far {
                    return;
                }
                if self.tetrahedron.holds(q) {
                    return self.touch(q, true);
                }
                self.touch(q, height < far && self.is_under(q));
            },
        );
        self.touching()
    }

    /// Whether the closest point of the new face is in its interior, and too near.
    fn is_under(&self, q: DVec3) -> bool {
        let [x, a, b] = self.face;
        let found = point_triangle(q, x, a, b);
        let weights = [1.0 - found.u - found.v, found.u, found.v];
        weights.iter().all(|&w| w > LIGHT) && self.is_near(found.distance_sq.sqrt(), weights[0])
    }

    /// The highest touching plane of the triangles that are in the way, if no vertex is.
    pub fn plane_over_triangles(&self) -> Option<HalfSpace> {
        self.trial.obstacle.visit_triangles(
            &self.trial.near[1],
            |of| self.rises_to(of) && self.tetrahedron.may_meet(of),
            |triangle| {
                if !triangle.iter().all(|&q| self.is_lower(q)) {
                    self.tetrahedron.clip(triangle, |q| self.touch(q, true));
                }
            },
        );
        self.touching()
    }

    /// The pushing plane of the nearest triangle beside the face, if nothing is cut off.
    pub fn pushing_plane(&self) -> Option<HalfSpace> {
        let clearance = Clearance::new(self.margin() + LEAST_CLEARANCE * self.trial.clearance);
        let bounds = Bounds::of(&self.face);
        self.trial.obstacle.visit_triangles(
            &self.trial.near[1],
            |of| !clearance.separates_box(&self.face, &bounds, self.normal, of),
            |triangle| {
                if clearance.separates_quickly(&self.face, self.normal, triangle) {
                    return;
                }
                if let Some(found) = Nearest::of(&self.face, triangle) {
                    self.push(&found);
                }
            },
        );
        self.pushing.get()
    }

    /// Whether the ball around a point is below the plane that touches another.
    fn is_lower(&self, q: DVec3) -> bool {
        self.touching.get().is_some_and(|(_, centres)| !centres.holds(q))
    }

    /// Whether a box may hold a vertex that is in the way.
    fn may_hold_vertex(&self, of: &Bounds) -> bool {
        let margin = self.margin() + self.trial.clearance;
        self.rises_to(of) && self.tetrahedron.may_come_near(of, margin)
    }

    /// Whether a box may hold a point that is not [lower](Self::is_lower).
    fn rises_to(&self, of: &Bounds) -> bool {
        self.touching.get().is_none_or(|(_, centres)| centres.reaches(of))
    }

    fn is_near(&self, distance: f64, weight: f64) -> bool {
        distance < self.margin() + LEAST_CLEARANCE * weight * self.trial.clearance
    }

    /// Pushes the face's nearest point away from a triangle's.
    fn push(&self, found: &Nearest) {
        let Nearest { p, weights, q, distance, .. } = *found;
        if weights[0] <= LIGHT
            || distance >= self.distance.get()
            || !self.is_near(distance, weights[0])
        {
            return;
        }
        let away = if distance > self.trial.tolerance() { (p - q) / distance } else { self.normal };
        let [_, a, b] = self.face.map(|corner| self.trial.frame.local(corner));
        let rest = a * weights[1] + b * weights[2] - self.trial.frame.local(q);
        let radius = self.trial.frame.radius;
        let offset =
            (self.margin() / radius - away.dot(rest)) / weights[0] + self.trial.clearance / radius;
        self.distance.set(distance);
        self.pushing.set(Some(HalfSpace { normal: away, offset }));
    }

    /// Turns the plane about the ring edge until it touches the ball around `q`, if there is such a
    /// plane. Outside of the tetrahedron the plane counts only if `anyway`.
    fn touch(&self, q: DVec3, anyway: bool) {
        let [a, b] = self.ring;
        let edge = b - a;
        let normal = edge.cross(q - a);
        let length = normal.length();
        let from_edge = length / edge.length();
        let sine = self.margin() / from_edge;
        if !(from_edge > 10.0 * self.trial.tolerance() && sine < 1.0) {
            return;
        }
        let normal = normal / length;
        // From the ball's centre to the edge.
        let out = edge.cross(normal) / edge.length();
        let normal = normal * (1.0 - sine * sine).sqrt() + out * sine;
        let above = normal.dot(a - self.face[0]);
        if above > self.height.get()
            && (anyway || self.tetrahedron.holds(q + normal * self.margin()))
        {
            self.height.set(above);
            let offset = normal.dot(a);
            let centres = Plane { normal, offset: offset - self.margin() };
            self.touching.set(Some((Plane { normal, offset }, centres)));
        }
    }

    fn touching(&self) -> Option<HalfSpace> {
        self.touching.get().map(|(plane, _)| {
            let offset = plane.normal.dot(self.trial.frame.local(self.ring[0]))
                + self.trial.clearance / self.trial.frame.radius;
            HalfSpace { normal: plane.normal, offset }
        })
    }
}
