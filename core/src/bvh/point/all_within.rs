//! All triangles within a distance.

use super::leaf::bounds::limit_within;
use super::neighbors::{Heap, Neighbor, first_triangles};
use super::query::{Asked, FarPoint, PointQuery, PreparedPoint};
use super::triangle_visitor::{LeafTriangle, TriangleCollector, TriangleVisitor};
use crate::bvh::tree::descent::descend;
use crate::bvh::tree::format::{Bvh, FanLeaf};
use crate::num::sqrt_approx;
use crate::query::{AllWithin, Budget, ClosestPoint, QueryError, ScratchEntry, Work};
use glam::Vec3;

impl Bvh<'_> {
    /// All triangles of the input mesh that are, or may be, at most `distance` from `point` (both
    /// in input units), into `out`, by rising distance.
    ///
    /// Order, ties, triangles without area and far points as for [`nearest`](Bvh::nearest). With
    /// an empty `out`, [`AllWithin::dropped`] is the number of triangles. After an error the
    /// contents of `out` are undefined. `scratch` as for [`closest_point`](Bvh::closest_point). Of
    /// the budget only `steps` matters.
    ///
    /// Cost: linear in everything within the distance, dropped triangles too; log n for each
    /// triangle stored.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Bvh, Neighbor, Scratch};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/groove.msw"));
    /// let (part, mut scratch) = (Bvh::open(bytes)?, Scratch::<64>::new());
    /// let mut out = [Neighbor::EMPTY; 16];
    /// let tip = [3.0, 0.0, 4.0];
    /// let found = part.all_within(tip, 5.0, &mut out, Budget::EXACT, &mut scratch)?;
    /// assert!(out[..found.certain].iter().all(|near| near.distance().upper <= 5.0));
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`within`](Bvh::within).
    #[inline(never)]
    pub fn all_within(
        &self,
        point: [f32; 3],
        distance: f32,
        out: &mut [Neighbor],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<AllWithin, QueryError> {
        let tree = self;
        // A distance is refused as an absolute tolerance is.
        budget.with_absolute(distance).check()?;
        // In place: `?` would copy it.
        let prepared = PreparedPoint::prepare(tree, point, &budget, scratch);
        let prepared = prepared.as_ref().map_err(|&refused| refused)?;
        let query = match prepared.asked() {
            Asked::Near(query) => query,
            Asked::Far(far) => return from_afar(tree, point, far, distance, out),
        };
        let mut work = Work::default();
        let limit = limit_within(query, distance);
        let heap = Heap::new(&mut *out);
        let collector = CollectWithin { query, distance, heap, dropped: 0 };
        let mut visitor = TriangleVisitor::new(tree, query, limit, collector);
        let descent = descend(tree, query, budget.steps, scratch, &mut visitor, &mut work)?;
        let CollectWithin { heap, dropped, .. } = visitor.collector;
        let stored = heap.finish(tree, query)?;
        let is_certain = |near: &&Neighbor| near.distance().upper <= distance;
        let certain = out.iter().take(stored).take_while(is_certain).count();
        Ok(AllWithin { stored, certain, dropped, work, ended: descent.ended() })
    }
}

#[cold]
fn from_afar(
    tree: &Bvh<'_>,
    point: [f32; 3],
    far: FarPoint<'_>,
    distance: f32,
    out: &mut [Neighbor],
) -> Result<AllWithin, QueryError> {
    let ClosestPoint { distance: of_box, work, ended, .. } = far.closest_point(tree, point)?;
    if of_box.lower > distance {
        return Ok(AllWithin { stored: 0, certain: 0, dropped: 0, work, ended });
    }
    let stored = first_triangles(tree, far, of_box, out)?;
    let certain = if of_box.upper <= distance { stored } else { 0 };
    let dropped = tree.header().triangles.saturating_sub(stored as u32);
    Ok(AllWithin { stored, certain, dropped, work, ended })
}

struct CollectWithin<'a> {
    query: &'a PointQuery,
    /// Input units.
    distance: f32,
    heap: Heap<'a>,
    dropped: u32,
}

impl TriangleCollector for CollectWithin<'_> {
    #[inline(always)]
    fn take(
        &mut self,
        triangle: LeafTriangle,
        leaf: &FanLeaf<'_>,
        _: Option<&[Vec3; 3]>,
        _: &mut f32,
    ) {
        let is_within = self.query.upper(sqrt_approx(triangle.distance_sq)) <= self.distance
            || self.query.lower(triangle.lower(leaf, self.query)) <= self.distance;
        if is_within && self.heap.offer(triangle).is_some() {
            self.dropped = self.dropped.saturating_add(1);
        }
    }
}
