//! The distance of a solid from the triangles of a leaf.
//!
//! Extents along six directions bound all triangles in f32. Those that are left are measured in
//! f64, the one with the least bound first.

use super::box_keys::{bounds_sq, key_limit};
use super::placed_solid::PlacedSolid;
use crate::bvh::tree::descent::{LeafVisit, LeafVisitor};
use crate::bvh::tree::format::{CORNERS, FanLeaf, slots};
use crate::bvh::tree::gap::{Gap, GapVisitor};
use crate::bvh::tree::stored_lengths::square_limit;
use crate::bvh::tree::triangle_at::TriangleAt;
use crate::geom::fan::WIDTH;
use crate::geom::{ConvexGap, convex_gap, dot, norm_1};
use crate::num::tolerance::{CONVEX_GAP, U64};
use crate::num::{greater, lesser};
use crate::query::DIRECTIONS;

/// A leaf's triangles with their squared lower bounds.
pub(super) struct LeafTriangles {
    /// Infinite for triangles that are done, or are not there.
    bounds_sq: [f32; WIDTH],
    vertices: [[f32; CORNERS]; 3],
    turn: usize,
    /// The leaf's first triangle.
    first: TriangleAt,
}

impl LeafTriangles {
    #[inline(always)]
    pub(super) fn new(placed: &PlacedSolid, visit: &LeafVisit<'_>) -> LeafTriangles {
        let leaf: &FanLeaf<'_> = &visit.leaf;
        let (vertices, turn) = (leaf.stored_vertices(), leaf.shape().turn());
        let mut triangles = LeafTriangles {
            bounds_sq: [f32::INFINITY; WIDTH],
            vertices,
            turn,
            first: visit.triangle(0),
        };
        let (mut low, mut high) = ([[0f32; WIDTH]; DIRECTIONS], [[0f32; WIDTH]; DIRECTIONS]);
        let directions = placed.directions.rows.iter().zip(placed.directions.grow);
        for ((&[a, b, c], grow), (low, high)) in directions.zip(low.iter_mut().zip(&mut high)) {
            let [x, y, z] = &vertices;
            let mut heights = [0f32; CORNERS];
            for (height, ((x, y), z)) in heights.iter_mut().zip(x.iter().zip(y).zip(z)) {
                *height = (a * x + b * y) + c * z;
            }
            for (lane, (low, high)) in low.iter_mut().zip(high).enumerate() {
                let at = |slot: usize| heights.get(slot).copied().unwrap_or(0.0);
                let [p, q, r] = slots(lane, turn).map(at);
                *low = lesser(p, lesser(q, r)) - grow;
                *high = greater(p, greater(q, r)) + grow;
            }
        }
        let bounds = bounds_sq(placed, &low, &high);
        let there = leaf.shape().triangles();
        triangles.bounds_sq.iter_mut().zip(bounds).take(there).for_each(|(slot, x)| *slot = x);
        triangles
    }

    /// Takes the triangle with the least bound out, if that is within the limit.
    #[inline(always)]
    pub(super) fn next(&mut self, limit: f64) -> Option<(TriangleAt, [[f64; 3]; 3])> {
        let mut least = (square_limit(limit), WIDTH);
        for (lane, &bound) in self.bounds_sq.iter().enumerate() {
            if bound <= least.0 && bound < f32::INFINITY {
                least = (bound, lane);
            }
        }
        let (_, lane) = least;
        *self.bounds_sq.get_mut(lane)? = f32::INFINITY;
        let [x, y, z] = &self.vertices;
        let corners = slots(lane, self.turn)
            .map(|slot| [x, y, z].map(|axis| axis.get(slot).copied().map_or(0.0, f64::from)));
        Some((self.first.with_lane(lane), corners))
    }
}

/// The search among leaves for a solid at rest.
pub(super) struct LeafSearch<'a, V> {
    placed: &'a PlacedSolid,
    /// Between the solid and the triangle that was measured last: its normal, and the height of the
    /// solid along it.
    plane: ([f64; 3], f64),
    /// Largest 1-norm of a corner of the solid.
    largest: f64,
    /// Triangles that were measured.
    pub(super) measured: u32,
    pub(super) visitor: V,
}

impl<V: GapVisitor<TriangleAt>> LeafVisitor for LeafSearch<'_, V> {
    #[inline(always)]
    fn limit(&self) -> u32 {
        key_limit(square_limit(self.visitor.limit()))
    }

    #[inline(always)]
    fn leaf(&mut self, visit: &LeafVisit<'_>) -> Option<bool> {
        let mut triangles = LeafTriangles::new(self.placed, visit);
        while let Some((place, corners)) = triangles.next(self.visitor.limit()) {
            if self.is_beyond(&corners) {
                continue;
            }
            self.measured = self.measured.saturating_add(1);
            let gap = self.measure(place, &corners);
            if !self.visitor.take(&gap) {
                return Some(false);
            }
        }
        Some(true)
    }
}

impl<'a, V: GapVisitor<TriangleAt>> LeafSearch<'a, V> {
    pub(super) fn new(placed: &'a PlacedSolid, visitor: V) -> LeafSearch<'a, V> {
        let largest = placed.corners().iter().copied().map(norm_1).fold(0.0, greater);
        LeafSearch { placed, plane: ([0.0; 3], 0.0), largest, measured: 0, visitor }
    }

    #[inline(never)]
    fn measure(&mut self, place: TriangleAt, corners: &[[f64; 3]; 3]) -> Gap<TriangleAt> {
        let gap = convex_gap(self.placed.corners(), corners);
        if gap.lower > 0.0 {
            let heights = self.placed.corners().iter().map(|&p| dot(gap.direction, p));
            self.plane = (gap.direction, heights.fold(f64::NEG_INFINITY, greater));
        }
        // So deep in the stored triangle, or so much nearer than the radius.
        let error = self.placed.lengths.error;
        let meets = gap.depth > error || gap.upper + error < self.placed.radius;
        let ConvexGap { lower, upper, points, .. } = gap;
        Gap { place, lower, upper, meets, points }
    }

    /// Whether the plane proves that a triangle is farther than the limit.
    fn is_beyond(&self, corners: &[[f64; 3]; 3]) -> bool {
        let ((normal, top), limit) = (self.plane, self.visitor.limit());
        let lowest = corners.iter().map(|&p| dot(normal, p)).fold(f64::INFINITY, lesser);
        // Heights that cancel are rounded in proportion to the corners.
        let far = self.largest + corners.iter().copied().map(norm_1).fold(0.0, greater) + limit;
        lowest - top > limit + far * (CONVEX_GAP * U64)
    }
}
