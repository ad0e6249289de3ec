//! A mesh with the planes of its faces, and the star of an edge for the placement.

use super::Conditions;
use super::placement::{Facet, Placement, Refusal, StarFace, place};
use super::quadric::Quadrics;
use super::star::Connectivity;
use crate::geom::{Bounds, Face, MovingBoxes, fits};
use crate::lp::HalfSpace;
use crate::surface::{Grid, compact_in_order};
use glam::DVec3;
use std::hint::select_unpredictable as select;

/// A closed manifold mesh while its edges are collapsed.
pub struct Surface {
    pub mesh: Connectivity,
    pub positions: Vec<DVec3>,
    facets: Vec<Facet>,
    /// Boxes of the faces, if these have to stay apart.
    boxes: Option<MovingBoxes>,
    pub conditions: Conditions,
    grid: Grid,
    /// Triangles from this one on close holes. No condition is about them.
    fillers: usize,
    /// Where vertices are placed near the surface, and not outside of it.
    quadrics: Option<Quadrics>,
    /// Linear programs solved.
    pub programs: u64,
    /// Star of the current edge, and its linear program: kept to save allocations.
    star: Vec<u32>,
    faces: Vec<StarFace>,
    planes: Vec<HalfSpace>,
}

impl Surface {
    /// Positions on `grid`.
    pub fn new(
        positions: Vec<DVec3>,
        triangles: &[[u32; 3]],
        conditions: Conditions,
        grid: Grid,
    ) -> Self {
        let corners = |t: &[u32; 3]| t.map(|v| positions[v as usize]);
        let boxes = || triangles.iter().map(|t| Bounds::of(&corners(t))).collect::<Vec<_>>();
        Surface {
            mesh: Connectivity::new(positions.len(), triangles),
            facets: triangles.iter().map(|t| Facet::of(corners(t))).collect(),
            boxes: conditions.keeps_apart.then(|| MovingBoxes::new(&boxes())),
            positions,
            conditions,
            grid,
            fillers: triangles.len(),
            quadrics: None,
            programs: 0,
            star: Vec::new(),
            faces: Vec::new(),
            planes: Vec::new(),
        }
    }

    /// As [`new`](Self::new), for vertices that are placed near the surface. Triangles from
    /// `fillers` on close holes.
    pub fn near(
        positions: Vec<DVec3>,
        triangles: &[[u32; 3]],
        fillers: usize,
        conditions: Conditions,
        grid: Grid,
    ) -> Self {
        let quadrics = Some(Quadrics::new(&positions, triangles, fillers));
        Surface { fillers, quadrics, ..Self::new(positions, triangles, conditions, grid) }
    }

    /// Whether vertices are placed outside of the surface.
    pub fn encloses(&self) -> bool {
        self.quadrics.is_none()
    }

    /// Gathers the star of an edge for its placement; `false` if the edge may not collapse.
    #[inline]
    pub fn gather(&mut self, [a, b]: [u32; 2]) -> bool {
        if !self.mesh.collapsible_star(a, b, self.conditions.max_valence, &mut self.star) {
            return false;
        }
        self.faces.clear();
        for &t in self.star.iter().filter(|&&t| (t as usize) < self.fillers) {
            let corners = self.mesh.corners[t as usize];
            let [p, q, r] = corners.map(|v| v == a || v == b);
            let moving = match (p, q, r) {
                (true, false, false) => Some(0),
                (false, true, false) => Some(1),
                (false, false, true) => Some(2),
                _ => None,
            };
            self.faces.push(StarFace {
                corners: corners.map(|v| self.positions[v as usize]),
                facet: self.facets[t as usize],
                moving,
            });
        }
        true
    }

    /// Places the vertex of the edge whose star was gathered last.
    ///
    /// # Errors
    /// Why there is no place.
    pub fn place(&mut self, [a, b]: [u32; 2], exact: bool) -> Result<Placement, Refusal> {
        if let Some(quadrics) = &self.quadrics {
            let at = [a, b].map(|v| self.positions[v as usize]);
            let grid = exact.then_some(&self.grid);
            return quadrics.place([a, b], at, &self.faces, &self.conditions, grid);
        }
        self.programs += 1;
        let middle = (self.positions[a as usize] + self.positions[b as usize]) * 0.5;
        let placed =
            place(&self.faces, middle, &self.conditions, &self.grid, exact, &mut self.planes)?;
        if exact && !self.keeps_apart(a, placed.position) {
            return Err(Refusal::Condition(placed.cost));
        }
        Ok(placed)
    }

    /// Whether the faces of the star that was gathered last still meet none, if they have to, once
    /// their ends are at `x`, which is vertex `a`. Exact.
    fn keeps_apart(&self, a: u32, x: DVec3) -> bool {
        let Some(boxes) = &self.boxes else { return true };
        let moved = |(&t, face): (&u32, &StarFace)| {
            let Face { mut ids, mut at } = self.face(t);
            let moving = face.moving?;
            (ids[moving], at[moving]) = (a, x);
            Some(Face { ids, at })
        };
        let new: Vec<Face> = self.star.iter().zip(&self.faces).filter_map(moved).collect();
        fits(&new, |bounds, is_apart| {
            boxes.visit_meeting(bounds, |t| self.star.contains(&t) || is_apart(&self.face(t)))
        })
    }

    fn face(&self, t: u32) -> Face {
        let ids = self.mesh.corners[t as usize];
        Face { ids, at: ids.map(|v| self.positions[v as usize]) }
    }

    /// The second priority of an edge, whether it may collapse or not: unsigned volumes of the
    /// tetrahedra between its star's faces and the centre of its link.
    #[inline]
    pub fn span(&self, [a, b]: [u32; 2]) -> f64 {
        let mut centre = DVec3::ZERO;
        let mut count = 0.0;
        for (v, other) in [(a, b), (b, a)] {
            for &t in self.mesh.at(v) {
                let [p, q, r] = self.mesh.corners[t as usize];
                // Each corner is as likely to be `v`: a branch would be guessed wrong.
                let next = select(p == v, q, select(q == v, r, p));
                if p != other && q != other && r != other {
                    centre += self.positions[next as usize];
                    count += 1.0;
                }
            }
        }
        centre /= count;
        let volume = |t: u32| {
            let facet = &self.facets[t as usize];
            (facet.normal.dot(centre - facet.corner) * facet.double_area).abs()
        };
        let of_a: f64 = self.mesh.at(a).iter().map(|&t| volume(t)).sum();
        let only_of_b =
            self.mesh.at(b).iter().filter(|&&t| !self.mesh.corners[t as usize].contains(&a));
        only_of_b.fold(of_a, |sum, &t| sum + volume(t)) / 6.0
    }

    /// Collapses edge `a b` into `a`, which moves to `x`.
    pub fn collapse(&mut self, a: u32, b: u32, x: DVec3) {
        if let Some(boxes) = &mut self.boxes {
            self.mesh.at(b).iter().for_each(|&t| boxes.set(t, &Bounds::EMPTY));
        }
        self.mesh.collapse(a, b);
        self.move_vertex(a, x);
        if let Some(quadrics) = &mut self.quadrics {
            quadrics.merge(a, b);
        }
    }

    /// Moves a vertex, and the planes of its faces with it.
    fn move_vertex(&mut self, v: u32, x: DVec3) {
        self.positions[v as usize] = x;
        for &t in self.mesh.at(v) {
            let corners = self.mesh.corners[t as usize];
            let corners = corners.map(|v| self.positions[v as usize]);
            self.facets[t as usize] = Facet::of(corners);
            if let Some(boxes) = &mut self.boxes {
                boxes.set(t, &Bounds::of(&corners));
            }
        }
    }

    /// Positions and triangles that are left, each in its old order.
    pub fn compact(&self) -> (Vec<DVec3>, Vec<[u32; 3]>) {
        compact_in_order(&self.positions, self.mesh.alive().map(|t| self.mesh.corners[t as usize]))
    }
}
