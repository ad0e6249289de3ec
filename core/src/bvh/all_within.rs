//! All triangles within a distance.

use super::closest_point::closest_point;
use super::descent::{Descent, LeafVisit, LeafVisitor, descend};
use super::k_nearest::{Candidate, KNearest, Neighbor, first_triangles};
use super::leaf_distance::nearest_triangle;
use super::point_query::PointQuery;
use super::triangle_bounds::{each_triangle, limit_within, lower_of};
use crate::bvh::format::Bvh;
use crate::num::sqrt_approx;
use crate::query::{Budget, Ended, QueryError, ScratchEntry, Work};

/// How a search for all triangles within a distance went; they are in the caller's slice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AllWithin {
    /// Triangles in the slice.
    pub stored: usize,
    /// The first so many are certainly within the distance (`upper ≤ distance`); of the others the
    /// stored surface and rounding leave it open (`lower ≤ distance < upper`).
    pub certain: usize,
    /// Triangles, certain or not, that did not fit; those kept are the closest.
    pub dropped: u32,
    /// What it cost.
    pub work: Work,
    /// [`Ended::Exact`]: every triangle that is neither stored nor counted as dropped is certainly farther. Else some may be missing.
    pub ended: Ended,
}

/// All triangles of the input mesh that are, or may be, at most `distance` (input units) from
/// `point`, into `out`, by rising distance.
///
/// Order, ties, triangles without area and far points as for [`nearest`](super::nearest). An empty
/// `out` counts. `stack` as for [`closest_point`]; of [`Budget`] only `steps` matters.
///
/// Cost: linear in what lies within the distance, also in what is dropped; log n for each triangle
/// stored. After an error what `out` holds is undefined.
///
/// # Errors
/// Those of [`is_within`](super::is_within).
pub fn all_within(
    tree: &Bvh<'_>,
    point: [f32; 3],
    distance: f32,
    stop: &Budget,
    out: &mut [Neighbor],
    stack: &mut [ScratchEntry],
) -> Result<AllWithin, QueryError> {
    stop.check()?;
    if !(distance >= 0.0 && distance.is_finite()) {
        return Err(QueryError::Tolerance);
    }
    if stack.is_empty() {
        return Err(QueryError::NoQueue);
    }
    let query = PointQuery::new(tree, point)?;
    if query.far {
        return from_afar(tree, &query, point, distance, out, stack);
    }
    let mut work = Work::default();
    let limit = limit_within(&query, distance);
    let k_nearest = KNearest::new(&mut *out);
    let mut visitor = Collect { tree, query: &query, distance, limit, k_nearest, dropped: 0 };
    let descent = descend(tree, query.p, stack, stop.steps, &mut visitor, &mut work)?;
    let ended = match descent {
        Descent::Truncated { steps: true, .. } => Ended::Steps,
        Descent::Truncated { steps: false, .. } => Ended::Capacity,
        _ => Ended::Exact,
    };
    let dropped = visitor.dropped;
    let stored = visitor.k_nearest.finish(tree, &query)?;
    let certain = out.iter().take(stored).take_while(|near| near.upper <= distance).count();
    Ok(AllWithin { stored, certain, dropped, work, ended })
}

#[cold]
fn from_afar(
    tree: &Bvh<'_>,
    query: &PointQuery,
    point: [f32; 3],
    distance: f32,
    out: &mut [Neighbor],
    stack: &mut [ScratchEntry],
) -> Result<AllWithin, QueryError> {
    let closest = closest_point(tree, point, &Budget::EXACT, stack)?;
    let none =
        AllWithin { stored: 0, certain: 0, dropped: 0, work: closest.work, ended: Ended::Exact };
    if closest.lower > distance {
        return Ok(none);
    }
    let stored = first_triangles(tree, query, closest.lower, closest.upper, out)?;
    let certain = if closest.upper <= distance { stored } else { 0 };
    let dropped = tree.header().triangles.saturating_sub(stored as u32);
    Ok(AllWithin { stored, certain, dropped, ..none })
}

struct Collect<'a> {
    tree: &'a Bvh<'a>,
    query: &'a PointQuery,
    /// Input units.
    distance: f32,
    limit: f32,
    k_nearest: KNearest<'a>,
    dropped: u32,
}

impl LeafVisitor for Collect<'_> {
    #[inline(always)]
    fn limit(&self) -> f32 {
        self.limit
    }

    #[inline(always)]
    fn leaf(&mut self, visit: &LeafVisit<'_>) -> Option<bool> {
        let near = nearest_triangle(&visit.leaf, self.query.p)?;
        if near.lower_bound_sq <= self.limit {
            self.collect(visit)?;
        }
        Some(true)
    }
}

impl Collect<'_> {
    #[inline(never)]
    fn collect(&mut self, visit: &LeafVisit<'_>) -> Option<()> {
        let first = self.tree.links(visit.node)?.triangle(visit.lane);
        each_triangle(self.query, &visit.leaf, |lane, distance_sq, lower_bound_sq| {
            if lower_bound_sq > self.limit {
                return;
            }
            let lower = || lower_of(&visit.leaf, lane, self.query.p, distance_sq, lower_bound_sq);
            let within = self.query.upper(sqrt_approx(distance_sq)) <= self.distance
                || self.query.lower(lower()) <= self.distance;
            if within
                && self
                    .k_nearest
                    .offer(Candidate::new(visit, first, lane, distance_sq, lower_bound_sq))
                    .is_some()
            {
                self.dropped = self.dropped.saturating_add(1);
            }
        });
        Some(())
    }
}
