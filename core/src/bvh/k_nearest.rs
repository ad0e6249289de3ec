//! The nearest triangles so far, in the caller's slice: a heap with the farthest on top (Williams
//! 1964), sorted in place at the end.

use super::descent::LeafVisit;
use super::point_query::PointQuery;
use super::triangle_bounds::{lower_of, witness};
use crate::bvh::format::{Bvh, FanLeaf};
use crate::num::sqrt_approx;
use crate::query::QueryError;

/// A triangle near a point: `lower ≤ distance to the triangle of the input mesh ≤ upper`, in real
/// arithmetic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Neighbor {
    /// Not above the distance, input units.
    pub lower: f32,
    /// Not below the distance, input units.
    pub upper: f32,
    /// A point of the triangle as stored, at most `upper` away but for its rounding to f32.
    pub point: [f32; 3],
    /// The triangle's number in the input file.
    pub triangle: u32,
}

impl Neighbor {
    /// Any value, for filling arrays.
    pub const EMPTY: Neighbor =
        Neighbor { lower: 0.0, upper: f32::INFINITY, point: [0.0; 3], triangle: u32::MAX };
}

/// A triangle that a descent has come to.
#[derive(Clone, Copy)]
pub(crate) struct Candidate {
    pub(crate) distance_sq: f32,
    pub(crate) lower_bound_sq: f32,
    /// In the blob.
    pub(crate) number: u32,
    pub(crate) node: u32,
    pub(crate) child: u32,
    pub(crate) lane: u32,
}

impl Candidate {
    /// Triangle `lane` of a leaf whose first is `first`.
    pub(crate) fn new(
        visit: &LeafVisit<'_>,
        first: u32,
        lane: usize,
        distance_sq: f32,
        lower_bound_sq: f32,
    ) -> Self {
        let (node, child, lane) = (visit.node, visit.lane, lane as u32);
        Candidate {
            distance_sq,
            lower_bound_sq,
            number: first.wrapping_add(lane),
            node,
            child,
            lane,
        }
    }

    /// While the search runs a slot of the caller holds this instead of an answer; node numbers are
    /// below 2^24, so that f32 holds them.
    fn held(self) -> Neighbor {
        let place = [self.node as f32, (self.child * 8 + self.lane) as f32, 0.0];
        Neighbor {
            lower: self.distance_sq,
            upper: self.lower_bound_sq,
            point: place,
            triangle: self.number,
        }
    }

    fn of(held: &Neighbor) -> Candidate {
        let [node, place, _] = held.point;
        let place = place as u32;
        Candidate {
            distance_sq: held.lower,
            lower_bound_sq: held.upper,
            number: held.triangle,
            node: node as u32,
            child: place / 8,
            lane: place % 8,
        }
    }

    fn leaf<'t>(&self, tree: &Bvh<'t>) -> Option<FanLeaf<'t>> {
        tree.leaf(self.node, self.child)
    }

    /// What the triangle is not nearer than, grid units.
    pub(crate) fn lower(&self, tree: &Bvh<'_>, query: &PointQuery) -> Option<f32> {
        let leaf = self.leaf(tree)?;
        Some(lower_of(&leaf, self.lane as usize, query.p, self.distance_sq, self.lower_bound_sq))
    }

    fn answer(&self, tree: &Bvh<'_>, query: &PointQuery) -> Option<Neighbor> {
        let leaf = self.leaf(tree)?;
        Some(Neighbor {
            lower: query.lower(self.lower(tree, query)?),
            upper: query.upper(sqrt_approx(self.distance_sq)),
            point: query.units.point(witness(query, &leaf, self.lane as usize)),
            triangle: tree.source(self.number)?,
        })
    }
}

/// Whether `a` comes after `b`: farther, or as far with a greater number.
fn after(a: &Neighbor, b: &Neighbor) -> bool {
    a.lower > b.lower || (a.lower == b.lower && a.triangle > b.triangle)
}

/// The caller's slice and how much of it is used.
pub(crate) struct KNearest<'a> {
    slots: &'a mut [Neighbor],
    stored: usize,
}

impl<'a> KNearest<'a> {
    pub(crate) fn new(slots: &'a mut [Neighbor]) -> Self {
        KNearest { slots, stored: 0 }
    }

    pub(crate) fn stored(&self) -> usize {
        self.stored
    }

    /// The squared distance that a triangle must not exceed to be stored, once there is no room.
    pub(crate) fn farthest_sq(&self) -> Option<f32> {
        if self.stored < self.slots.len() { None } else { self.slots.first().map(|top| top.lower) }
    }

    /// Stores a triangle; what there is no room for comes back.
    pub(crate) fn offer(&mut self, candidate: Candidate) -> Option<Candidate> {
        let held = candidate.held();
        if self.stored < self.slots.len() {
            let at = self.stored;
            self.stored += 1;
            if let Some(slot) = self.slots.get_mut(at) {
                *slot = held;
            }
            self.rise(at);
            return None;
        }
        match self.slots.first_mut() {
            Some(top) if after(top, &held) => {
                let out = Candidate::of(top);
                *top = held;
                self.sink(self.stored);
                Some(out)
            }
            _ => Some(candidate),
        }
    }

    /// Exchanges two slots if the one at `lower` comes after the one at `upper`.
    fn exchange(&mut self, upper: usize, lower: usize) -> bool {
        match self.slots.get_disjoint_mut([upper, lower]) {
            Ok([a, b]) if after(b, a) => {
                core::mem::swap(a, b);
                true
            }
            _ => false,
        }
    }

    fn rise(&mut self, mut at: usize) {
        while at > 0 {
            let parent = (at - 1) / 2;
            if !self.exchange(parent, at) {
                return;
            }
            at = parent;
        }
    }

    /// Mends the heap of the first `end` slots after its top has changed.
    fn sink(&mut self, end: usize) {
        let mut at = 0;
        loop {
            let left = 2 * at + 1;
            let right = left + 1;
            if left >= end {
                return;
            }
            let child = match (self.slots.get(left), self.slots.get(right)) {
                (Some(l), Some(r)) if right < end && after(r, l) => right,
                _ => left,
            };
            if !self.exchange(at, child) {
                return;
            }
            at = child;
        }
    }

    /// Sorts by rising distance and writes the answers; how many there are.
    pub(crate) fn finish(
        mut self,
        tree: &Bvh<'_>,
        query: &PointQuery,
    ) -> Result<usize, QueryError> {
        for end in (1..self.stored).rev() {
            if let Ok([top, last]) = self.slots.get_disjoint_mut([0, end]) {
                core::mem::swap(top, last);
            }
            self.sink(end);
        }
        // Squares rise; roots that are rounded may not.
        let mut farthest = 0f32;
        for slot in self.slots.iter_mut().take(self.stored) {
            let mut near = Candidate::of(slot).answer(tree, query).ok_or(QueryError::Model)?;
            if near.upper < farthest {
                near.upper = farthest;
            }
            farthest = near.upper;
            *slot = near;
        }
        Ok(self.stored)
    }
}

/// The first triangles of the blob, each with the interval of the whole model; how many. For points
/// from which all are alike.
pub(crate) fn first_triangles(
    tree: &Bvh<'_>,
    query: &PointQuery,
    lower: f32,
    upper: f32,
    out: &mut [Neighbor],
) -> Result<usize, QueryError> {
    let mut slots = out.iter_mut();
    let mut stored = 0;
    for node in 0..tree.header().nodes {
        let links = tree.links(node).ok_or(QueryError::Model)?;
        for child in links.inner..links.count {
            let leaf = tree.leaf(node, child).ok_or(QueryError::Model)?;
            let first = links.triangle(child);
            for lane in 0..leaf.tag().triangles() {
                let Some(slot) = slots.next() else { return Ok(stored) };
                let [corner, ..] = leaf.corners(lane);
                let triangle =
                    tree.source(first.wrapping_add(lane as u32)).ok_or(QueryError::Model)?;
                *slot = Neighbor { lower, upper, point: query.units.point(corner), triangle };
                stored += 1;
            }
        }
    }
    Ok(stored)
}
