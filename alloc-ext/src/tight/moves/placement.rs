//! Where the vertex of a changed star goes: as deep as the original mesh lets it.
//!
//! The volume below a star is linear in its vertex `x`. A new face turns about its ring edge as `x`
//! moves, and what it may not pass is the mesh. So this is a linear program whose planes are found
//! on the way: solve it, look for mesh in the tetrahedra between the old faces and the new vertex,
//! add for each ring edge the plane through the edge and the point that stands out most, and solve
//! again. A plane is only ever replaced by a steeper one about the same edge, and mesh behind the
//! hull that the move does not reach adds none.
//!
//! All is floating point: what is found here is proved, or refused, in `admits`.

use crate::lp::{HalfSpace, minimise_bounded};
use crate::tight::moves::margin_planes::Sweep;
use crate::tight::proof::boxes::Bounds;
use crate::tight::proof::cells::Frontier;
use crate::tight::proof::obstacle::Obstacle;
use crate::tight::proof::predicates::Triangle;
use crate::tight::proof::region::{Plane, Tetrahedron};
use glam::DVec3;
use std::cell::Cell;

/// A face of the star before the move.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StarFace {
    pub corners: Triangle,
    /// The edge that stays, if the face does: its face afterwards is `x`, then these.
    pub ring: Option<[DVec3; 2]>,
    pub normal: DVec3,
    pub double_area: f64,
}

impl StarFace {
    pub fn new(corners: Triangle, ring: Option<[DVec3; 2]>) -> Self {
        let [a, b, c] = corners;
        let cross = (b - a).cross(c - a);
        let double_area = cross.length();
        let normal = if double_area > 0.0 { cross / double_area } else { DVec3::ZERO };
        Self { corners, ring, normal, double_area }
    }

    /// Six times the volume that a vertex adds.
    pub fn added(&self, x: DVec3) -> f64 {
        self.normal.dot(x - self.corners[0]) * self.double_area
    }
}

/// What is asked of a placement beside least volume.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlacementObjective {
    /// Weight of the second term, which keeps the vertex near the star's centre.
    pub second_term: f64,
    /// Added to the direction of least volume, as a part of its length.
    pub tilt: DVec3,
    /// Least part of a face's area that its new face keeps when it is seen along the old normal;
    /// `None`: any.
    pub upright: Option<f64>,
    /// Distance that is kept from each plane.
    pub clearance: f64,
}

/// Programs of one star until it is given up.
const ROUNDS: usize = 25;

/// Heights below this part of the star's radius are rounding.
const LEVEL: f64 = 1e-12;

/// The solver's memory, kept to save allocations, and its counters.
#[derive(Clone, Debug, Default)]
pub(crate) struct Placer {
    /// Stars.
    pub stars: u64,
    /// Programs.
    pub programs: u64,
    fixed: Vec<HalfSpace>,
    cuts: Vec<Option<HalfSpace>>,
    /// See [`apart`](crate::tight::moves::margin_planes).
    pushes: Vec<HalfSpace>,
    planes: Vec<HalfSpace>,
}

impl Placer {
    /// The vertex, not rounded; `None` if the program has no answer.
    pub fn place(
        &mut self,
        obstacle: &Obstacle,
        star: &[StarFace],
        centre: DVec3,
        wish: &PlacementObjective,
    ) -> Option<DVec3> {
        self.stars += 1;
        let radius_sq = star.iter().flat_map(|f| f.corners).map(|p| (p - centre).length_squared());
        let radius = radius_sq.fold(0.0, f64::max).sqrt();
        if !(radius > 0.0 && radius.is_finite()) {
            return None;
        }
        let frame = Frame { centre, radius };
        let objective = self.open(star, &frame, wish)?;
        let reach = star.iter().flat_map(|f| f.corners).fold(Bounds::EMPTY, Bounds::with);
        let mut near = <[Frontier; 2]>::default();
        let margin = obstacle.margin();
        obstacle.frontiers(&reach.grown(margin + wish.clearance), &mut near);
        let everywhere = [Frontier::whole(), Frontier::whole()];
        for _ in 0..ROUNDS {
            self.programs += 1;
            self.planes.clear();
            self.planes.extend(self.cuts.iter().flatten());
            self.planes.extend(&self.pushes);
            self.planes.extend(&self.fixed);
            let x = minimise_bounded(objective, &mut self.planes, wish.second_term)?;
            let x = centre + x * radius;
            // Vertices of the mesh are cheap to look for and find nearly every plane; edges are
            // looked at once no vertex is in the way.
            let near = if reach.with(x) == reach { &near } else { &everywhere };
            let search = |edges: bool| Search { obstacle, near, edges };
            let mut clear = [false, true]
                .into_iter()
                .all(|edges| self.cut(star, &frame, x, wish.clearance, &search(edges)));
            if margin > 0.0 && clear {
                clear = self.push_apart(star, &frame, x, wish.clearance, &search(true));
            }
            if clear {
                return Some(x);
            }
        }
        None
    }

    /// Sets up the constraints that do not depend on the mesh; the objective.
    fn open(
        &mut self,
        star: &[StarFace],
        frame: &Frame,
        wish: &PlacementObjective,
    ) -> Option<DVec3> {
        self.fixed.clear();
        self.pushes.clear();
        self.cuts.clear();
        self.cuts.resize(star.len(), None);
        let mut objective = DVec3::ZERO;
        let mut area = 0.0;
        for face in star {
            let Some(ring) = face.ring else { continue };
            let [a, b] = ring.map(|p| frame.local(p));
            let cross = a.cross(b);
            objective += cross;
            let double_area = face.double_area / (frame.radius * frame.radius);
            area += double_area;
            let across = (b - a).cross(face.normal);
            let length = across.length();
            if let Some(upright) = wish.upright.filter(|_| length > LEVEL) {
                let offset = (upright * double_area - cross.dot(face.normal)) / length;
                self.fixed.push(HalfSpace { normal: -across / length, offset });
            }
        }
        objective += wish.tilt * objective.length();
        (area > 0.0).then(|| objective / area)
    }

    /// Adds a plane for every new face that has mesh in front of it, and says whether there was
    /// none.
    fn cut(
        &mut self,
        star: &[StarFace],
        frame: &Frame,
        x: DVec3,
        clearance: f64,
        search: &Search<'_>,
    ) -> bool {
        let tolerance = LEVEL * frame.radius;
        let margin = search.obstacle.margin();
        let mut clear = true;
        for (face, cut) in star.iter().zip(&mut self.cuts) {
            let rises = face.normal.dot(x - face.corners[0]) >= -tolerance;
            let found = match face.ring {
                // A face that rises cuts nothing off, but may turn towards what it has to keep away
                // from.
                Some(ring) if margin > 0.0 => {
                    let sweep =
                        Sweep::new(search.obstacle, frame, face, ring, x, clearance, tolerance);
                    if search.edges {
                        sweep.pieces(&search.near[1])
                    } else {
                        sweep.points(&search.near[0])
                    }
                }
                _ if rises => None,
                Some(ring) => turned(face, ring, frame, x, clearance / frame.radius, search),
                None => raised(face, frame, x, (margin + clearance) / frame.radius, search),
            };
            if found.is_some() {
                *cut = found;
                clear = false;
            }
        }
        clear
    }

    /// Adds a plane for every new face that the mesh comes near from the side, and says whether
    /// there was none.
    fn push_apart(
        &mut self,
        star: &[StarFace],
        frame: &Frame,
        x: DVec3,
        clearance: f64,
        search: &Search<'_>,
    ) -> bool {
        let before = self.pushes.len();
        for face in star {
            let Some(ring) = face.ring else { continue };
            let tolerance = LEVEL * frame.radius;
            let sweep = Sweep::new(search.obstacle, frame, face, ring, x, clearance, tolerance);
            self.pushes.extend(sweep.beside(&search.near[1]));
        }
        self.pushes.len() == before
    }
}

/// The plane about a ring edge that keeps the new face above the mesh below the old one;
/// `clearance` in the frame's unit.
fn turned(
    face: &StarFace,
    [a, b]: [DVec3; 2],
    frame: &Frame,
    x: DVec3,
    clearance: f64,
    search: &Search<'_>,
) -> Option<HalfSpace> {
    let edge = b - a;
    let tolerance = LEVEL * frame.radius;
    let least = 10.0 * tolerance * edge.length();
    let height = Cell::new(tolerance);
    let turned = |q: DVec3| {
        let normal = edge.cross(q - a);
        let length = normal.length();
        // The edge itself turns no plane about it.
        if length <= least {
            return None;
        }
        let normal = normal / length;
        let above = normal.dot(a - x);
        (above > height.get()).then(|| {
            height.set(above);
            Plane { normal, offset: normal.dot(a) }
        })
    };
    search.highest(&Tetrahedron::new(&face.corners, x), turned).map(|plane| {
        let offset = plane.normal.dot(frame.local(a)) + clearance;
        HalfSpace { normal: plane.normal, offset }
    })
}

/// The plane that keeps a vertex above the mesh below a face that vanishes; `clearance` in the
/// frame's unit.
fn raised(
    face: &StarFace,
    frame: &Frame,
    x: DVec3,
    clearance: f64,
    search: &Search<'_>,
) -> Option<HalfSpace> {
    let below = face.normal.dot(x);
    let height = Cell::new(LEVEL * frame.radius);
    let raised = |q: DVec3| {
        let offset = face.normal.dot(q);
        (offset - below > height.get()).then(|| {
            height.set(offset - below);
            Plane { normal: face.normal, offset }
        })
    };
    search.highest(&Tetrahedron::new(&face.corners, x), raised).map(|plane| {
        let normal = plane.normal;
        let offset = normal.dot(frame.local(x)) + height.get() / frame.radius + clearance;
        HalfSpace { normal, offset }
    })
}

/// Where planes are looked for.
struct Search<'a> {
    obstacle: &'a Obstacle,
    near: &'a [Frontier; 2],
    /// Edges of the mesh too, not only its vertices.
    edges: bool,
}

impl Search<'_> {
    /// The last plane that `raise` returned for points of the mesh in a tetrahedron. Each must be
    /// above the one before, so that points below it need not be looked at.
    fn highest(
        &self,
        tetrahedron: &Tetrahedron,
        raise: impl Fn(DVec3) -> Option<Plane>,
    ) -> Option<Plane> {
        if self.edges {
            self.obstacle.highest_piece(&self.near[1], tetrahedron, raise)
        } else {
            self.obstacle.highest_point(&self.near[0], tetrahedron, raise)
        }
    }
}

/// The frame of a program: origin in the star, its radius as unit.
pub(crate) struct Frame {
    centre: DVec3,
    pub radius: f64,
}

impl Frame {
    pub fn local(&self, p: DVec3) -> DVec3 {
        (p - self.centre) / self.radius
    }
}
