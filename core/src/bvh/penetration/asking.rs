//! Questions about two solids, with one count of the work.

use crate::bvh::format::Bvh;
use crate::bvh::signed_distance::SignedDistance;
use crate::geom::Pose;
use crate::num::tolerance::{PART_PLACE, U64};
use crate::query::{
    Budget, Ended, Motion, PairContact, PairDistance, QueryError, ScratchEntry, Side, Verdict, Work,
};

/// Part of a motion below which an advance ends the search for its contact. Near contact each
/// advance gains less than the last one.
const LEAST_ADVANCE: f64 = 1.0 / 4096.0;

/// Two trees, the second one moved, and what was spent on questions about them.
pub(super) struct Asking<'s, 'a> {
    pub(super) trees: [&'a Bvh<'a>; 2],
    pub(super) pose: Pose,
    steps: u32,
    scratch: &'s mut [ScratchEntry],
    pub(super) work: Work,
}

impl<'s, 'a> Asking<'s, 'a> {
    pub(super) fn new(
        trees: [&'a Bvh<'a>; 2],
        pose: Pose,
        steps: u32,
        scratch: &'s mut [ScratchEntry],
    ) -> Self {
        Asking { trees, pose, steps, scratch, work: Work::default() }
    }

    /// The steps that are left.
    fn left(&self) -> Budget {
        Budget::EXACT.with_steps(self.steps.saturating_sub(self.work.splits))
    }

    pub(super) fn is_spent(&self) -> bool {
        self.work.splits >= self.steps
    }

    pub(super) fn ended(&self) -> Ended {
        if self.is_spent() { Ended::Steps } else { Ended::Exact }
    }

    pub(super) fn distance(&mut self, pose: &Pose) -> Result<PairDistance, QueryError> {
        let ([a, b], left) = (self.trees, self.left());
        let found = a.distance(b, *pose, left, self.scratch)?;
        self.work = self.work.and(found.work);
        Ok(found)
    }

    /// Whether it is proved that the surfaces are farther than this from each other.
    pub(super) fn is_clear(&mut self, pose: &Pose, distance: f32) -> Result<bool, QueryError> {
        let ([a, b], left) = (self.trees, self.left());
        let found = a.within_of(b, *pose, distance, left, self.scratch)?;
        self.work = self.work.and(found.work);
        Ok(found.verdict == Verdict::No)
    }

    pub(super) fn first_contact(&mut self, motion: &Motion) -> Result<PairContact, QueryError> {
        let ([a, b], left) = (self.trees, self.left());
        let found = a.advance(b, motion, (0.0, LEAST_ADVANCE), left, self.scratch)?;
        self.work = self.work.and(found.work);
        Ok(found)
    }

    pub(super) fn signed(
        &mut self,
        tree: &Bvh<'_>,
        point: [f32; 3],
    ) -> Result<SignedDistance, QueryError> {
        let left = self.left();
        let found = tree.signed_distance(point, left, self.scratch)?;
        self.work = self.work.and(found.closest.work);
        Ok(found)
    }

    /// The side of all places within `reach` of a point, input units.
    pub(super) fn side_of_ball(
        &mut self,
        tree: &Bvh<'_>,
        centre: [f64; 3],
        reach: f64,
    ) -> Result<Option<Side>, QueryError> {
        let point = centre.map(|x| x as f32);
        if !point.iter().all(|x| x.is_finite()) {
            return Ok(None);
        }
        let found = self.signed(tree, point)?;
        let off = centre.iter().zip(point).fold(0.0, |sum, (x, near)| {
            sum + (x - f64::from(near)).abs() + x.abs() * (PART_PLACE * U64)
        });
        let is_clear = f64::from(found.closest.distance.lower) > reach + off;
        Ok(is_clear.then_some(found.side))
    }
}
