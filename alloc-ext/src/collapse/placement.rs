//! Placement of the new vertex of a collapse: on or outside every plane of the star, with the least
//! added volume (Platis & Theoharis 2003, 3.1.2). The vertex is rounded to the stored precision and
//! proved there by an exact predicate.

use super::Conditions;
use crate::lp::{HalfSpace, Order, minimise_bounded};
use crate::surface::Grid;
use glam::DVec3;
use robust::{Coord3D, orient3d};

/// A face's plane. It is kept, so the evaluation of an edge needs no square root for each face.
#[derive(Clone, Copy, Debug, Default)]
pub struct Facet {
    /// Unit normal; zero if the face has no area.
    pub normal: DVec3,
    /// Twice the area.
    pub double_area: f64,
    /// 1 for the equilateral triangle, towards 0 for needles.
    pub compactness: f64,
    /// A point of the plane: the first corner. With it a facet fills a line of the cache.
    pub corner: DVec3,
}

impl Facet {
    /// Of a triangle.
    pub fn of(corners: [DVec3; 3]) -> Self {
        let [a, b, c] = corners;
        let cross = (b - a).cross(c - a);
        let double_area = cross.length();
        Facet {
            normal: if double_area > 0.0 { cross / double_area } else { DVec3::ZERO },
            double_area,
            compactness: compactness(corners, double_area),
            corner: a,
        }
    }
}

/// A triangle of a star.
#[derive(Clone, Copy, Debug)]
pub struct StarFace {
    /// Corners.
    pub corners: [DVec3; 3],
    /// Plane.
    pub facet: Facet,
    /// Which corner moves to the new vertex; `None` for the two triangles that vanish.
    pub moving: Option<usize>,
}

/// A placement that meets all conditions.
#[derive(Clone, Copy, Debug)]
pub struct Placement {
    /// The new vertex.
    pub position: DVec3,
    /// Outside of the surface: six times the volume that the collapse adds. Near it: the weighted
    /// squared distances.
    pub cost: f64,
}

/// Why there is no placement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Refusal {
    /// No point lies outside all planes, or rounding to the stored precision could not be repaired.
    NoVertex,
    /// A condition fails for the optimum, which would cost this much.
    Condition(f64),
}

/// Places the vertex that replaces an edge with midpoint `middle`. With `exact` the vertex is
/// rounded to the grid and proved to lie on or outside every plane. Without, it serves a priority
/// only.
#[inline]
pub fn place(
    faces: &[StarFace],
    middle: DVec3,
    conditions: &Conditions,
    grid: &Grid,
    exact: bool,
    planes: &mut Vec<HalfSpace>,
) -> Result<Placement, Refusal> {
    let mut program = Program::new(faces, middle, conditions, planes).ok_or(Refusal::NoVertex)?;
    let position = if exact {
        program.solve_exactly(faces, grid).ok_or(Refusal::NoVertex)?
    } else {
        program.solve(0.0).ok_or(Refusal::NoVertex)?
    };
    let volume: f64 = faces
        .iter()
        .map(|f| f.facet.normal.dot(position - f.corners[0]) * f.facet.double_area)
        .sum();
    check_shape(faces, position, conditions).map_err(|()| Refusal::Condition(volume))?;
    Ok(Placement { position, cost: volume })
}

/// The linear program of a star in the star's own frame: origin at the edge's midpoint, farthest
/// corner at distance 1.
struct Program<'a> {
    planes: &'a mut Vec<HalfSpace>,
    /// How far the planes are shifted outward now.
    shift: f64,
    objective: DVec3,
    middle: DVec3,
    radius: f64,
    second_term: f64,
    order: Order,
}

impl<'a> Program<'a> {
    fn new(
        faces: &[StarFace],
        middle: DVec3,
        conditions: &Conditions,
        planes: &'a mut Vec<HalfSpace>,
    ) -> Option<Self> {
        let radius_sq = faces
            .iter()
            .flat_map(|f| f.corners)
            .fold(0f64, |r, corner| r.max((corner - middle).length_squared()));
        let radius = radius_sq.sqrt();
        let mut objective = DVec3::ZERO;
        let mut area = 0.0;
        let inverse_radius = 1.0 / radius;
        planes.clear();
        for face in faces {
            let Facet { normal, double_area, .. } = face.facet;
            objective += normal * double_area;
            area += double_area;
            if double_area > 0.0 {
                let offset = normal.dot(face.corners[0] - middle) * inverse_radius;
                planes.push(HalfSpace { normal, offset });
            }
        }
        (area > 0.0 && radius > 0.0).then(|| Program {
            planes,
            shift: 0.0,
            objective: objective / area,
            middle,
            radius,
            second_term: conditions.second_term,
            order: conditions.order,
        })
    }

    /// The optimum with every plane shifted outward by `shift` (in units of the frame of the mesh).
    fn solve(&mut self, shift: f64) -> Option<DVec3> {
        let further = (shift - self.shift) / self.radius;
        self.shift = shift;
        self.planes.iter_mut().for_each(|plane| plane.offset += further);
        let x = minimise_bounded(self.objective, self.planes, self.second_term, self.order)?;
        Some(self.middle + x * self.radius)
    }

    /// The optimum on the grid, on or outside every plane of the star by exact predicate. Rounding
    /// crosses a plane in a third of all collapses. The program is then solved again, with planes
    /// shifted by one to sixteen half-steps of the grid. That repairs nearly all of them.
    fn solve_exactly(&mut self, faces: &[StarFace], grid: &Grid) -> Option<DVec3> {
        let mut shift = 0.0;
        for attempt in 0..6 {
            let rounded = grid.round(self.solve(shift)?)?;
            if faces.iter().all(|face| is_outside_or_on(face.corners, rounded)) {
                return Some(rounded);
            }
            let size = rounded.abs().max_element();
            shift = grid.half_step(size) * f64::from(1 << attempt);
        }
        None
    }
}

/// Exact: `p` does not lie below the plane of the counter-clockwise triangle.
#[inline]
fn is_outside_or_on([a, b, c]: [DVec3; 3], p: DVec3) -> bool {
    let coord = |v: DVec3| Coord3D { x: v.x, y: v.y, z: v.z };
    orient3d(coord(a), coord(b), coord(c), coord(p)) <= 0.0
}

/// 2·√3, which makes the equilateral triangle's compactness 1.
const TWICE_SQRT_3: f64 = 3.464_101_615_137_754_6;

/// Compactness: 1 for the equilateral triangle, towards 0 for needles.
#[inline]
fn compactness([a, b, c]: [DVec3; 3], double_area: f64) -> f64 {
    let edges = (b - a).length_squared() + (c - b).length_squared() + (a - c).length_squared();
    if edges > 0.0 { TWICE_SQRT_3 * double_area / edges } else { 0.0 }
}

/// The paper's two conditions on the resulting vertex: compactness does not decline too much, no
/// normal turns too far.
#[inline]
pub fn check_shape(faces: &[StarFace], position: DVec3, conditions: &Conditions) -> Result<(), ()> {
    let mut worst_before = f64::INFINITY;
    let mut worst_after = f64::INFINITY;
    for face in faces {
        worst_before = worst_before.min(face.facet.compactness);
        let Some(moving) = face.moving else { continue };
        let mut moved = face.corners;
        moved[moving] = position;
        let [a, b, c] = moved;
        let cross = (b - a).cross(c - a);
        let length = cross.length();
        let turned = face.facet.double_area > 0.0
            && face.facet.normal.dot(cross) < conditions.min_normal_cosine * length;
        if length == 0.0 || turned {
            return Err(());
        }
        worst_after = worst_after.min(compactness(moved, length));
    }
    if worst_after > conditions.compactness_ratio * worst_before { Ok(()) } else { Err(()) }
}
