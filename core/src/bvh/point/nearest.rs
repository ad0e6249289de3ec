//! The nearest triangles.

use super::leaf::bounds::lower_of_box;
use super::neighbors::{Heap, Neighbor, first_triangles};
use super::query::{Asked, PointQuery, PreparedPoint};
use super::triangle_visitor::{LeafTriangle, TriangleCollector, TriangleVisitor};
use crate::bvh::tree::descent::{Descent, descend};
use crate::bvh::tree::format::{Bvh, FanLeaf};
use crate::num::tolerance::EVERYTHING_SQ;
use crate::num::{lesser, sqrt_approx};
use crate::query::{Budget, Ended, KNearest, QueryError, ScratchEntry, Work};
use glam::Vec3;

impl Bvh<'_> {
    /// The `out.len()` triangles nearest to `point` (input units), by rising distance, into `out`.
    ///
    /// The order is that of the computed distances, then that of the numbers in the blob. It is the
    /// same in every run. Computed distances carry rounding and the surface error. So of two
    /// triangles whose intervals overlap, the farther one may come first. Triangles without area
    /// count like others.
    ///
    /// If `out` is longer than the mesh, all triangles are stored. If it is empty, nothing is
    /// looked at. After an error its contents are undefined. `scratch` as for
    /// [`closest_point`](Bvh::closest_point). Of the budget only `steps` matters. Farther than a
    /// million model sizes all triangles are alike: the first of the blob, each with the interval
    /// of the model's box.
    ///
    /// Cost: for few triangles that of the closest point, and a scalar kernel for each leaf near
    /// the end. `out` is a heap: log n for each triangle that enters.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Bvh, Neighbor, Scratch};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/groove.msw"));
    /// let (part, mut scratch) = (Bvh::open(bytes)?, Scratch::<64>::new());
    /// let mut out = [Neighbor::EMPTY; 4];
    /// let found = part.nearest([3.0, 0.0, 4.0], &mut out, Budget::EXACT, &mut scratch)?;
    /// assert_eq!(found.stored, 4);
    /// assert!(out[0].distance().upper <= out[3].distance().upper);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`QueryError::NotFinite`], [`QueryError::Tolerance`], [`QueryError::NoScratch`],
    /// [`QueryError::NotServed`].
    #[inline(never)]
    pub fn nearest(
        &self,
        point: [f32; 3],
        out: &mut [Neighbor],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<KNearest, QueryError> {
        let tree = self;
        // In place: `?` would copy it.
        let prepared = PreparedPoint::prepare(tree, point, &budget, scratch);
        let prepared = prepared.as_ref().map_err(|&refused| refused)?;
        let mut work = Work::default();
        if out.is_empty() {
            return Ok(KNearest { stored: 0, rest_lower: 0.0, work, ended: Ended::Exact });
        }
        let all = tree.header().triangles as usize;
        let query = match prepared.asked() {
            Asked::Near(query) => query,
            Asked::Far(far) => {
                let of_box = far.closest_point(tree, point)?.distance;
                let stored = first_triangles(tree, far, of_box, out)?;
                let rest_lower = if stored == all { f32::INFINITY } else { of_box.lower };
                return Ok(KNearest { stored, rest_lower, work, ended: Ended::Exact });
            }
        };
        let heap = Heap::new(out);
        let (rest, rest_sq) = (f32::INFINITY, f32::INFINITY);
        let collector = CollectNearest { tree, query, heap, rest, rest_sq };
        let mut visitor = TriangleVisitor::new(tree, query, EVERYTHING_SQ, collector);
        let descent = descend(tree, query, budget.steps, scratch, &mut visitor, &mut work)?;
        let CollectNearest { heap, mut rest, rest_sq, .. } = visitor.collector;
        let mut rest_lower = f32::INFINITY;
        if heap.stored() < all {
            // All triangles that were not visited are farther than the last one stored.
            let last = heap.farthest_sq().map_or(f32::INFINITY, sqrt_approx);
            if rest_sq < f32::INFINITY {
                rest = lesser(rest, sqrt_approx(rest_sq));
            }
            let rest = lesser(rest, last);
            rest_lower = query.lower(rest);
        }
        if let Descent::Truncated { least, .. } = descent {
            let missed = lower_of_box(query, least);
            rest_lower = lesser(rest_lower, missed);
        }
        let stored = heap.finish(tree, query)?;
        Ok(KNearest { stored, rest_lower, work, ended: descent.ended() })
    }
}

struct CollectNearest<'a> {
    tree: &'a Bvh<'a>,
    query: &'a PointQuery,
    heap: Heap<'a>,
    /// Least squared lower bound of the visited triangles that are not stored and need no further
    /// bound.
    rest_sq: f32,
    /// Least lower bound of the other visited triangles that are not stored, grid units.
    rest: f32,
}

impl TriangleCollector for CollectNearest<'_> {
    #[inline(always)]
    fn take(
        &mut self,
        triangle: LeafTriangle,
        _: &FanLeaf<'_>,
        _: Option<&[Vec3; 3]>,
        limit: &mut f32,
    ) {
        // Roots rise with their squares: the least square has the least root.
        if let Some(out) = self.heap.offer(triangle) {
            if out.is_certified() {
                self.rest_sq = lesser(self.rest_sq, out.lower_bound_sq);
            } else {
                let lower = out.place.leaf(self.tree);
                let lower = lower.map_or(0.0, |leaf| out.lower(&leaf, self.query));
                self.rest = lesser(self.rest, lower);
            }
            if out.place == triangle.place {
                return;
            }
        }
        if let Some(farthest_sq) = self.heap.farthest_sq() {
            let lower = self.query.limit(farthest_sq);
            *limit = lesser(*limit, lower);
        }
    }
}
