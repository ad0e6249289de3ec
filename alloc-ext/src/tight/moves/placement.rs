//! The place for the vertex of a changed star: as deep as the original mesh lets it.
//!
//! The volume below a star is linear in its vertex `x`. A new face turns about its ring edge as `x`
//! moves, and must not pass the mesh. So this is a linear program whose planes are found on the
//! way:
//! 1. solve the program;
//! 2. look for mesh in the tetrahedra between the old faces and the new vertex;
//! 3. for each ring edge, add the plane through the edge and the point that stands out most;
//! 4. solve again, until no mesh is found.
//!
//! A plane is only ever replaced by a steeper one about the same edge. Mesh behind the hull that
//! the edit does not reach adds no plane.
//!
//! All is floating point. The editor proves or refuses the place that is found here.

use super::margin_planes::FaceMargin;
use super::mesh_planes::Trial;
use super::star::{Frame, StarFace, added_volume, corners, radius};
use super::tolerance::ROUNDING;
use crate::geom::{Bounds, Frontier};
use crate::lp::{HalfSpace, Order, minimise_bounded};
use crate::tight::proof::Obstacle;
use glam::DVec3;

/// The objective of a placement besides least volume.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlacementObjective {
    /// Weight of the second term, which keeps the vertex near the star's centre.
    pub centre_weight: f64,
    /// Added to the direction of least volume, as a fraction of its length.
    pub tilt: DVec3,
    /// Least fraction of a face's area that its new face keeps, seen along the old normal; `None`:
    /// any.
    pub upright: Option<f64>,
    /// The placement is given up as soon as it gains no more volume than this. Further planes take
    /// volume from the gain.
    pub least_gain: f64,
}

impl PlacementObjective {
    /// The second term is strong enough to slide along planes, and weak enough to stay near the
    /// star.
    pub const PLAIN: Self = Self {
        centre_weight: 0.05,
        tilt: DVec3::ZERO,
        upright: None,
        least_gain: f64::NEG_INFINITY,
    };
}

/// Most programs for one star.
const ROUNDS: usize = 25;

/// Buffers of the programs, kept to save allocations, and counters of work.
#[derive(Clone, Debug, Default)]
pub(crate) struct Placer {
    /// Stars that were placed.
    pub stars: u64,
    /// Programs that were solved.
    pub programs: u64,
    /// Planes that do not depend on the mesh.
    fixed: Vec<HalfSpace>,
    /// Per face of the star the plane about its ring edge.
    cuts: Vec<Option<HalfSpace>>,
    /// Planes that push faces off the mesh beside them; see
    /// [`margin_planes`](super::margin_planes).
    pushes: Vec<HalfSpace>,
    /// All planes of a program.
    planes: Vec<HalfSpace>,
}

impl Placer {
    /// The vertex, not rounded, which keeps `clearance` from each plane; `None` if the program has
    /// no answer.
    pub fn place(
        &mut self,
        obstacle: &Obstacle,
        star: &[StarFace],
        centre: DVec3,
        clearance: f64,
        objective: &PlacementObjective,
    ) -> Option<DVec3> {
        self.stars += 1;
        let radius = radius(star, centre);
        if !(radius > 0.0 && radius.is_finite()) {
            return None;
        }
        let frame = Frame { centre, radius };
        let direction = self.open(star, &frame, objective)?;
        let bounds = corners(star).fold(Bounds::EMPTY, Bounds::with);
        let mut near = <[Frontier; 2]>::default();
        let margin = obstacle.margin();
        obstacle.frontiers(&bounds.grown(margin + clearance), &mut near);
        let everywhere = [Frontier::whole(), Frontier::whole()];
        for _ in 0..ROUNDS {
            self.programs += 1;
            self.planes.clear();
            self.planes.extend(self.cuts.iter().flatten());
            self.planes.extend(&self.pushes);
            self.planes.extend(&self.fixed);
            let x = minimise_bounded(
                direction,
                &mut self.planes,
                objective.centre_weight,
                Order::MostViolated,
            )?;
            let x = centre + x * radius;
            if -added_volume(star, x) <= objective.least_gain {
                return None;
            }
            // Vertices of the mesh are cheap to look for and find nearly every plane. Edges are
            // looked for once no vertex is in the way.
            let near = if bounds.with(x) == bounds { &near } else { &everywhere };
            let trial = Trial { obstacle, near, frame: &frame, x, clearance };
            let clear = self.cut(star, &trial, false)
                && self.cut(star, &trial, true)
                && (!obstacle.has_wide_margin() || self.push_apart(star, &trial));
            if clear {
                return Some(x);
            }
        }
        None
    }

    /// Sets up the planes that do not depend on the mesh; the direction of the program.
    fn open(
        &mut self,
        star: &[StarFace],
        frame: &Frame,
        objective: &PlacementObjective,
    ) -> Option<DVec3> {
        self.fixed.clear();
        self.pushes.clear();
        self.cuts.clear();
        self.cuts.resize(star.len(), None);
        let mut direction = DVec3::ZERO;
        let mut area = 0.0;
        for face in star {
            let Some(ring) = face.ring else { continue };
            let [a, b] = ring.map(|p| frame.local(p));
            let cross = a.cross(b);
            direction += cross;
            let double_area = face.double_area / (frame.radius * frame.radius);
            area += double_area;
            let across = (b - a).cross(face.normal);
            let length = across.length();
            if let Some(upright) = objective.upright.filter(|_| length > ROUNDING) {
                let offset = (upright * double_area - cross.dot(face.normal)) / length;
                self.fixed.push(HalfSpace { normal: -across / length, offset });
            }
        }
        direction += objective.tilt * direction.length();
        (area > 0.0).then(|| direction / area)
    }

    /// Adds a plane for every new face that has mesh in front of it, by the mesh's edges too or by
    /// its vertices only; whether there was none.
    fn cut(&mut self, star: &[StarFace], trial: &Trial<'_>, edges: bool) -> bool {
        let mut clear = true;
        for (face, cut) in star.iter().zip(&mut self.cuts) {
            let rises = face.normal.dot(trial.x - face.corners[0]) >= -trial.tolerance();
            let found = match face.ring {
                // A face that rises cuts nothing off, but it may turn towards mesh that it has to
                // keep the margin from.
                Some(ring) if trial.obstacle.has_wide_margin() => {
                    let face_margin = FaceMargin::new(trial, face, ring);
                    if edges {
                        face_margin.plane_over_triangles()
                    } else {
                        face_margin.plane_over_vertices()
                    }
                }
                _ if rises => None,
                Some(ring) => trial.turned(face, ring, edges),
                None => trial.raised(face, edges),
            };
            if found.is_some() {
                *cut = found;
                clear = false;
            }
        }
        clear
    }

    /// Adds a plane for every new face that has mesh near its side; whether there was none.
    fn push_apart(&mut self, star: &[StarFace], trial: &Trial<'_>) -> bool {
        let before = self.pushes.len();
        for face in star {
            let Some(ring) = face.ring else { continue };
            self.pushes.extend(FaceMargin::new(trial, face, ring).pushing_plane());
        }
        self.pushes.len() == before
    }
}
