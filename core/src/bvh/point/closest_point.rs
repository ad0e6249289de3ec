//! The closest point, with an interval of the distance.

use super::hint::Hint;
use super::leaf::distance::nearest_within_inlined;
use super::leaf::limit::LeafLimit;
use super::query::{Asked, PointQuery, PreparedPoint};
#[cfg(meshsweep_wide)]
use super::search::blocks::{Kernels, search_by_blocks};
#[cfg(not(meshsweep_wide))]
use super::search::closest::is_exact;
use super::search::closest::{Closest, inlined};
use crate::bvh::tree::descent::descend_inlined;
use crate::bvh::tree::format::{Bvh, FanLeaf};
#[cfg(meshsweep_wide)]
use crate::bvh::tree::node::{OpenedNode, take_least};
#[cfg(meshsweep_wide)]
use crate::geom::fan::WIDTH;
#[cfg(not(meshsweep_wide))]
use crate::num::SOFT_FLOAT;
use crate::query::{Budget, ClosestPoint, Interval, QueryError, ScratchEntry, Work};

impl Bvh<'_> {
    /// Closest point of the surface to `point`, with an interval that contains the distance to the
    /// input mesh.
    ///
    /// `scratch`: [`scratch_entries`](Bvh::scratch_entries) make overflow impossible. With fewer
    /// the interval still holds, and [`Ended::Scratch`](crate::Ended::Scratch) says so. Lengths and
    /// coordinates are in input units, in the mesh's frame.
    ///
    /// Of equidistant triangles the answer is the least in blob order. A point on the surface has a
    /// lower bound of 0. Farther than a million model sizes the model's box gives the interval.
    ///
    /// Cost: five to fifteen nodes and three to twelve leaves on scanned parts, all in f32. The
    /// worst case is the whole tree, at the centre of a sphere; without floating point, twice that.
    /// Where time is bounded, set [`Budget::with_steps`].
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

    /// [`closest_point_from`](Bvh::closest_point_from) with the same `work` on every target with
    /// floating point, and with a limit of steps on every target. The builder predicts the
    /// instructions of boards from it.
    #[doc(hidden)]
    #[inline(always)]
    pub fn closest_point_in_order(
        &self,
        point: [f32; 3],
        hint: &mut Hint,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<ClosestPoint, QueryError> {
        if cfg!(meshsweep_wide) {
            search_by_entries(self, point, hint, None, &budget, scratch)
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

    /// [`closest_point`](Bvh::closest_point) that knows an interval of the distance beforehand. The
    /// upper end limits the search from the start. A search with a tolerance ends at the lower end.
    /// Always in the order of all targets: the interval decides where a tolerance ends it.
    #[inline(never)]
    pub(crate) fn closest_point_between(
        &self,
        point: [f32; 3],
        known: &Interval,
        budget: &Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<ClosestPoint, QueryError> {
        let hint = &mut Hint::NONE.clone();
        search_by_entries(self, point, hint, Some(known), budget, scratch)
    }
}

/// On vector targets inlined twice: without a hint, and with one. Boards that ask both share it.
#[cfg_attr(meshsweep_wide, inline(always))]
fn search(
    tree: &Bvh<'_>,
    point: [f32; 3],
    hint: &mut Hint,
    budget: &Budget,
    scratch: &mut [ScratchEntry],
) -> Result<ClosestPoint, QueryError> {
    #[cfg(meshsweep_wide)]
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
    search_by_entries(tree, point, hint, None, budget, scratch)
}

/// The answer on targets without vector registers, and where steps or memory may end the search.
#[cfg_attr(meshsweep_wide, cold, inline(never))]
#[cfg_attr(not(meshsweep_wide), inline(always))]
fn search_by_entries(
    tree: &Bvh<'_>,
    point: [f32; 3],
    hint: &mut Hint,
    known: Option<&Interval>,
    budget: &Budget,
    scratch: &mut [ScratchEntry],
) -> Result<ClosestPoint, QueryError> {
    // In place: a copy would take a board as long as the preparation.
    let prepared = PreparedPoint::prepare(tree, point, budget, scratch);
    let query = match prepared.as_ref().map(PreparedPoint::asked) {
        Ok(Asked::Near(query)) => query,
        Ok(Asked::Far(far)) => return far.closest_point(tree, point),
        Err(refused) => return Err(*refused),
    };
    let (mut work, mut known) = (Work::default(), known);
    // A limit of steps counts what this search opens, so it goes in the order of all targets.
    #[cfg(not(meshsweep_wide))]
    let mut waits = SOFT_FLOAT
        && budget.steps == Budget::EXACT.steps
        && scratch.len() >= tree.scratch_entries()
        && is_exact(budget);
    loop {
        let nearest = inlined(
            #[inline(always)]
            |leaf: &FanLeaf<'_>, query: &PointQuery, limit: &LeafLimit| {
                nearest_within_inlined(leaf, query, limit, None)
            },
        );
        let mut visitor = Closest::new(tree, point, query, budget, nearest);
        #[cfg(not(meshsweep_wide))]
        if SOFT_FLOAT {
            visitor.waits = waits;
        }
        if *hint != Hint::NONE
            && let Some(leaf) = tree.leaf(hint.node(), hint.child())
        {
            visitor.bound_by_leaf(&leaf).ok_or(QueryError::Unchecked)?;
        }
        if let Some(known) = known {
            visitor.bound_by_interval(known);
        }
        let descent = descend_inlined(tree, query, budget.steps, scratch, &mut visitor, &mut work)?;
        #[cfg(meshsweep_wide)]
        let is_known = true;
        #[cfg(not(meshsweep_wide))]
        let is_known = !waits || visitor.look_at_waiting().ok_or(QueryError::Unchecked)?;
        // A triangle may be computed farther than an upper end that is proved: then none of them is
        // within it, and the search begins anew without it.
        let is_missed = known.is_some() && visitor.best.node == u32::MAX;
        if is_known && !is_missed {
            return visitor.answer(descent, work, hint);
        }
        known = None;
        #[cfg(not(meshsweep_wide))]
        {
            waits = false;
        }
    }
}
