//! The search of a closest point, whatever the order of its leaves: the best triangle, the limit
//! that it gives, slivers, and the answer.

#[cfg(not(meshsweep_wide))]
use super::waiting::Waiting;
use crate::bvh::point::hint::Hint;
use crate::bvh::point::leaf::bounds::{limit_within, nearness, seen_from, sliver};
use crate::bvh::point::leaf::distance::nearest_triangle;
use crate::bvh::point::leaf::limit::LeafLimit;
use crate::bvh::point::leaf::nearest::{Lanes, LeafNearest};
#[cfg(not(meshsweep_wide))]
use crate::bvh::point::leaf::plane::LeafPlane;
use crate::bvh::point::query::{EVERY_KEY, FarPoint, PointQuery};
use crate::bvh::tree::descent::{Descent, LeafVisit, LeafVisitor};
use crate::bvh::tree::format::{Bvh, FanLeaf, lanes_of};
#[cfg(meshsweep_wide)]
use crate::bvh::tree::prefetch::prefetch_source;
use crate::bvh::tree::triangle_at::TriangleAt;
use crate::geom::fan::{lower_bound_up_to, refined};
#[cfg(not(meshsweep_wide))]
use crate::num::SOFT_FLOAT;
use crate::num::tolerance::{EVERYTHING_SQ, U32};
use crate::num::{Real, greater, lesser, sqrt_approx};
use crate::query::{Budget, ClosestPoint, Ended, Interval, QueryError, Work};

/// The nearest triangle so far: its leaf, and `lanes` that find it there.
#[derive(Clone, Copy)]
pub(crate) struct Best {
    pub(crate) distance_sq: f32,
    pub(crate) node: u32,
    pub(crate) child: u32,
    pub(crate) lanes: Lanes,
}

/// The nearest triangle of a leaf. Triangles that are proved to be beyond the limit may be left
/// out.
pub(crate) trait NearestOfLeaf:
    Fn(&FanLeaf<'_>, &PointQuery, &LeafLimit) -> Option<LeafNearest>
{
}

impl<F: Fn(&FanLeaf<'_>, &PointQuery, &LeafLimit) -> Option<LeafNearest>> NearestOfLeaf for F {}

/// A place for the attribute of a closure.
#[inline(always)]
pub(crate) fn inlined<N: NearestOfLeaf>(nearest: N) -> N {
    nearest
}

pub(crate) struct Closest<'a, N> {
    pub(crate) nearest: N,
    pub(crate) tree: &'a Bvh<'a>,
    /// The query's point, input units.
    pub(crate) point: [f32; 3],
    pub(crate) query: &'a PointQuery,
    pub(crate) budget: &'a Budget,
    /// Key above which no triangle is nearer by more than the tolerance.
    pub(crate) limit: u32,
    /// Above its squared distance no triangle is nearer: `limit` without a tolerance.
    pub(crate) beyond: LeafLimit,
    pub(crate) best: Best,
    /// A triangle whose squared lower bound is below this is refined as a sliver.
    pub(crate) refine_below: f32,
    /// Least squared lower bound of the refined triangles.
    pub(crate) refined_lower_sq: f32,
    pub(crate) tolerant: bool,
    /// Lower end of an interval of the distance that was known before the search, input units. A
    /// tolerance that reaches it is met.
    pub(crate) known_lower: f32,
    /// No hint. Behind a neighbour the cache has the triangle's number in the file.
    #[cfg(meshsweep_wide)]
    pub(crate) is_alone: bool,
    /// The limit's plane is not that of the best triangle. It is made when a leaf needs it.
    #[cfg(not(meshsweep_wide))]
    pub(crate) has_old_plane: bool,
    /// Whether triangles wait for the f32 kernel: without floating point, if nothing may end the
    /// search early. Its limits then are others than on other targets.
    #[cfg(not(meshsweep_wide))]
    pub(crate) waits: bool,
    #[cfg(not(meshsweep_wide))]
    pub(crate) waiting: Waiting,
}

impl<'a, N: NearestOfLeaf> Closest<'a, N> {
    #[inline(always)]
    pub(crate) fn new(
        tree: &'a Bvh<'a>,
        point: [f32; 3],
        query: &'a PointQuery,
        budget: &'a Budget,
        nearest: N,
    ) -> Self {
        Closest {
            nearest,
            tree,
            point,
            query,
            budget,
            limit: EVERY_KEY,
            beyond: LeafLimit {
                distance_sq: EVERYTHING_SQ,
                allowance: query.allowance,
                low_sq: EVERYTHING_SQ,
                ..LeafLimit::NONE
            },
            best: Best { distance_sq: f32::MAX, node: u32::MAX, child: 0, lanes: Lanes::NONE },
            refine_below: f32::NEG_INFINITY,
            refined_lower_sq: f32::INFINITY,
            tolerant: !is_exact(budget),
            known_lower: 0.0,
            #[cfg(meshsweep_wide)]
            is_alone: true,
            #[cfg(not(meshsweep_wide))]
            has_old_plane: false,
            #[cfg(not(meshsweep_wide))]
            waits: false,
            #[cfg(not(meshsweep_wide))]
            waiting: Waiting::none(),
        }
    }

    /// Lowers the limit by a leaf that the descent reaches again.
    #[inline(always)]
    pub(crate) fn bound_by_leaf(&mut self, leaf: &FanLeaf<'_>) -> Option<()> {
        #[cfg(not(meshsweep_wide))]
        if SOFT_FLOAT
            && self.waits
            && !leaf.is_f32()
            && let Some(point) = &self.query.int_point
        {
            return self.bound(leaf, point).map(drop);
        }
        self.bound_by(&nearest_triangle(leaf, self.query)?);
        Some(())
    }

    #[inline(always)]
    pub(crate) fn bound_by(&mut self, near: &LeafNearest) {
        self.beyond.distance_sq = self.query.limit(near.distance_sq);
        self.limit = self.query.key_limit(self.beyond.distance_sq);
        // Leaves beyond the limit never change the result. Kernels may skip them.
        self.best.distance_sq = near.distance_sq;
        self.refine_below = self.query.refine_below(near.distance_sq);
        #[cfg(meshsweep_wide)]
        {
            self.is_alone = false;
        }
    }

    /// Begins with an interval of the distance to the input mesh, input units, that another
    /// structure proved. The limit stands for the distance of a triangle, as in
    /// [`bound_by`](Self::bound_by). The caller begins anew if no triangle is computed so near.
    #[inline(always)]
    pub(crate) fn bound_by_interval(&mut self, known: &Interval) {
        self.known_lower = known.lower;
        let nearest = limit_within(self.query, known.upper);
        if Real(nearest) < Real(EVERYTHING_SQ) {
            self.beyond.distance_sq = self.query.limit(nearest);
            self.limit = self.query.key_limit(self.beyond.distance_sq);
            self.best.distance_sq = nearest;
            self.refine_below = self.query.refine_below(nearest);
        }
    }

    /// With a tolerance, only triangles that are nearer by the tolerance are wanted. None, if the
    /// distance was known to be no less.
    #[cold]
    fn tolerant_limit(&self, distance_sq: f32) -> f32 {
        let wanted = self.wanted(sqrt_approx(distance_sq));
        if self.known_lower.to_bits() != 0 && self.query.lower(wanted) <= self.known_lower {
            return 0.0;
        }
        square(wanted)
    }

    /// The least distance that is not nearer than this one by more than the tolerance.
    #[cold]
    #[inline(never)]
    fn wanted(&self, distance: f32) -> f32 {
        let absolute = self.query.units.inward(self.budget.absolute);
        greater(0.0, lesser(distance / (1.0 + self.budget.relative), distance - absolute))
    }

    #[cfg_attr(meshsweep_small, inline(never))]
    #[cfg_attr(not(meshsweep_small), inline(always))]
    pub(crate) fn improve(&mut self, distance_sq: f32, lanes: &Lanes, [node, child]: [u32; 2]) {
        // Of equal distances the first in blob order counts, which is the order of places: see
        // `TriangleAt`. Before the first triangle `node` is above all.
        let comes_later = (node, child) > (self.best.node, self.best.child);
        if comes_later && Real(distance_sq) == Real(self.best.distance_sq) {
            return;
        }
        self.best = Best { distance_sq, node, child, lanes: *lanes };
        self.refine_below = self.query.refine_below(distance_sq);
        self.beyond.low_sq = self.refine_below;
        self.beyond.wanted_sq = f32::from_bits(distance_sq.to_bits() + 1);
        let beyond = self.query.limit(distance_sq);
        if Real(beyond) < Real(self.beyond.distance_sq) {
            self.beyond.distance_sq = beyond;
        }
        #[cfg(not(meshsweep_wide))]
        {
            self.has_old_plane = true;
        }
        let limit =
            if self.tolerant { self.tolerant_limit(distance_sq) } else { self.beyond.distance_sq };
        self.limit = self.query.key_limit(limit);
        #[cfg(meshsweep_wide)]
        if self.is_alone {
            prefetch_source(self.tree, node, child);
        }
    }

    /// Refines triangles whose lower bound falls short of the best distance by more than rounding:
    /// slivers, and triangles next to the point.
    ///
    /// After the first leaf `refine_below` only falls. So a triangle whose lower bound is below the
    /// last value is refined in every order of visits. Refining any other triangle changes neither
    /// the distance nor its lower bound. So the result does not depend on the order.
    #[cold]
    #[inline(never)]
    pub(crate) fn refine(&mut self, [node, child]: [u32; 2], key: u32, low: u32) -> Option<()> {
        let query = self.query;
        // Here and below the leaf is not moved: at `opt-level = "s"` that is a copy by bytes.
        let leaf = self.tree.leaf(node, child);
        let leaf = leaf.as_ref()?;
        let box_sq = square(query.distance_of_key(key));
        for lane in lanes_of(low) {
            let seen = seen_from(leaf, lane, query.p);
            let near = nearness(&seen);
            if near.lower_bound_sq >= self.refine_below {
                continue;
            }
            let again = refined(&seen, &near);
            let better = sliver(query, near, &again);
            let (best_sq, lanes) = (self.best.distance_sq, &self.best.lanes);
            let here = node == self.best.node && child == self.best.child;
            let first = !here || lane < lanes.at(best_sq).0;
            let better_sq = better.distance_sq;
            let nearer = if first { better_sq <= best_sq } else { better_sq < best_sq };
            if better_sq < near.distance_sq && nearer {
                self.improve(better.distance_sq, &Lanes::one(lane, &better), [node, child]);
            }
            // From here on a greater bound changes no answer: `refine_below` only falls.
            let enough_sq = lesser(self.refine_below, self.refined_lower_sq);
            // The kernel's bound may be greater than all others.
            let known_sq = greater(near.lower_bound_sq, box_sq);
            if known_sq < enough_sq {
                let lower_sq = square(lower_bound_up_to(&seen, &again, enough_sq));
                let lower_sq = greater(known_sq, lower_sq);
                if lower_sq < enough_sq {
                    self.refined_lower_sq = lower_sq;
                }
            }
        }
        Some(())
    }

    #[inline(always)]
    pub(crate) fn answer(
        &self,
        descent: Descent,
        work: Work,
        hint: &mut Hint,
    ) -> Result<ClosestPoint, QueryError> {
        let Best { distance_sq, node, child, lanes, .. } = self.best;
        // Every triangle that was not refined has at least this squared lower bound.
        let mut least_sq = match Real(self.refine_below) {
            below if !below.is_at_most_zero() => below.0,
            // No leaf was visited.
            below if below == Real(f32::NEG_INFINITY) => f32::MAX,
            _ => 0.0,
        };
        if Real(self.refined_lower_sq) < Real(least_sq) {
            least_sq = self.refined_lower_sq;
        }
        let mut ended = Ended::Exact;
        if let Descent::Truncated { least, ended: why } = descent {
            ended = why;
            least_sq = lesser(least_sq, square(self.query.distance_of_key(least)));
        }
        if node == u32::MAX {
            // In place: a copy is made number by number.
            let mut answer = FarPoint { query: self.query }.closest_point(self.tree, self.point);
            if let Ok(answer) = &mut answer {
                let Interval { lower, upper } = answer.distance;
                let least = self.query.lower(sqrt_approx(least_sq));
                answer.distance.lower = lesser(greater(lower, least), upper);
                (answer.work, answer.ended) = (work, ended);
            }
            return answer;
        }
        *hint = Hint::of(node, child);
        let distance = sqrt_approx(distance_sq);
        let mut least = sqrt_approx(least_sq);
        if self.tolerant {
            least = lesser(least, self.wanted(distance) * (1.0 - 4.0 * U32));
            ended = if ended == Ended::Exact { Ended::Tolerance } else { ended };
        }
        let (lane, v, w) = lanes.at(distance_sq);
        let leaf = self.tree.leaf(node, child);
        let leaf = leaf.as_ref().ok_or(QueryError::Unchecked)?;
        Ok(ClosestPoint {
            distance: Interval::new(self.query.lower(least), self.query.upper(distance)),
            point: self.query.units.point(leaf.point(lane, v, w)),
            triangle: TriangleAt::new(node, child, lane).source(self.tree),
            work,
            ended,
        })
    }
}

impl<N: NearestOfLeaf> LeafVisitor for Closest<'_, N> {
    #[inline(always)]
    fn limit(&self) -> u32 {
        self.limit
    }

    #[inline(always)]
    fn leaf(&mut self, visit: &LeafVisit<'_>) -> Option<bool> {
        #[cfg(not(meshsweep_wide))]
        if SOFT_FLOAT
            && self.waits
            && !visit.leaf.is_f32()
            && let Some(point) = &self.query.int_point
        {
            self.wait(visit, point)?;
            return Some(true);
        }
        #[cfg(not(meshsweep_wide))]
        if self.has_old_plane {
            self.has_old_plane = false;
            let (residual, limit) = (self.best.lanes.residual(), self.beyond.distance_sq);
            self.beyond.plane =
                LeafPlane::across(self.query, residual, self.best.distance_sq, limit);
        }
        let near = (self.nearest)(&visit.leaf, self.query, &self.beyond)?;
        if near.distance_sq <= self.best.distance_sq {
            self.improve(near.distance_sq, &near.lanes, [visit.node, visit.child]);
        }
        if near.lower_bound_sq < self.refine_below {
            // Without the visit, which stays in registers.
            self.refine([visit.node, visit.child], visit.key, near.low)?;
        }
        Some(true)
    }
}

/// Whether a budget has no tolerance. None is negative.
#[inline(always)]
pub(crate) fn is_exact(budget: &Budget) -> bool {
    Real(budget.relative).is_at_most_zero() && Real(budget.absolute).is_at_most_zero()
}

fn square(x: f32) -> f32 {
    x * x
}
