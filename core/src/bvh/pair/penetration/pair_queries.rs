//! Queries about two solids, charged to one budget.

use crate::bvh::tree::format::Bvh;
use crate::geom::Pose;
use crate::num::tolerance::{PART_PLACE, U64};
use crate::query::{
    Budget, Ended, Motion, PairContact, PairDistance, QueryError, ScratchEntry, Side,
    SignedDistance, Undecided, Verdict, Work,
};

/// An advance by less than this fraction of a motion ends the search for its contact. Near contact
/// each advance gains less than the last one.
const ROUGH_ADVANCE: f64 = 1.0 / 4096.0;

/// Two trees, the second one moved, and what was spent on queries about them.
pub(super) struct PairQueries<'s, 'a> {
    pub(super) trees: [&'a Bvh<'a>; 2],
    pub(super) pose: Pose,
    steps: u32,
    scratch: &'s mut [ScratchEntry],
    pub(super) work: Work,
    /// Why the first query that was cut short was.
    cut: Option<Ended>,
    /// The interval met the tolerance before everything was tried.
    pub(super) met_tolerance: bool,
}

impl<'s, 'a> PairQueries<'s, 'a> {
    pub(super) fn new(
        trees: [&'a Bvh<'a>; 2],
        pose: Pose,
        steps: u32,
        scratch: &'s mut [ScratchEntry],
    ) -> Self {
        let work = Work::default();
        PairQueries { trees, pose, steps, scratch, work, cut: None, met_tolerance: false }
    }

    fn remaining_budget(&self) -> Budget {
        Budget::EXACT.with_steps(self.steps.saturating_sub(self.work.opened))
    }

    fn count(&mut self, work: Work, ended: Ended) {
        self.work = self.work.and(work);
        if self.cut.is_none() && matches!(ended, Ended::Steps | Ended::Scratch) {
            self.cut = Some(ended);
        }
    }

    /// Whether no steps are left.
    pub(super) fn is_spent(&mut self) -> bool {
        let is_spent = self.work.opened >= self.steps;
        if is_spent && self.cut.is_none() {
            self.cut = Some(Ended::Steps);
        }
        is_spent
    }

    pub(super) fn ended(&self) -> Ended {
        let whole = if self.met_tolerance { Ended::Tolerance } else { Ended::Exact };
        self.cut.unwrap_or(whole)
    }

    pub(super) fn distance(&mut self, pose: &Pose) -> Result<PairDistance, QueryError> {
        let ([a, b], budget) = (self.trees, self.remaining_budget());
        let found = a.distance_to(b, *pose, budget, self.scratch)?;
        self.count(found.work, found.ended);
        Ok(found)
    }

    /// Whether it is proved that the surfaces are farther than this from each other.
    pub(super) fn is_clear(&mut self, pose: &Pose, distance: f32) -> Result<bool, QueryError> {
        let ([a, b], budget) = (self.trees, self.remaining_budget());
        let found = a.within_of(b, *pose, distance, budget, self.scratch)?;
        let ended = match found.verdict {
            Verdict::Undecided(Undecided::Steps) => Ended::Steps,
            Verdict::Undecided(Undecided::Scratch) => Ended::Scratch,
            _ => Ended::Exact,
        };
        self.count(found.work, ended);
        Ok(found.verdict == Verdict::No)
    }

    pub(super) fn first_contact(&mut self, motion: &Motion) -> Result<PairContact, QueryError> {
        let ([a, b], budget) = (self.trees, self.remaining_budget());
        let found = a.advance(b, motion, (0.0, ROUGH_ADVANCE), budget, self.scratch)?;
        self.count(found.work, found.ended);
        Ok(found)
    }

    pub(super) fn signed(
        &mut self,
        tree: &Bvh<'_>,
        point: [f32; 3],
    ) -> Result<SignedDistance, QueryError> {
        let budget = self.remaining_budget();
        let found = tree.signed_distance_by_winding(point, budget, self.scratch)?;
        self.count(found.closest.work, found.closest.ended);
        Ok(found)
    }

    /// The side of every point of a ball, input units. `None` if the surface may enter the ball.
    pub(super) fn side_of_ball(
        &mut self,
        tree: &Bvh<'_>,
        centre: [f64; 3],
        radius: f64,
    ) -> Result<Option<Side>, QueryError> {
        let point = centre.map(|x| x as f32);
        if !point.iter().all(|x| x.is_finite()) {
            return Ok(None);
        }
        let found = self.signed(tree, point)?;
        let off = centre.iter().zip(point).fold(0.0, |sum, (x, near)| {
            sum + (x - f64::from(near)).abs() + x.abs() * (PART_PLACE * U64)
        });
        let is_clear = f64::from(found.closest.distance.lower) > radius + off;
        Ok(is_clear.then_some(found.side))
    }
}
