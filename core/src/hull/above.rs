//! A bound of the distance from above, before a search comes to a triangle of the surface.
//!
//! Each vertex of a coarse level was split into two of finer ones, down to vertices of the surface.
//! The way down to the nearer of the two, again and again, ends at a vertex of the surface that is
//! about as near as any below the first one. Its distance is an upper bound (Guéziec 2000, 3.2 and
//! 4.1), at the price of some dozens of places. A sweep to the surface takes as many refinements.
//!
//! Instructions on x86-64, far points of a scanned part of 20,088 triangles: 313,600 exact, 122,100
//! at 5 %, 50,400 at 20 %. Before, they were 310,800, 174,100 and 105,500. What is left is spent on
//! lower bounds, which the radii of coarse triangles keep low. **Lost:** the farthest corner of
//! each triangle plus its radius, for the least of all that are seen: 160,400 and 84,000. A stored
//! byte would add the distance of triangle and surface, about that radius. **Command.**
//! `cargo xtask count "sweep BLOB 0 0.05"`.

use super::format::{Hull, Instance, Named, VertIdx};
use super::front::Front;
use super::geometry::Geometry;
use super::nearest::Nearest;
use crate::num::tolerance::U64;
use glam::Vec3;

/// The nearest known vertex of the surface.
#[derive(Debug)]
pub(super) struct Above {
    vertex: Option<VertIdx>,
    /// Its distance, rounded up.
    upper: f64,
    /// After so many refinements a nearer vertex is looked for.
    again: u32,
}

impl Above {
    /// No vertex.
    pub(super) const NONE: Above = Above { vertex: None, upper: f64::INFINITY, again: u32::MAX };

    /// Looks below the nearest corner of the base hull, of its triangles or of some of them: a vertex
    /// of no triangle would be no point of the surface. Does nothing where
    /// vertices may lie off the surface: in a cut blob, and in levels that do not enclose it, some
    /// of whose vertices only close the mesh.
    #[inline(never)]
    pub(super) fn begin<'a>(
        &mut self,
        geometry: &impl Geometry<'a>,
        nearest: &mut Nearest,
    ) -> Option<()> {
        let tables = geometry.tables();
        if tables.is_cut() || !tables.encloses() {
            return Some(());
        }
        let p = nearest.point().as_vec3();
        let mut best = (f32::INFINITY, VertIdx(0));
        let count = tables.header().base_triangles;
        let mut index = 0;
        while index < count {
            let [vertex, ..] = tables.base_triangle(index)?;
            let square = geometry.place(vertex)?.distance_squared(p);
            if square < best.0 {
                best = (square, vertex);
            }
            index += count / TRIED + 1;
        }
        if best.0 == f32::INFINITY {
            return Some(());
        }
        self.again = 0;
        self.descend(geometry, best.1, p, nearest)
    }

    /// Looks below the nearest corner of the triangle that is opened next, now and then, if a
    /// little nearer vertex would meet the tolerance.
    #[cold]
    #[inline(never)]
    pub(super) fn improve<'a, G: Geometry<'a>>(
        &mut self,
        front: &Front<'_, G>,
        instance: Instance,
        nearest: &mut Nearest,
        (within, bound): ([f64; 2], f64),
    ) {
        let opened = front.work.opened;
        let hoped = HOPED * nearest.upper();
        let error = front.model.surface_error();
        if opened < self.again || !nearest.is_within_from(hoped, within, bound, error) {
            return;
        }
        self.again = opened + opened / 4 + 1;
        let Some(corners) = front.model.tables().corners(instance) else { return };
        let p = nearest.point().as_vec3();
        let mut best = (f32::INFINITY, VertIdx(0));
        for vertex in corners {
            let square =
                front.model.place(vertex).map_or(f32::INFINITY, |at| at.distance_squared(p));
            if square < best.0 {
                best = (square, vertex);
            }
        }
        // Of checked tables there is a way down from every corner.
        let _ = self.descend(&front.model, best.1, p, nearest);
    }

    /// Takes the vertex of the surface that the way down from a vertex ends at.
    #[inline(never)]
    fn descend<'a>(
        &mut self,
        geometry: &impl Geometry<'a>,
        from: VertIdx,
        p: Vec3,
        nearest: &mut Nearest,
    ) -> Option<()> {
        let tables = geometry.tables();
        let mut vertex = from;
        let mut place = geometry.place(vertex)?;
        // A split brings vertices of greater numbers than it replaces.
        while let Some(split) = tables.split_of(vertex) {
            let parts = [tables.brought_by(split, 0), tables.brought_by(split, 1)];
            let places = [geometry.place(parts[0])?, geometry.place(parts[1])?];
            let [first, second] = places.map(|place| place.distance_squared(p));
            let nearer = usize::from(second < first);
            (vertex, place) = (parts[nearer], places[nearer]);
        }
        let upper = nearest.point().distance(place.as_dvec3()) * (1.0 + 8.0 * U64);
        if upper < nearest.upper() {
            (self.vertex, self.upper) = (Some(vertex), upper);
            nearest.limit_upper(upper);
        }
        Some(())
    }

    /// At the end of a search: evaluates a triangle at the vertex, if no nearer one was evaluated.
    #[inline(never)]
    pub(super) fn settle<'a, G: Geometry<'a>>(
        &self,
        front: &Front<'_, G>,
        nearest: &mut Nearest,
    ) -> Option<()> {
        if let Some(vertex) = self.vertex
            && self.upper <= nearest.upper()
        {
            let instance = surface_triangle(front.model.tables(), vertex)?;
            nearest.evaluate(&front.look(instance)?);
        }
        Some(())
    }
}

/// Triangles of the base hull whose first corners are compared at most.
const TRIED: u32 = 128;
/// A nearer vertex is looked for if one at this part of the upper bound would meet the tolerance.
const HOPED: f64 = 0.92;

/// A triangle of the surface at one of its vertices.
fn surface_triangle(tables: &Hull<'_>, vertex: VertIdx) -> Option<Instance> {
    let named = match tables.made_by(vertex) {
        // The first triangle is one of the origin, the last of the ring one of the destination.
        Some(split) if tables.which(vertex) == 0 => Named::Fine(split, 0),
        Some(split) => {
            let last = tables.split(split)?.ring_len().checked_sub(1)?;
            Named::Fine(split, u32::try_from(last).ok()?)
        }
        None => {
            let has_it = |&index: &u32| {
                tables.base_triangle(index).is_some_and(|corners| corners.contains(&vertex))
            };
            Named::Base((0..tables.header().base_triangles).find(has_it)?)
        }
    };
    let mut instance = tables.instance(named);
    loop {
        let corners = tables.corners(instance)?;
        let Some(index) = tables.removed_by(corners) else { return Some(instance) };
        let split = tables.split(index)?;
        // The child at the same edge keeps the vertex, for no split replaces it.
        let [a, b, c] = corners;
        let from = if a == split.vertex {
            b
        } else if b == split.vertex {
            c
        } else {
            a
        };
        let slot = u32::try_from(split.find(from)?).ok()?;
        instance = tables.instance(Named::Fine(index, slot));
    }
}
