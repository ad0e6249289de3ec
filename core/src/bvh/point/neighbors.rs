//! The nearest triangles so far, in the caller's slice: a heap with the farthest on top (Williams
//! 1964), sorted in place at the end.

use super::leaf::bounds::witness;
use super::query::{FarPoint, PointQuery};
use super::triangle_visitor::LeafTriangle;
use crate::bvh::tree::format::Bvh;
use crate::bvh::tree::triangle_at::TriangleAt;
use crate::num::sqrt_approx;
use crate::query::{Interval, QueryError};

/// A place for a triangle near a point: six words of the caller's memory. While a search runs, they
/// hold a triangle's place. After it they hold the answer.
#[derive(Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Neighbor {
    words: [u32; 6],
}

impl Neighbor {
    /// Any value, for filling arrays.
    pub const EMPTY: Neighbor = Neighbor::of(Interval::new(0.0, f32::INFINITY), [0.0; 3], u32::MAX);

    const fn of(distance: Interval, [x, y, z]: [f32; 3], triangle: u32) -> Neighbor {
        let Interval { lower, upper } = distance;
        let words =
            [lower.to_bits(), upper.to_bits(), x.to_bits(), y.to_bits(), z.to_bits(), triangle];
        Neighbor { words }
    }

    /// The distance to the part of the input's surface that bears this number, input units: to the
    /// triangle, but where repair flipped an edge to remove a triangle without area beside it.
    pub fn distance(&self) -> Interval {
        let [lower, upper, ..] = self.words.map(f32::from_bits);
        Interval { lower, upper }
    }

    /// A point of the triangle as stored, at most `distance().upper` away but for its rounding to
    /// f32.
    pub fn point(&self) -> [f32; 3] {
        let [_, _, x, y, z, _] = self.words.map(f32::from_bits);
        [x, y, z]
    }

    /// The triangle's number in the input file.
    pub fn triangle(&self) -> u32 {
        let [.., triangle] = self.words;
        triangle
    }
}

impl core::fmt::Debug for Neighbor {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Neighbor")
            .field("distance", &self.distance())
            .field("point", &self.point())
            .field("triangle", &self.triangle())
            .finish()
    }
}

impl LeafTriangle {
    /// The triangle in a slot of the caller.
    fn stored(self) -> Neighbor {
        let LeafTriangle { distance_sq, lower_bound_sq, place } = self;
        Neighbor { words: [distance_sq.to_bits(), lower_bound_sq.to_bits(), place.word(), 0, 0, 0] }
    }

    fn of(slot: &Neighbor) -> LeafTriangle {
        let [distance_sq, lower_bound_sq, place, ..] = slot.words;
        let [distance_sq, lower_bound_sq] = [distance_sq, lower_bound_sq].map(f32::from_bits);
        LeafTriangle { distance_sq, lower_bound_sq, place: TriangleAt::of_word(place) }
    }

    fn answer(&self, tree: &Bvh<'_>, query: &PointQuery) -> Option<Neighbor> {
        let leaf = self.place.leaf(tree)?;
        let lower = query.lower(self.lower(&leaf, query));
        let upper = query.upper(sqrt_approx(self.distance_sq));
        let point = query.units.point(witness(query, &leaf, self.place.lane()));
        Some(Neighbor::of(Interval { lower, upper }, point, self.place.source(tree)?))
    }
}

/// Whether triangle `a` comes after `b`: farther, or as far with a greater number.
fn after(a: &Neighbor, b: &Neighbor) -> bool {
    LeafTriangle::of(b).is_before(&LeafTriangle::of(a))
}

/// The caller's slice and how much of it is used.
pub(crate) struct Heap<'a> {
    slots: &'a mut [Neighbor],
    stored: usize,
}

impl<'a> Heap<'a> {
    pub(crate) fn new(slots: &'a mut [Neighbor]) -> Self {
        Heap { slots, stored: 0 }
    }

    pub(crate) fn stored(&self) -> usize {
        self.stored
    }

    /// The squared distance of the farthest stored triangle, once the slice is full.
    pub(crate) fn farthest_sq(&self) -> Option<f32> {
        self.farthest().map(|top| top.distance_sq)
    }

    #[inline(always)]
    fn farthest(&self) -> Option<LeafTriangle> {
        if self.stored < self.slots.len() { None } else { self.slots.first().map(LeafTriangle::of) }
    }

    /// Stores a triangle. Returns the triangle that has no room, if any.
    pub(crate) fn offer(&mut self, triangle: LeafTriangle) -> Option<LeafTriangle> {
        if self.farthest().is_some_and(|top| !triangle.is_before(&top)) {
            return Some(triangle);
        }
        let held = triangle.stored();
        if self.stored < self.slots.len() {
            let at = self.stored;
            self.stored += 1;
            if let Some(slot) = self.slots.get_mut(at) {
                *slot = held;
            }
            self.rise(at);
            return None;
        }
        let Some(top) = self.slots.first_mut() else { return Some(triangle) };
        let out = LeafTriangle::of(top);
        *top = held;
        self.sink(self.stored);
        Some(out)
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

    /// Restores the heap of the first `end` slots after its top has changed.
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

    /// Sorts by rising distance and writes the answers. Returns their number.
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
        // Squares rise. Rounded roots may not.
        let mut farthest = 0f32;
        for slot in self.slots.iter_mut().take(self.stored) {
            let mut near =
                LeafTriangle::of(slot).answer(tree, query).ok_or(QueryError::Unchecked)?;
            let Interval { lower, upper } = near.distance();
            if upper < farthest {
                near = Neighbor::of(
                    Interval { lower, upper: farthest },
                    near.point(),
                    near.triangle(),
                );
            } else {
                farthest = upper;
            }
            *slot = near;
        }
        Ok(self.stored)
    }
}

/// Stores the first triangles of the blob, each with the interval of the whole model. Returns their
/// number. For points from which all triangles are alike.
pub(crate) fn first_triangles(
    tree: &Bvh<'_>,
    far: FarPoint<'_>,
    distance: Interval,
    out: &mut [Neighbor],
) -> Result<usize, QueryError> {
    let mut slots = out.iter_mut();
    let mut stored = 0;
    for node in 0..tree.header().nodes {
        let links = tree.links(node).ok_or(QueryError::Unchecked)?;
        for child in links.inner..links.count {
            let leaf = tree.leaf(node, child).ok_or(QueryError::Unchecked)?;
            let first = links.triangle(child);
            for lane in 0..leaf.shape().triangles() {
                let Some(slot) = slots.next() else { return Ok(stored) };
                let [corner, ..] = leaf.corners(lane);
                let triangle =
                    tree.source(first.wrapping_add(lane as u32)).ok_or(QueryError::Unchecked)?;
                *slot = Neighbor::of(distance, far.query.units.point(corner), triangle);
                stored += 1;
            }
        }
    }
    Ok(stored)
}
