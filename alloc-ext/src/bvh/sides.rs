//! Which stored triangles tell sides.
//!
//! A side is told by the nearest stored triangle: whether it has its front to the point. That is
//! the input's side if two things hold.
//! - In front of the triangle the stored surface has [winding number 0](crate::surface::Fronts).
//!   Behind it the number is 1. The nearest triangle has the point just in front or just behind.
//! - The point is farther from the stored surface than the surface error. While vertices move from
//!   their places in the input to the stored ones, no triangle reaches the point, and it keeps its
//!   winding number.
//!
//! The proof looks at the stored surface alone, moved or not. Where a component crosses itself, or
//! components cross, triangles have winding number 1 in front: a point next to them would be called
//! outside, and is inside. Such triangles are *sideless*. So are those of a component that is
//! inside out, and of a solid in a solid.
//!
//! Repair winds a component as most of its triangles are. If its box meets no other component's
//! box, it bounds a solid in either winding. If its box meets another's, or more than two of its
//! triangles share an edge, the majority would decide whether a part of it is a cavity. Then this
//! component and those whose boxes meet its box are sideless.

use super::store::OnGrid;
use super::stored_triangles::StoredTriangles;
use crate::geom::{Bounds, Face, StaticTree, crosses, faces};
use crate::mesh::Mesh;
use crate::surface::{Defect, EdgeTable, Fronts, components};
use glam::DVec3;
use std::borrow::Cow;

/// Which triangles of a closed mesh tell no side, and why.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct SidesReport {
    /// The first defect.
    pub defect: SideDefect,
    /// A corner of the triangle, or of the first.
    pub at: [f32; 3],
    /// Whether the surface with vertices in `f32` has the defect. False also if `f32` was not
    /// tested.
    pub in_f32: bool,
    /// Triangles that tell no side.
    pub sideless: usize,
    /// Whether no triangle tells one.
    pub are_lost: bool,
}

/// Defect of a closed surface by which triangles tell no side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SideDefect {
    /// Two triangles, by their numbers in the input, cross or overlap, or touch in a segment
    /// within one of them.
    Crossing([u32; 2]),
    /// In front of this triangle, by its number in the input, the winding number is not 0, or was
    /// not found: the surface is inside out there, or inside another part of itself.
    Winding(u32),
    /// The component of this triangle, by its number in the input, is wound both ways, and its box
    /// meets that of another.
    Mixed(u32),
}

/// A defect and its place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placed {
    defect: SideDefect,
    at: [f32; 3],
    in_f32: bool,
}

/// The triangles of a stored surface that tell sides.
#[derive(Clone, Debug)]
pub(super) struct Sides {
    /// Whether none tells one.
    pub(super) are_lost: bool,
    /// Per triangle whether it tells none; empty if all tell sides.
    pub(super) sideless: Vec<bool>,
    /// Why.
    pub(super) defect: Option<Placed>,
    /// Pairs of triangles that cross: all, if they are fewer than
    /// [`most_crossings`](crate::surface::most_crossings).
    pub(super) crossings: Vec<[u32; 2]>,
}

impl Sides {
    /// All triangles tell sides.
    pub(super) const ALL: Self =
        Self { are_lost: false, sideless: Vec::new(), defect: None, crossings: Vec::new() };
    /// None does: the mesh is not closed, or has no winding for sides.
    pub(super) const NONE: Self =
        Self { are_lost: true, sideless: Vec::new(), defect: None, crossings: Vec::new() };

    pub(super) fn count_sideless(&self) -> usize {
        self.sideless.iter().filter(|&&is| is).count()
    }

    pub(super) fn report(&self) -> Option<SidesReport> {
        self.defect.map(|Placed { defect, at, in_f32 }| SidesReport {
            defect,
            at,
            in_f32,
            sideless: self.count_sideless(),
            are_lost: self.are_lost,
        })
    }
}

/// How the file winds the triangles of a mesh.
struct FiledWinding {
    /// Per triangle 1 as in the mesh, −1 the other way, 0 in a component of both.
    times: Vec<i32>,
    /// Triangles of components that the file winds both ways and that are not alone, and of those
    /// whose boxes meet theirs.
    mixed: Vec<u32>,
}

/// A closed mesh in the winding that tells sides, and its edges.
pub(super) struct Sided<'a> {
    pub(super) mesh: &'a Mesh,
    edges: Cow<'a, EdgeTable>,
}

impl<'a> Sided<'a> {
    pub(super) fn new(mesh: &'a Mesh, stored: &'a StoredTriangles<'_>) -> Self {
        // Half-edges of turned triangles have other numbers.
        let edges = match stored.turned.contains(&true) {
            true => Cow::Owned(EdgeTable::new(mesh.positions.len(), &mesh.triangles)),
            false => Cow::Borrowed(&stored.edges),
        };
        Self { mesh, edges }
    }

    /// Which triangles tell sides with vertices where a grid has them.
    ///
    /// Cost: that of [`Fronts::of`].
    pub(super) fn sides(&self, grid: &OnGrid) -> Sides {
        let mesh = self.mesh;
        let faces = faces(&grid.positions, &mesh.triangles);
        let filed = self.filed(&grid.positions);
        let times = filed.as_ref().map(|filed| filed.times.as_slice());
        let Fronts { others: mut sideless, defect, crossings } =
            Fronts::of(&faces, &mesh.triangles, &self.edges, times);
        let mixed = filed.map_or_else(Vec::new, |filed| filed.mixed);
        let defect = match (defect, mixed.first()) {
            (Some(defect), _) => Some(self.placed(defect, grid.is_f32)),
            // The file's winding is no matter of places.
            (None, mixed) => mixed.map(|&face| self.at(face, SideDefect::Mixed, true)),
        };
        if !mixed.is_empty() {
            sideless.resize(faces.len(), false);
            mixed.into_iter().for_each(|t| sideless[t as usize] = true);
        }
        let are_lost = !sideless.is_empty() && sideless.iter().all(|&is| is);
        Sides { are_lost, sideless, defect, crossings }
    }

    /// How often the file winds each triangle, if the mesh winds some otherwise: 0 in a component
    /// of both.
    pub(super) fn times(&self, positions: &[DVec3]) -> Option<Vec<i32>> {
        self.filed(positions).map(|filed| filed.times)
    }

    /// A pair of those that cross which does so with vertices where `exact` has them.
    pub(super) fn still_crossing(&self, crossings: &[[u32; 2]], exact: &OnGrid) -> Option<Placed> {
        let face = |face: u32| {
            let ids = self.mesh.triangles[face as usize];
            Face { ids, at: ids.map(|v| exact.positions[v as usize]) }
        };
        let crosses = |[a, b]: &&[u32; 2]| crosses(&face(*a), &face(*b));
        let pair = crossings.iter().find(crosses)?;
        Some(self.placed(Defect::Crossing(*pair), exact.is_f32))
    }

    /// How the file winds components, if it winds some otherwise than the mesh and others not.
    fn filed(&self, positions: &[DVec3]) -> Option<FiledWinding> {
        let Mesh { triangles, turned, .. } = self.mesh;
        if !turned.contains(&false) || !turned.contains(&true) {
            return None;
        }
        let components = components(positions.len(), triangles);
        let of = |component: &Vec<u32>| {
            let corners = component.iter().flat_map(|&t| triangles[t as usize]);
            corners.map(|v| positions[v as usize]).fold(Bounds::EMPTY, Bounds::with)
        };
        let boxes: Vec<Bounds> = components.iter().map(of).collect();
        let tree = StaticTree::new(&boxes);
        let is_turned = |t: &u32| turned[*t as usize];
        let mut is_crowded = vec![false; triangles.len()];
        for (_, half_edge) in self.edges.edges().filter(|edge| edge.len() > 2).flatten() {
            is_crowded[*half_edge as usize / 3] = true;
        }
        let mut filed = FiledWinding { times: vec![0; triangles.len()], mixed: Vec::new() };
        for (i, component) in components.iter().enumerate() {
            if component.iter().all(is_turned) || !component.iter().any(is_turned) {
                let times = if is_turned(&component[0]) { -1 } else { 1 };
                component.iter().for_each(|&t| filed.times[t as usize] = times);
                continue;
            }
            let mut beside = Vec::new();
            tree.visit_meeting(&boxes[i], |j| {
                beside.extend((j != i && boxes[j].meets(&boxes[i])).then_some(j));
                true
            });
            if !beside.is_empty() || component.iter().any(|&t| is_crowded[t as usize]) {
                filed.mixed.extend(component);
                beside.into_iter().for_each(|j| filed.mixed.extend(&components[j]));
            }
        }
        Some(filed)
    }

    fn placed(&self, defect: Defect, in_f32: bool) -> Placed {
        let number = |face: u32| self.mesh.source[face as usize];
        match defect {
            Defect::Crossing([a, b]) => {
                self.at(a, |a| SideDefect::Crossing([a, number(b)]), in_f32)
            }
            Defect::Winding(face) => self.at(face, SideDefect::Winding, in_f32),
        }
    }

    fn at(&self, face: u32, defect: impl FnOnce(u32) -> SideDefect, in_f32: bool) -> Placed {
        let mesh = self.mesh;
        let at = mesh.positions[mesh.triangles[face as usize][0] as usize];
        Placed { defect: defect(mesh.source[face as usize]), at, in_f32 }
    }
}
