//! The closest point, with an interval of the distance.

#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
mod waiting;

use super::descent::{Descent, LeafVisit, LeafVisitor, descend_inlined};
use super::far_point::from_afar;
use super::leaf_distance::{
    Lanes, LeafLimit, LeafNearest, nearest_triangle, nearest_within_inlined,
};
#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
use super::leaf_plane::LeafPlane;
#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
use super::node::{OpenedNode, take_least};
#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
use super::point_blocks::{Kernels, search_by_blocks};
use super::point_query::{EVERY_KEY, PointQuery};
#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
use super::prefetch::prefetch_source;
use super::triangle_bounds::{nearness, seen_from, sliver};
use super::triangle_place::TrianglePlace;
use crate::bvh::format::{Bvh, FanLeaf, lanes_of};
use crate::geom::fan::WIDTH;
use crate::geom::fan::{lower_bound_up_to, refined};
#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
use crate::num::SOFT_FLOAT;
use crate::num::tolerance::{EVERYTHING_SQ, U32};
use crate::num::{Real, greater, lesser, sqrt_approx};
use crate::query::Interval;
use crate::query::{Budget, ClosestPoint, Ended, QueryError, ScratchEntry, Work};

#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
use crate::geom::fan::WholeBounds;
#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
use waiting::Waiting;

/// The leaf of an answer, to visit first for a query nearby. Any value is safe. A bad one costs a
/// leaf.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Hint(u32);

impl Hint {
    /// No hint.
    pub const NONE: Hint = Hint(u32::MAX);

    #[inline(always)]
    pub(super) fn node(self) -> u32 {
        self.0 >> 3
    }

    #[inline(always)]
    pub(super) fn child(self) -> u32 {
        self.0 & 7
    }
}

/// For the C interface, where zeros are no hint.
#[doc(hidden)]
impl Hint {
    /// The hint of a word.
    pub const fn of_word(word: u32) -> Hint {
        Hint(!word)
    }

    /// The word of a hint; 0 of none.
    pub const fn word(self) -> u32 {
        !self.0
    }
}

impl Bvh<'_> {
    /// Closest point of the surface to `point`, with an interval that contains the distance to the
    /// input mesh.
    ///
    /// `scratch`: [`scratch_entries`](Bvh::scratch_entries) make overflow impossible. With fewer
    /// the interval still holds, and [`Ended::Scratch`] says so. Lengths and coordinates are in
    /// input units, in the mesh's frame.
    ///
    /// Of equidistant triangles the answer is the least in blob order. A point on the surface has a
    /// lower bound of 0. Farther than a million model sizes the model's box gives the interval.
    ///
    /// Cost: five to fifteen nodes and three to twelve leaves on scanned parts, all in f32. The
    /// worst case is the whole tree, at the centre of a sphere. Where time is bounded, set
    /// [`Budget::with_steps`].
    ///
    /// ```
    /// use meshsweep_core::{Budget, Bvh, Scratch};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/groove.msw"));
    /// let part = Bvh::open(bytes)?;
    /// let mut scratch = Scratch::<64>::new();
    /// let near = part.closest_point([3.0, 0.0, 4.0], Budget::EXACT, &mut scratch)?;
    /// assert!(near.distance.lower <= near.distance.upper);
    /// assert!(near.triangle.is_some());
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`QueryError::NotFinite`], [`QueryError::Tolerance`], [`QueryError::NoScratch`];
    /// [`QueryError::NotServed`] if the tree was not built for distances, for far points too.
    #[inline(never)]
    pub fn closest_point(
        &self,
        point: [f32; 3],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<ClosestPoint, QueryError> {
        search(self, point, &mut Hint::NONE.clone(), &budget, scratch)
    }

    /// [`closest_point_from`](Bvh::closest_point_from) with the same `work` on every target. The
    /// builder predicts the instructions of boards from it.
    #[doc(hidden)]
    #[inline(always)]
    pub fn closest_point_in_order(
        &self,
        point: [f32; 3],
        hint: &mut Hint,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<ClosestPoint, QueryError> {
        if cfg!(any(target_arch = "x86_64", target_arch = "aarch64")) {
            search_by_entries(self, point, hint, &budget, scratch)
        } else {
            // The same, in the copy that other questions share.
            search(self, point, hint, &budget, scratch)
        }
    }

    /// [`closest_point`](Bvh::closest_point) that looks at the leaf of `hint` first and leaves its
    /// own there. An exact answer has the same bits with every hint.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Bvh, Hint, Scratch};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/groove.msw"));
    /// let (part, mut scratch, mut hint) = (Bvh::open(bytes)?, Scratch::<64>::new(), Hint::NONE);
    /// for step in 0..10 {
    ///     let tip = [3.0, 0.1 * step as f32, 4.0];
    ///     part.closest_point_from(tip, &mut hint, Budget::EXACT, &mut scratch)?;
    /// }
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`closest_point`](Bvh::closest_point).
    #[inline(never)]
    pub fn closest_point_from(
        &self,
        point: [f32; 3],
        hint: &mut Hint,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<ClosestPoint, QueryError> {
        search(self, point, hint, &budget, scratch)
    }
}

/// On vector targets inlined twice: without a hint, and with one. Boards that ask both share it.
#[cfg_attr(any(target_arch = "x86_64", target_arch = "aarch64"), inline(always))]
fn search(
    tree: &Bvh<'_>,
    point: [f32; 3],
    hint: &mut Hint,
    budget: &Budget,
    scratch: &mut [ScratchEntry],
) -> Result<ClosestPoint, QueryError> {
    #[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
    if let Some(answer) = search_by_blocks(
        tree,
        point,
        hint,
        budget,
        scratch,
        Kernels::new(
            #[inline(always)]
            |query: &PointQuery, opened: &OpenedNode| query.keys_in_register(tree, opened),
            #[inline(always)]
            |keys: &[u32; WIDTH], limit: u32| take_least(keys, limit),
            #[inline(always)]
            |leaf: &FanLeaf<'_>, query: &PointQuery, limit: &LeafLimit| {
                nearest_within_inlined(leaf, query, limit, None)
            },
            #[inline(always)]
            |leaf: &FanLeaf<'_>, query: &PointQuery, limit: &LeafLimit| {
                nearest_within_inlined(leaf, query, limit, None)
            },
        ),
    ) {
        return answer;
    }
    search_by_entries(tree, point, hint, budget, scratch)
}

/// The answer on targets without vector registers, and where steps or memory may end the search.
#[cfg_attr(any(target_arch = "x86_64", target_arch = "aarch64"), cold, inline(never))]
#[cfg_attr(not(any(target_arch = "x86_64", target_arch = "aarch64")), inline(always))]
fn search_by_entries(
    tree: &Bvh<'_>,
    point: [f32; 3],
    hint: &mut Hint,
    budget: &Budget,
    scratch: &mut [ScratchEntry],
) -> Result<ClosestPoint, QueryError> {
    // In place: a copy would take a board as long as the preparation.
    let prepared = PointQuery::prepare(tree, point, budget, scratch);
    let query = match &prepared {
        Ok(query) => query,
        Err(refused) => return Err(*refused),
    };
    if query.far {
        return from_afar(tree, point, query);
    }
    let mut work = Work::default();
    let nearest = inlined(
        #[inline(always)]
        |leaf: &FanLeaf<'_>, query: &PointQuery, limit: &LeafLimit| {
            nearest_within_inlined(leaf, query, limit, None)
        },
    );
    let mut visitor = Closest::new(tree, point, query, budget, nearest);
    #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
    if SOFT_FLOAT {
        let may_end_early =
            budget.steps < tree.most_steps() || scratch.len() < tree.scratch_entries();
        visitor.waits = !(visitor.tolerant || may_end_early);
    }
    if *hint != Hint::NONE
        && let Some(leaf) = tree.leaf(hint.node(), hint.child())
    {
        visitor.bound_by_leaf(&leaf).ok_or(QueryError::Unchecked)?;
    }
    let descent = descend_inlined(tree, query, budget.steps, scratch, &mut visitor, &mut work)?;
    #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
    if SOFT_FLOAT {
        visitor.look_at_waiting().ok_or(QueryError::Unchecked)?;
    }
    visitor.answer(descent, work, hint)
}

/// The nearest triangle so far: its leaf, and `lanes` that find it there.
#[derive(Clone, Copy)]
struct Best {
    distance_sq: f32,
    node: u32,
    child: u32,
    lanes: Lanes,
}

/// The nearest triangle of a leaf. Triangles that are proved to be beyond the limit may be left out.
pub(super) trait NearestOfLeaf:
    Fn(&FanLeaf<'_>, &PointQuery, &LeafLimit) -> Option<LeafNearest>
{
}

impl<F: Fn(&FanLeaf<'_>, &PointQuery, &LeafLimit) -> Option<LeafNearest>> NearestOfLeaf for F {}

/// A place for the attribute of a closure.
#[inline(always)]
fn inlined<N: NearestOfLeaf>(nearest: N) -> N {
    nearest
}

pub(super) struct Closest<'a, N> {
    nearest: N,
    tree: &'a Bvh<'a>,
    /// The query's point, input units.
    point: [f32; 3],
    query: &'a PointQuery,
    budget: &'a Budget,
    /// Key above which no triangle is nearer by more than the tolerance.
    limit: u32,
    /// Above its squared distance no triangle is nearer: `limit` without a tolerance.
    beyond: LeafLimit,
    best: Best,
    /// A triangle whose squared lower bound is below this is refined as a sliver.
    refine_below: f32,
    /// Least squared lower bound of the refined triangles.
    refined_lower_sq: f32,
    tolerant: bool,
    /// No hint. Behind a neighbour the cache has the triangle's number in the file.
    #[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
    is_alone: bool,
    /// The limit's plane is not that of the best triangle. It is made when a leaf needs it.
    #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
    has_old_plane: bool,
    /// Whether triangles wait for the f32 kernel: without floating point, if nothing may end the
    /// search early. Its limits then are others than on other targets.
    #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
    waits: bool,
    #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
    waiting: Waiting,
}

impl<'a, N: NearestOfLeaf> Closest<'a, N> {
    #[inline(always)]
    pub(super) fn new(
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
            tolerant: budget.relative > 0.0 || budget.absolute > 0.0,
            #[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
            is_alone: true,
            #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
            has_old_plane: false,
            #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
            waits: false,
            #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
            waiting: Waiting::NONE,
        }
    }

    /// Lowers the limit by a leaf that the descent reaches again.
    #[inline(always)]
    fn bound_by_leaf(&mut self, leaf: &FanLeaf<'_>) -> Option<()> {
        #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
        if SOFT_FLOAT
            && self.waits
            && !leaf.is_f32()
            && let Some(point) = &self.query.whole
        {
            return self.bound(leaf, point, &mut [WholeBounds::NONE; WIDTH]).map(drop);
        }
        self.bound_by(&nearest_triangle(leaf, self.query)?);
        Some(())
    }

    #[inline(always)]
    pub(super) fn bound_by(&mut self, near: &LeafNearest) {
        self.beyond.distance_sq = self.query.limit(near.distance_sq);
        self.limit = self.query.key_limit(self.beyond.distance_sq);
        // Leaves beyond the limit never change the result. Kernels may skip them.
        self.best.distance_sq = near.distance_sq;
        self.refine_below = self.query.refine_below(near.distance_sq);
        #[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
        {
            self.is_alone = false;
        }
    }

    /// With a tolerance, only triangles that are nearer by the tolerance are wanted.
    #[cold]
    fn tolerant_limit(&self, distance_sq: f32) -> f32 {
        square(self.wanted(sqrt_approx(distance_sq)))
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
    fn improve(&mut self, distance_sq: f32, lanes: &Lanes, [node, child]: [u32; 2]) {
        // Of equal distances the first in blob order counts, which is the order of places: see
        // `TrianglePlace`. Before the first triangle `node` is above all.
        let comes_later = (node, child) > (self.best.node, self.best.child);
        if comes_later && Real(distance_sq) == Real(self.best.distance_sq) {
            return;
        }
        self.best = Best { distance_sq, node, child, lanes: *lanes };
        self.refine_below = self.query.refine_below(distance_sq);
        self.beyond.low_sq = self.refine_below;
        let beyond = self.query.limit(distance_sq);
        if Real(beyond) < Real(self.beyond.distance_sq) {
            self.beyond.distance_sq = beyond;
        }
        #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
        {
            self.has_old_plane = true;
        }
        let limit =
            if self.tolerant { self.tolerant_limit(distance_sq) } else { self.beyond.distance_sq };
        self.limit = self.query.key_limit(limit);
        #[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
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
    fn refine(&mut self, [node, child]: [u32; 2], key: u32, low: u32) -> Option<()> {
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
            let nearer = better.distance_sq < best_sq || (better.distance_sq == best_sq && first);
            if better.distance_sq < near.distance_sq && nearer {
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
    pub(super) fn answer(
        &self,
        descent: Descent,
        work: Work,
        hint: &mut Hint,
    ) -> Result<ClosestPoint, QueryError> {
        let Best { distance_sq, node, child, lanes, .. } = self.best;
        // Every triangle that was not refined has at least this squared lower bound.
        let mut least_sq = match self.refine_below {
            below if below > 0.0 => below,
            // No leaf was visited.
            f32::NEG_INFINITY => f32::MAX,
            _ => 0.0,
        };
        if self.refined_lower_sq < least_sq {
            least_sq = self.refined_lower_sq;
        }
        let mut ended = Ended::Exact;
        if let Descent::Truncated { least, ended: why } = descent {
            ended = why;
            least_sq = lesser(least_sq, square(self.query.distance_of_key(least)));
        }
        if node == u32::MAX {
            let mut answer = from_afar(self.tree, self.point, self.query)?;
            let Interval { lower, upper } = answer.distance;
            let least = self.query.lower(sqrt_approx(least_sq));
            answer.distance.lower = lesser(greater(lower, least), upper);
            return Ok(ClosestPoint { work, ended, ..answer });
        }
        *hint = Hint(node << 3 | child);
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
            triangle: TrianglePlace::new(node, child, lane).source(self.tree),
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
        #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
        if SOFT_FLOAT
            && self.waits
            && !visit.leaf.is_f32()
            && let Some(point) = &self.query.whole
        {
            self.wait(visit, point)?;
            return Some(true);
        }
        #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
        if self.has_old_plane {
            self.has_old_plane = false;
            let (way, limit) = (self.best.lanes.way(), self.beyond.distance_sq);
            self.beyond.plane = LeafPlane::across(self.query, way, self.best.distance_sq, limit);
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

fn square(x: f32) -> f32 {
    x * x
}
