//! Cells: the part of a mesh, or of the solid that it bounds, between the planes of the splits
//! above, and its tribox.
//!
//! *Why the tribox holds the solid, too.* The extreme point of the solid in a cell along a
//! direction is a point of the surface, which [`polygons`](super::polygons) cover, or a vertex of a
//! region that holds the solid there. The parent's tribox, cut by the plane, is such a region. Its
//! vertices are computed within 2^-47 of the largest coordinate, 1/64 of the margin by which they
//! are padded. If a computed vertex is outside of the solid and the true one inside, then the
//! surface passes between them. The surface's own bounds are padded by the same margin everywhere,
//! so they hold the true vertex. A vertex whose winding number is undecided counts as inside.

use super::polygons::{HalfSpace, Polygons, margin};
use super::span::{Frame, projections};
use super::winding::{Reference, starts, winding};
use crate::mesh::Mesh;
use meshsweep_core::Budget;
use meshsweep_core::Bvh;
use meshsweep_core::internal::num::{down_to_f32, up_to_f32};
use meshsweep_core::{ScratchEntry, Side};
use meshsweep_core::{Tribox, TriboxError};
use std::cell::RefCell;

/// Certainty of points' sides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Trust {
    /// A point counts as outside only if its winding number proves that.
    Proof,
    /// The box tree's side decides: good enough to choose planes.
    Sketch,
}

/// Data that all cells of a mesh share.
pub(super) struct Whole<'a> {
    /// Those with an area: wires have higher numbers, and do not change winding numbers.
    pub triangles: Vec<[[f64; 3]; 3]>,
    /// Whether winding numbers exist, so that the solid counts and not only its surface.
    pub is_solid: bool,
    /// Distance by which planes are moved outward, see [`polygons`](super::polygons).
    pub margin: f64,
    /// [`Mesh::rounding`].
    pub rounding: f64,
    tree: &'a Bvh<'a>,
    stack: RefCell<Vec<ScratchEntry>>,
}

/// `S ∩ C`, `C` being where all half-spaces of the splits above meet.
pub(super) struct Cell {
    pub tribox: Tribox,
    pub polygons: Polygons,
    /// Of the tribox.
    pub frame: Frame,
    /// Vertices of `C` that may be in the solid: the paper's second kind.
    pub inner: Vec<[f64; 3]>,
    /// None in a sketch.
    references: Vec<Reference>,
}

impl<'a> Whole<'a> {
    pub fn new(mesh: &Mesh, tree: &'a Bvh<'a>) -> Self {
        let at = |v: u32| mesh.positions[v as usize].map(f64::from);
        let size =
            mesh.positions.iter().flatten().fold(0f64, |most, &x| most.max(f64::from(x).abs()));
        Whole {
            triangles: mesh.triangles.iter().map(|t| t.map(at)).collect(),
            is_solid: tree.header().is_closed(),
            margin: margin(size),
            rounding: mesh.rounding,
            tree,
            stack: RefCell::new(vec![ScratchEntry::EMPTY; tree.header().stack_entries as usize]),
        }
    }

    /// The cell that no plane bounds.
    pub fn root(&self, mesh: &Mesh) -> Result<Cell, TriboxError> {
        let used = mesh.all_triangles().flatten().map(|v| mesh.positions[v as usize]);
        let tribox = Tribox::of_points(used)?;
        let [x, y, z, ..] = tribox.high.map(f64::from);
        let size = tribox
            .slabs()
            .take(3)
            .map(|(low, high)| f64::from(high) - f64::from(low))
            .fold(0.0, f64::max);
        let beyond = [x + 0.3819 * size, y + 0.6731 * size, z + 0.2913 * size];
        let references = vec![Reference { at: beyond, winding: 0 }];
        let (polygons, frame) = (Polygons::of(mesh), Frame::of(&tribox));
        Ok(Cell { tribox, polygons, frame, inner: Vec::new(), references })
    }

    /// Winding number of a point of a cell; `None` if it is undecided.
    fn winding(&self, cell: &Cell, point: [f64; 3]) -> Option<i32> {
        let loops = cell.polygons.loops.iter();
        let triangles =
            loops.filter_map(|&(triangle, _)| self.triangles.get(triangle as usize).copied());
        winding(point, &cell.references, triangles)
    }

    /// Whether a point of a cell may be in the solid. With [`Trust::Proof`] `false` is a proof that
    /// its winding number is 0.
    pub fn is_inside(&self, cell: &Cell, point: [f64; 3], trust: Trust) -> bool {
        if !self.is_solid {
            return false;
        }
        match trust {
            Trust::Proof => self.winding(cell, point) != Some(0),
            Trust::Sketch => {
                let asked = point.map(|x| x as f32);
                let answer =
                    self.tree.signed_distance(asked, Budget::EXACT, &mut self.stack.borrow_mut());
                answer.is_ok_and(|answer| answer.side != Side::Outside)
            }
        }
    }

    /// The part of a cell in a half-space; `None` if there is nothing. The half-space's plane has
    /// to be an f32.
    ///
    /// The new cell's tribox is inside of the old one's and of the half-space.
    pub fn part(&self, cell: &Cell, half: &HalfSpace, trust: Trust) -> Option<Cell> {
        let mut region = cell.tribox;
        let bound = if half.is_low { &mut region.high } else { &mut region.low };
        bound[half.slab] = half.at as f32;
        let region = region.tightened();
        let polygons = cell.polygons.clipped(half, self.margin);
        let inner = if self.is_solid { self.inner(cell, half, trust) } else { Vec::new() };
        let mut bound = polygons.bound(self.margin, self.is_solid);
        for &vertex in &inner {
            bound = bound.union(&around(vertex, self.margin));
        }
        let tribox = bound.intersection(&region).tightened();
        if tribox.is_empty() {
            return None;
        }
        let mut references = Vec::new();
        if self.is_solid && trust == Trust::Proof {
            for at in starts(&Frame::of(&region)) {
                references.extend(self.winding(cell, at).map(|winding| Reference { at, winding }));
            }
        }
        Some(Cell { tribox, polygons, frame: Frame::of(&tribox), inner, references })
    }

    /// Vertices of the second kind of a cell's part in a half-space: of the cell's tribox, and of
    /// its section with the plane.
    ///
    /// The tribox may replace the region between the planes, for it holds all of the solid there.
    fn inner(&self, cell: &Cell, half: &HalfSpace, trust: Trust) -> Vec<[f64; 3]> {
        let reach = if half.is_low { half.at + self.margin } else { half.at - self.margin };
        let along = |vertex: &[f64; 3]| projections(*vertex)[half.slab];
        let is_kept = |vertex: &[f64; 3]| {
            if half.is_low { along(vertex) <= reach } else { along(vertex) >= reach }
        };
        let vertices = cell.frame.vertices.iter().copied().filter(is_kept);
        let vertices = vertices.chain(section(&cell.frame, half.slab, half.at));
        vertices.filter(|&vertex| self.is_inside(cell, vertex, trust)).collect()
    }
}

/// Points where the edges of a polytope pass a plane.
pub(super) fn section(frame: &Frame, slab: usize, at: f64) -> impl Iterator<Item = [f64; 3]> + '_ {
    frame.edges.iter().filter_map(move |&(i, j)| {
        let (a, b) = (frame.vertices[i], frame.vertices[j]);
        let (from, to) = (projections(a)[slab], projections(b)[slab]);
        let t = (at - from) / (to - from);
        ((from < at) != (to < at)).then(|| std::array::from_fn(|k| a[k] + t * (b[k] - a[k])))
    })
}

/// A tribox of all points within `margin` of `point` along each axis.
fn around(point: [f64; 3], margin: f64) -> Tribox {
    let along = projections(point);
    let by = |slab: usize| if slab < 3 { margin } else { 2.0 * margin };
    Tribox {
        low: std::array::from_fn(|slab| down_to_f32(along[slab] - by(slab))),
        high: std::array::from_fn(|slab| up_to_f32(along[slab] + by(slab))),
    }
}
