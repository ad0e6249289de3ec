//! The closest point in f64. Rounding in f32 leaves few triangles, mostly one or two, that may be
//! the closest. A second descent measures these again.

use super::hint::Hint;
use super::leaf::bounds::limit_of;
use super::query::{Asked, PointQuery, PreparedPoint};
use super::triangle_visitor::{LeafTriangle, TriangleCollector, TriangleVisitor};
use crate::bvh::tree::descent::descend;
use crate::bvh::tree::format::{Bvh, FanLeaf};
use crate::bvh::tree::stored_lengths::StoredLengths;
use crate::bvh::tree::triangle_at::TriangleAt;
use crate::geom::{convex_gap, point_triangle};
use crate::num::tolerance::{FAN_RELATIVE, U32};
use crate::num::{greater, lesser};
use crate::query::{Budget, ClosestPoint, Ended, Interval, QueryError, ScratchEntry};
use glam::{DVec3, Vec3};

impl Bvh<'_> {
    /// [`closest_point`](Bvh::closest_point) with an interval about one f32 rounding wider at each
    /// end than the surface error. That is 0 in a tree of f32 coordinates with `--vertex-bits 32`.
    ///
    /// Triangles that rounding in f32 cannot tell from the closest one are measured in f64. What is
    /// left of the width is the surface error, a rounding of f32 at each end, some 1e-14 of the
    /// triangle's size and of its distance from the point, and on a sliver this times its aspect.
    /// With vertices on a grid the surface error hides the gain.
    ///
    /// `scratch`, far points and units as for [`closest_point`](Bvh::closest_point). Of the budget
    /// only `steps` matters. If they or the scratch run out, the answer is that of f32. If several
    /// triangles have the least upper end in f64, the answer is the first in the blob.
    /// [`exact`](crate::Work::exact) of the work counts triangles measured in f64.
    ///
    /// Cost: the closest point's, most of it again, and a kernel in f64 for each triangle that may
    /// be the closest. At the centre of a sphere that is every triangle.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Bvh, Scratch};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/groove.msw"));
    /// let (part, mut scratch) = (Bvh::open(bytes)?, Scratch::<64>::new());
    /// let tip = [3.0, 0.0, 4.0];
    /// let near = part.closest_point(tip, Budget::EXACT, &mut scratch)?;
    /// let precise = part.closest_point_precise(tip, Budget::EXACT, &mut scratch)?;
    /// assert!(precise.distance.lower >= near.distance.lower);
    /// assert!(precise.distance.upper <= near.distance.upper);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`closest_point`](Bvh::closest_point).
    #[inline(never)]
    pub fn closest_point_precise(
        &self,
        point: [f32; 3],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<ClosestPoint, QueryError> {
        let tree = self;
        // In place: `?` would copy it.
        let prepared = PreparedPoint::prepare(tree, point, &budget, scratch);
        let prepared = prepared.as_ref().map_err(|&refused| refused)?;
        let query = match prepared.asked() {
            Asked::Near(query) => query,
            Asked::Far(far) => return far.closest_point(tree, point),
        };
        let of_f32 = Budget::EXACT.with_steps(budget.steps);
        // In one order, if there is a limit of steps: those that are left may end the second
        // descent.
        let near = tree.closest_point_in_order(point, &mut Hint::NONE.clone(), of_f32, scratch)?;
        if near.ended != Ended::Exact {
            return Ok(near);
        }
        let lengths = StoredLengths::of(tree);
        let rounding = query.rounding;
        let farthest = query.units.inward(near.distance.upper);
        let stored = farthest - query.units.surface_error + farthest * (4.0 * U32);
        let candidates = Candidates {
            query,
            place: DVec3::from_array(point.map(|x| lengths.inward(x))),
            // Proof: `core/docs/rounding.md` §8, In f64.
            band: stored * (1.0 + 64.0 * U32) + 4.0 * rounding,
            best: None,
            lower: f64::INFINITY,
            measured: 0,
        };
        let limit = limit_of(query, candidates.band);
        let mut visitor = TriangleVisitor::new(tree, query, limit, candidates);
        let mut work = near.work;
        let descent = descend(tree, query, budget.steps, scratch, &mut visitor, &mut work)?;
        let Candidates { best, lower, measured, .. } = visitor.collector;
        work.exact = measured;
        match best {
            Some((best, place)) if descent.ended() == Ended::Exact => {
                let Interval { lower, upper } = lengths.interval(lower, best.upper);
                let (lower, upper) =
                    (greater(near.distance.lower, lower), lesser(near.distance.upper, upper));
                Ok(ClosestPoint {
                    distance: Interval { lower, upper },
                    point: query.units.point(best.point.as_vec3()),
                    triangle: place.source(tree),
                    work,
                    ended: Ended::Exact,
                })
            }
            _ => Ok(ClosestPoint { work, ended: descent.ended(), ..near }),
        }
    }
}

/// A triangle measured in f64, grid units.
#[derive(Clone, Copy)]
struct Measured {
    lower: f64,
    upper: f64,
    /// On the triangle.
    point: DVec3,
}

impl Measured {
    /// The kernel's interval. On a sliver, and next to the surface, it may be wider than f32 can
    /// tell. Then [`convex_gap`] narrows it.
    #[inline(never)]
    fn new(place: DVec3, corners: [Vec3; 3]) -> Measured {
        let [a, b, c] = corners.map(|corner| corner.as_dvec3());
        let near = point_triangle(place, a, b, c);
        let point = a + (b - a) * near.u + (c - a) * near.v;
        let measured = Measured { lower: near.lower, upper: near.upper, point };
        if near.upper - near.lower <= near.upper * f64::from(U32) {
            return measured;
        }
        let gap = convex_gap(&[place.to_array()], &[a, b, c].map(|corner| corner.to_array()));
        let lower = greater(near.lower, gap.lower);
        if gap.upper < near.upper {
            let [_, point] = gap.points.map(DVec3::from_array);
            return Measured { lower, upper: gap.upper, point };
        }
        Measured { lower, ..measured }
    }
}

/// The triangles that may be the closest, measured.
struct Candidates<'a> {
    query: &'a PointQuery,
    /// The query's point, grid units, exactly.
    place: DVec3,
    /// Triangles with a greater lower bound in f32 are farther than the closest, grid units.
    band: f32,
    /// The one with the least upper end, and its place.
    best: Option<(Measured, TriangleAt)>,
    /// The least lower bound, grid units.
    lower: f64,
    measured: u32,
}

impl TriangleCollector for Candidates<'_> {
    fn take(
        &mut self,
        triangle: LeafTriangle,
        leaf: &FanLeaf<'_>,
        _: Option<&[Vec3; 3]>,
        _: &mut f32,
    ) {
        let lower = triangle.lower(leaf, self.query);
        if lower > self.band {
            return;
        }
        let near = Measured::new(self.place, leaf.corners(triangle.place.lane()));
        self.measured = self.measured.saturating_add(1);
        // On slivers the bound of f32 may be the better one.
        let relative = 1.0 - f64::from(FAN_RELATIVE * U32);
        let in_f32 = f64::from(lower) * relative - f64::from(self.query.rounding);
        self.lower = lesser(self.lower, greater(near.lower, in_f32));
        let place = triangle.place;
        let is_nearer = self.best.is_none_or(|(best, first)| {
            near.upper < best.upper || near.upper == best.upper && place < first
        });
        if is_nearer {
            self.best = Some((near, place));
        }
    }
}
