//! The n closest triangles.

use super::closest_point::closest_point;
use super::descent::{Descent, LeafVisit, LeafVisitor, descend};
use super::k_nearest::{Candidate, KNearest, Neighbor, first_triangles};
use super::leaf_distance::nearest_triangle;
use super::point_query::PointQuery;
use super::triangle_bounds::{each_triangle, lower_of_box};
use crate::bvh::format::Bvh;
use crate::num::sqrt_approx;
use crate::num::tolerance::EVERYTHING_SQ;
use crate::query::{Budget, Ended, QueryError, ScratchEntry, Work};

/// How a search for the closest triangles went; they are in the caller's slice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// Triangles in the slice.
    pub stored: usize,
    /// No other triangle of the input mesh is nearer than this, input units; infinite if there is
    /// no other.
    pub rest_lower: f32,
    /// What it cost.
    pub work: Work,
    /// [`Ended::Exact`] if every leaf that matters was looked at. Else those stored may not be the
    /// closest; `rest_lower` still holds.
    pub ended: Ended,
}

/// The `out.len()` triangles closest to `point` (input units), by rising distance, into `out`.
///
/// Distances are compared as computed; those that are equal go by number in the blob. So two that
/// f32 or the stored surface cannot tell apart may stand in either order, always the same: each has
/// its own interval. Triangles without area count like others. If `out` is longer than the mesh,
/// all triangles are stored; if it is empty, nothing is looked at. Farther than a million model
/// sizes all triangles are alike: the first of the blob, each with the interval of the model's box.
/// `stack` as for [`closest_point`]; of [`Budget`] only `steps` matters.
///
/// Cost: for few triangles that of the closest point and a scalar kernel for each leaf near the
/// end; a heap in `out`, log n for each that enters. After an error what `out` holds is undefined.
///
/// # Errors
/// [`QueryError::NotFinite`], [`QueryError::Tolerance`], [`QueryError::NoQueue`],
/// [`QueryError::NotServed`].
pub fn nearest(
    tree: &Bvh<'_>,
    point: [f32; 3],
    stop: &Budget,
    out: &mut [Neighbor],
    stack: &mut [ScratchEntry],
) -> Result<Nearest, QueryError> {
    stop.check()?;
    if stack.is_empty() {
        return Err(QueryError::NoQueue);
    }
    let query = PointQuery::new(tree, point)?;
    let mut work = Work::default();
    if out.is_empty() {
        return Ok(Nearest { stored: 0, rest_lower: 0.0, work, ended: Ended::Exact });
    }
    let all = tree.header().triangles as usize;
    if query.far {
        let box_of_all = closest_point(tree, point, &Budget::EXACT, stack)?;
        let stored = first_triangles(tree, &query, box_of_all.lower, box_of_all.upper, out)?;
        let rest_lower = if stored == all { f32::INFINITY } else { box_of_all.lower };
        return Ok(Nearest { stored, rest_lower, work, ended: Ended::Exact });
    }
    let k_nearest = KNearest::new(out);
    let mut visitor =
        Closest { tree, query: &query, k_nearest, limit: EVERYTHING_SQ, rest: f32::INFINITY };
    let descent = descend(tree, query.p, stack, stop.steps, &mut visitor, &mut work)?;
    let mut rest_lower = f32::INFINITY;
    if visitor.k_nearest.stored() < all {
        // What was not looked at is farther than the last one stored.
        let last = visitor.k_nearest.farthest_sq().map_or(f32::INFINITY, sqrt_approx);
        let rest = if last < visitor.rest { last } else { visitor.rest };
        rest_lower = query.lower(rest);
    }
    let mut ended = Ended::Exact;
    if let Descent::Truncated { least, steps } = descent {
        ended = if steps { Ended::Steps } else { Ended::Capacity };
        let missed = lower_of_box(&query, least);
        rest_lower = if missed < rest_lower { missed } else { rest_lower };
    }
    let stored = visitor.k_nearest.finish(tree, &query)?;
    Ok(Nearest { stored, rest_lower, work, ended })
}

struct Closest<'a> {
    tree: &'a Bvh<'a>,
    query: &'a PointQuery,
    k_nearest: KNearest<'a>,
    limit: f32,
    /// What every triangle that was looked at and is not stored is not nearer than, grid units.
    rest: f32,
}

impl LeafVisitor for Closest<'_> {
    #[inline(always)]
    fn limit(&self) -> f32 {
        self.limit
    }

    #[inline(always)]
    fn leaf(&mut self, visit: &LeafVisit<'_>) -> Option<bool> {
        let near = nearest_triangle(&visit.leaf, self.query.p)?;
        if near.lower_bound_sq <= self.limit {
            self.rank(visit)?;
        }
        Some(true)
    }
}

impl Closest<'_> {
    #[inline(never)]
    fn rank(&mut self, visit: &LeafVisit<'_>) -> Option<()> {
        let first = self.tree.links(visit.node)?.triangle(visit.lane);
        each_triangle(self.query, &visit.leaf, |lane, distance_sq, lower_bound_sq| {
            if lower_bound_sq > self.limit {
                return;
            }
            let candidate = Candidate::new(visit, first, lane, distance_sq, lower_bound_sq);
            if let Some(out) = self.k_nearest.offer(candidate) {
                let lower = out.lower(self.tree, self.query).unwrap_or(0.0);
                if lower < self.rest {
                    self.rest = lower;
                }
            }
            if let Some(farthest_sq) = self.k_nearest.farthest_sq() {
                let limit = self.query.limit(farthest_sq);
                self.limit = if limit < self.limit { limit } else { self.limit };
            }
        });
        Some(())
    }
}
