//! The closest point, and the side: the tree answers, and the field spares a part of its search.

use super::pair::{ANY_LENGTH, BvhWithSdf};
use crate::num::{SOFT_FLOAT, greater, lesser};
use crate::query::{
    Budget, ClosestPoint, Interval, QueryError, ScratchEntry, Side, SignedDistance,
};

impl BvhWithSdf<'_> {
    /// [`Bvh::closest_point`](crate::Bvh::closest_point). The field's interval limits the search:
    /// no triangle beyond its upper end is looked at, and with a tolerance a triangle that is near
    /// enough to its lower end ends the search. With a limit of steps, or with less scratch than
    /// the tree asks for, the search is the tree's own. Without a tolerance the answer has the
    /// tree's bits, but for `work`; then processors with vector registers, or without floating
    /// point, ask the tree alone.
    ///
    /// With a tolerance the lower end of the distance is the greater one of both. The upper end is
    /// that of the triangle found. If the distance is enough without a point,
    /// [`distance_bounds`](Self::distance_bounds) mostly needs no search.
    ///
    /// # Errors
    /// Those of [`Bvh::closest_point`](crate::Bvh::closest_point).
    #[inline(never)]
    pub fn closest_point(
        &self,
        point: [f32; 3],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<ClosestPoint, QueryError> {
        budget.check_with(scratch)?;
        if !self.may_limit(&budget, scratch) {
            return self.tree().closest_point(point, budget, scratch);
        }
        self.closest_between(point, &self.known(point), budget, scratch)
    }

    /// [`Bvh::signed_distance`](crate::Bvh::signed_distance). Where the field tells the side, only
    /// the closest point is searched, to the tolerance of the budget; the tree searches sides
    /// without a tolerance.
    ///
    /// The side may be decided where the tree alone leaves it undecided: above the edges of damaged
    /// meshes, or next to triangles that tell no side.
    ///
    /// # Errors
    /// Those of [`Bvh::signed_distance`](crate::Bvh::signed_distance).
    #[inline(never)]
    pub fn signed_distance(
        &self,
        point: [f32; 3],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<SignedDistance, QueryError> {
        budget.check_with(scratch)?;
        let found = self.look_up(point);
        let known = found.map_or(ANY_LENGTH, |found| self.surface_interval(&found));
        match found.map(|found| found.side) {
            Some(side @ (Side::Outside | Side::Inside)) => {
                let closest = self.closest_between(point, &known, budget, scratch)?;
                Ok(SignedDistance::new(closest, side))
            }
            _ => self.tree().signed_distance(point, budget, scratch),
        }
    }

    /// Whether the field's interval may limit the search. It may not where steps or scratch could
    /// end the search before a triangle within the limit is found: the answer would have no point.
    /// For exact points vector targets visit leaves in an order of their own, and targets without
    /// floating point keep limits as integers. There a limit from outside has no place.
    #[inline(always)]
    fn may_limit(&self, budget: &Budget, scratch: &[ScratchEntry]) -> bool {
        budget.steps == Budget::EXACT.steps
            && scratch.len() >= self.tree().scratch_entries_for(*budget)
            && (!is_exact(budget) || !(SOFT_FLOAT || cfg!(meshsweep_wide)))
    }

    /// The tree's closest point, between the ends of a known interval of the distance.
    #[inline(never)]
    pub(super) fn closest_between(
        &self,
        point: [f32; 3],
        known: &Interval,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<ClosestPoint, QueryError> {
        // In place: a copy is made number by number.
        let mut answer = if self.may_limit(&budget, scratch) {
            self.tree().closest_point_between(point, known, &budget, scratch)
        } else {
            self.tree().closest_point(point, budget, scratch)
        };
        if let Ok(near) = &mut answer
            && !is_exact(&budget)
        {
            // `point` lies within the tree's upper end, and perhaps not within the field's.
            let Interval { lower, upper } = near.distance;
            near.distance.lower = lesser(greater(lower, known.lower), upper);
        }
        answer
    }
}

/// Whether a budget has no tolerance. None is negative.
#[inline(always)]
fn is_exact(budget: &Budget) -> bool {
    budget.relative <= 0.0 && budget.absolute <= 0.0
}
