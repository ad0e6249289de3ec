//! Intervals of the distance without a closest point: the field answers alone where it is narrow
//! enough.

use super::pair::{ANY_LENGTH, BvhWithSdf};
use crate::num::{greater, lesser, sum_up};
use crate::query::{Budget, Ended, Interval, QueryError, ScratchEntry, Side, Undecided, Work};
use crate::sdf::{FieldDistance, SdfKind};

/// Bounds of the distance to the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct DistanceBounds {
    /// The distance to the input mesh, input units.
    pub distance: Interval,
    /// The work of the tree's search; none if the field answered alone.
    pub work: Work,
    /// Why it ended: [`Ended::Tolerance`] also if the field is narrow enough.
    pub ended: Ended,
}

/// Bounds of the signed distance.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct SignedBounds {
    /// The signed distance to the input mesh, input units: negative inside. If the side is
    /// undecided, it holds the distance with both signs, or with the sign that is the right one.
    pub distance: Interval,
    /// The side of the point.
    pub side: Side,
    /// The work of the tree's search; none if the field answered alone.
    pub work: Work,
    /// Why it ended: [`Ended::Tolerance`] also if the field is narrow enough.
    pub ended: Ended,
}

/// Whether an interval meets the tolerances of a budget. Of signed distances the relative one is
/// met on either side of 0.
#[inline(always)]
fn is_narrow(Interval { lower, upper }: Interval, budget: &Budget) -> bool {
    let part = 1.0 + budget.relative;
    let is_met = if lower > 0.0 { upper <= lower * part } else { lower >= upper * part };
    let is_one_sided = lower > 0.0 || upper < 0.0;
    let is_bounded = lower >= -f32::MAX && upper <= f32::MAX;
    is_bounded && (is_one_sided && is_met || sum_up(upper, -lower) <= budget.absolute)
}

/// The numbers of two intervals of the same distance.
#[inline(always)]
fn common(a: Interval, b: Interval) -> Interval {
    Interval::new(greater(a.lower, b.lower), lesser(a.upper, b.upper))
}

impl BvhWithSdf<'_> {
    /// Bounds of the distance of `point` (input units) from the surface, to the tolerance of the
    /// budget. If the field's interval meets the tolerance, it is the answer. Else the tree
    /// searches the closest point between its ends.
    ///
    /// With [`Budget::EXACT`] it is the distance of the tree's closest point, or narrower.
    ///
    /// ```
    /// use meshsweep_core::{Budget, BvhWithSdf, Scratch};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/both.msw"));
    /// let (part, mut scratch) = (BvhWithSdf::open(bytes)?, Scratch::<64>::new());
    /// let budget = Budget::EXACT.with_relative(0.1);
    /// let near = part.distance_bounds([20.0, 20.0, 60.0], budget, &mut scratch)?;
    /// assert!(near.distance.upper <= 1.11 * near.distance.lower);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`Bvh::closest_point`](crate::Bvh::closest_point).
    #[inline(never)]
    pub fn distance_bounds(
        &self,
        point: [f32; 3],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<DistanceBounds, QueryError> {
        budget.check_with(scratch)?;
        self.check_distances()?;
        let known = self.known(point);
        if is_narrow(known, &budget) {
            return Ok(DistanceBounds {
                distance: known,
                work: Work::NONE,
                ended: Ended::Tolerance,
            });
        }
        // In place: the answer is large.
        let near = self.closest_between(point, &known, budget, scratch);
        let near = near.as_ref().map_err(|&refused| refused)?;
        Ok(DistanceBounds {
            distance: common(near.distance, known),
            work: near.work,
            ended: near.ended,
        })
    }

    /// Bounds of the signed distance of `point` (input units), negative inside, and its side. If
    /// the field's interval meets the tolerance of the budget, it is the answer, with a side unless
    /// the interval holds 0. Where the field tells the side but is too wide, the tree searches the
    /// closest point between its ends. Where it does not, the tree searches the side as well,
    /// without a tolerance.
    ///
    /// A field of kind signed suits the question best. One of kind solid tells of points outside
    /// alone, one of kind surface of none: the tree then answers the others.
    ///
    /// # Errors
    /// Those of [`Bvh::signed_distance`](crate::Bvh::signed_distance).
    #[inline(never)]
    pub fn signed_bounds(
        &self,
        point: [f32; 3],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<SignedBounds, QueryError> {
        budget.check_with(scratch)?;
        self.check_distances()?;
        let found = self.look_up(point);
        let (known, side) = found.map_or((ANY_SIGNED, ON_SURFACE), |found| self.signed(&found));
        if is_narrow(known, &budget) {
            let (work, ended) = (Work::NONE, Ended::Tolerance);
            return Ok(SignedBounds { distance: known, side, work, ended });
        }
        if matches!(side, Side::Undecided(_)) {
            let signed = self.tree().signed_distance(point, budget, scratch);
            let signed = signed.as_ref().map_err(|&refused| refused)?;
            return Ok(SignedBounds {
                distance: common(signed.distance, known),
                side: signed.side,
                work: signed.closest.work,
                ended: signed.closest.ended,
            });
        }
        let outward = found.map_or(ANY_LENGTH, |found| self.surface_interval(&found));
        let near = self.closest_between(point, &outward, budget, scratch);
        let near = near.as_ref().map_err(|&refused| refused)?;
        Ok(SignedBounds {
            distance: common(near.distance.on(side), known),
            side,
            work: near.work,
            ended: near.ended,
        })
    }

    /// What an answer of the field tells of the signed distance, and of the side.
    #[inline(always)]
    fn signed(&self, found: &FieldDistance) -> (Interval, Side) {
        match (self.field().kind(), found.side) {
            (SdfKind::Signed, side) | (_, side @ Side::Outside) => (found.distance, side),
            _ => (ANY_SIGNED, ON_SURFACE),
        }
    }
}

/// Any signed distance.
const ANY_SIGNED: Interval = Interval::new(f32::NEG_INFINITY, f32::INFINITY);

const ON_SURFACE: Side = Side::Undecided(Undecided::OnSurface);
