//! The visitor of point questions that look at triangles one by one: more than the nearest one
//! counts.

use super::leaf::bounds::{TriangleTaker, each_triangle, is_certified, lower_of};
use super::leaf::distance::nearest_within;
use super::leaf::limit::LeafLimit;
use super::leaf::nearest::LeafNearest;
#[cfg(not(meshsweep_wide))]
use super::leaf::plane::LeafPlane;
use super::leaf::squares::LeafSquares;
use super::query::PointQuery;
use crate::bvh::tree::descent::{LeafVisit, LeafVisitor};
use crate::bvh::tree::format::{Bvh, FanLeaf};
use crate::bvh::tree::triangle_at::TriangleAt;
use crate::num::tolerance::U32;
use crate::num::{Real, SOFT_FLOAT, greater};
use glam::Vec3;

/// A triangle that a descent has reached.
#[derive(Clone, Copy)]
pub(crate) struct LeafTriangle {
    pub(crate) distance_sq: f32,
    pub(crate) lower_bound_sq: f32,
    pub(crate) place: TriangleAt,
}

impl LeafTriangle {
    /// No triangle: farther than all others.
    pub(crate) const NONE: LeafTriangle = LeafTriangle {
        distance_sq: f32::INFINITY,
        lower_bound_sq: f32::INFINITY,
        place: TriangleAt::NONE,
    };

    /// Whether it comes before another one: nearer, or as near with a lesser number.
    #[inline(always)]
    pub(crate) fn is_before(&self, other: &LeafTriangle) -> bool {
        let (here, there) = (Real(self.distance_sq), Real(other.distance_sq));
        here < there || here == there && self.place < other.place
    }

    /// Whether the lower bound of the distance needs no further bound.
    #[inline(always)]
    pub(crate) fn is_certified(&self) -> bool {
        is_certified(self.distance_sq, self.lower_bound_sq)
    }

    /// Lower bound of the triangle's distance, grid units. `leaf` is the triangle's.
    #[inline]
    pub(crate) fn lower(&self, leaf: &FanLeaf<'_>, query: &PointQuery) -> f32 {
        lower_of(leaf, self.place.lane(), query.p, self.distance_sq, self.lower_bound_sq)
    }
}

/// How to go on after the nearest triangle of a leaf.
pub(crate) enum Next {
    /// Look at every triangle of the leaf within the limit.
    Triangles,
    /// The other triangles of the leaf cannot change the answer.
    Leaf,
    /// The question is answered.
    Nothing,
}

/// Takes the triangles of a question one by one, in any order.
pub(crate) trait TriangleCollector {
    /// Takes a triangle whose squared lower bound is not beyond `limit`. May lower the limit. For
    /// `seen` see [`seen_from`](super::leaf::bounds::seen_from).
    fn take(
        &mut self,
        triangle: LeafTriangle,
        leaf: &FanLeaf<'_>,
        seen: Option<&[Vec3; 3]>,
        limit: &mut f32,
    );

    /// See [`TriangleTaker::told_side`].
    #[cfg(not(meshsweep_wide))]
    #[inline(always)]
    fn told_side(&self, _: &FanLeaf<'_>, _lane: usize) -> Option<bool> {
        None
    }

    /// Looks at a leaf as a whole, before [`take`](Self::take). May lower the limit. `None` says
    /// that the tree is unchecked.
    #[inline(always)]
    fn nearest(
        &mut self,
        _: &LeafVisit<'_>,
        (_, _): (&LeafNearest, &LeafSquares),
        _limit: &mut f32,
    ) -> Option<Next> {
        Some(Next::Triangles)
    }

    /// See [`LeafLimit::allowance`].
    #[inline(always)]
    fn allowance(&self) -> f32 {
        f32::INFINITY
    }

    /// Whether the question is answered.
    #[inline(always)]
    fn is_answered(&self) -> bool {
        false
    }
}

/// The visitor. It skips a leaf at once if its nearest triangle is beyond the limit.
pub(crate) struct TriangleVisitor<'a, C> {
    tree: &'a Bvh<'a>,
    query: &'a PointQuery,
    /// Squared bound above which no triangle can change the answer.
    limit: f32,
    /// [`PointQuery::key_limit`] of `limit`.
    key_limit: u32,
    /// `limit` for the leaves.
    beyond: LeafLimit,
    known: LeafSquares,
    pub(crate) collector: C,
}

impl<'a, C> TriangleVisitor<'a, C> {
    /// Whether a squared lower bound is beyond the limit.
    #[inline(always)]
    pub(crate) fn is_beyond(&self, lower_bound_sq: f32) -> bool {
        Real(lower_bound_sq) > Real(self.limit)
    }

    /// A visitor that begins with this squared limit.
    pub(crate) fn new(tree: &'a Bvh<'a>, query: &'a PointQuery, limit: f32, collector: C) -> Self {
        let (mut key_limit, mut beyond) = (0, LeafLimit::NONE);
        follow(query, limit, &mut key_limit, &mut beyond);
        let known = LeafSquares::NONE;
        TriangleVisitor { tree, query, limit, key_limit, beyond, known, collector }
    }

    /// Whether the model's box is beyond the limit, and so are all triangles.
    #[inline(always)]
    pub(crate) fn is_box_beyond(&self) -> bool {
        let (low, high) = self.tree.grid_bounds();
        let (below, above) = (low - self.query.p, self.query.p - high);
        let gap = |below: f32, above: f32| greater(greater(below, above), 0.0);
        let (x, y, z) = (gap(below.x, above.x), gap(below.y, above.y), gap(below.z, above.z));
        (x * x + y * y + z * z) * (1.0 - 16.0 * U32) > self.beyond.distance_sq
    }

    /// Makes the other limits follow `limit`.
    #[cfg_attr(meshsweep_small, inline(always))]
    #[cfg_attr(not(meshsweep_small), inline(never))]
    fn lower_limits(&mut self) {
        follow(self.query, self.limit, &mut self.key_limit, &mut self.beyond);
    }
}

/// Makes the limits of nodes and of leaves follow a squared limit. Where code is to be small all
/// visitors share it.
#[cfg_attr(meshsweep_small, inline(never))]
#[cfg_attr(not(meshsweep_small), inline(always))]
pub(crate) fn follow(query: &PointQuery, limit: f32, key_limit: &mut u32, beyond: &mut LeafLimit) {
    *key_limit = query.key_limit(limit);
    (beyond.distance_sq, beyond.low_sq) = (query.limit(limit), limit);
}

impl<C: TriangleCollector> LeafVisitor for TriangleVisitor<'_, C> {
    #[inline(always)]
    fn limit(&self) -> u32 {
        self.key_limit
    }

    #[inline(always)]
    fn leaf(&mut self, visit: &LeafVisit<'_>) -> Option<bool> {
        self.beyond.allowance = self.collector.allowance();
        let near = nearest_within(&visit.leaf, self.query, &self.beyond, Some(&mut self.known))?;
        let before = self.limit;
        let next = self.collector.nearest(visit, (&near, &self.known), &mut self.limit)?;
        if Real(self.limit) < Real(before) {
            self.lower_limits();
            // A plane in front of the nearest triangle.
            #[cfg(not(meshsweep_wide))]
            {
                let (residual, limit) = (near.lanes.residual(), self.beyond.distance_sq);
                self.beyond.plane =
                    LeafPlane::across(self.query, residual, near.distance_sq, limit);
            }
        }
        match next {
            Next::Triangles if Real(near.lower_bound_sq) <= Real(self.limit) => {
                self.each(visit, near.low)
            }
            Next::Triangles | Next::Leaf => Some(true),
            Next::Nothing => Some(false),
        }
    }
}

impl<C: TriangleCollector> TriangleVisitor<'_, C> {
    /// Hands triangles of a leaf to the collector that the descent has reached before: those whose
    /// bits in `low` are ones. `known`: their squares, if they were kept.
    #[inline(always)]
    pub(crate) fn visit_again(
        &mut self,
        first: TriangleAt,
        low: u32,
        known: Option<LeafSquares>,
    ) -> Option<()> {
        let (node, child) = (first.node(), first.child());
        let visit = LeafVisit { leaf: first.leaf(self.tree)?, key: 0, node, child };
        if let Some(known) = known {
            self.known = known;
        } else if SOFT_FLOAT {
            // Integers leave out most triangles once more.
            let known = Some(&mut self.known);
            let near = nearest_within(&visit.leaf, self.query, &self.beyond, known)?;
            return self.each(&visit, near.low).map(drop);
        }
        self.each(&visit, low).map(drop)
    }

    /// Hands the triangles of a leaf to the collector. Returns whether to go on.
    #[inline(never)]
    fn each(&mut self, visit: &LeafVisit<'_>, low: u32) -> Option<bool> {
        let TriangleVisitor { query, limit, known, collector, beyond, .. } = self;
        let before = *limit;
        let leaf = &visit.leaf;
        each_triangle(query, leaf, beyond, (low, known), Taker { visit, collector, limit });
        if Real(self.limit) < Real(before) {
            self.lower_limits();
        }
        Some(!self.collector.is_answered())
    }
}

/// Hands triangles of a leaf to a collector.
struct Taker<'a, 'v, C> {
    visit: &'a LeafVisit<'v>,
    collector: &'a mut C,
    limit: &'a mut f32,
}

impl<C: TriangleCollector> TriangleTaker for Taker<'_, '_, C> {
    #[inline]
    fn triangle(
        &mut self,
        lane: usize,
        seen: Option<&[Vec3; 3]>,
        [distance_sq, lower_bound_sq]: [f32; 2],
    ) {
        if Real(lower_bound_sq) > Real(*self.limit) {
            return;
        }
        let place = self.visit.triangle(lane);
        let here = LeafTriangle { distance_sq, lower_bound_sq, place };
        self.collector.take(here, &self.visit.leaf, seen, self.limit);
    }

    #[cfg(not(meshsweep_wide))]
    #[inline(always)]
    fn told_side(&self, lane: usize) -> Option<bool> {
        self.collector.told_side(&self.visit.leaf, lane)
    }
}
