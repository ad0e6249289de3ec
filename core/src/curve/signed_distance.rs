//! Whether a point is inside of a fence, and how far from its line.
//!
//! *Why the stored side is the input's.* Move every point of the input on a straight line to its
//! stored place. Every point of the curve moves by at most the surface error, so the curve never
//! touches a point that is farther from the stored one. Winding numbers about this point do not
//! change. The lower end of the distance is above 0 only at such points.

use super::closest_point::{CurveClosest, closest_point};
use super::zone_walk::is_allowed;
use crate::curve::format::Curve;
use crate::query::{Budget, Ended, Interval, QueryError, ScratchEntry, Side, Undecided, Work};

/// On which side of a fence a point is, and how far from its line.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct CurveSignedDistance {
    /// The distance to the nearest line of the input's fence, input units: negative where the fence
    /// allows the point. If the side is undecided, from minus the distance to the distance.
    pub distance: Interval,
    /// `Inside`: the fence allows the point.
    pub side: Side,
    /// The closest point of the line, and the distance without sign. `work` and `ended` are those
    /// of the whole search. [`Ended::Resolution`]: rounding leaves the side undecided.
    pub closest: CurveClosest,
}

impl Curve<'_> {
    /// Whether the curves are a fence, so that [`signed_distance`](Curve::signed_distance) answers:
    /// all points have the same z, and all polylines are closed. Firmware asks once at the start.
    ///
    /// Cost: linear in the polylines.
    ///
    /// # Errors
    /// [`QueryError::NotPlanar`], [`QueryError::OpenPolyline`].
    pub fn check_fence(&self) -> Result<(), QueryError> {
        self.plane().map(drop)
    }

    /// Whether a fence of closed polylines allows `point` (x and y, input units), and how far it is
    /// from the nearest line of the fence. Both are looked at along z: the curves' z is not asked.
    ///
    /// A point is inside of a polyline if the polyline winds around it, once or more often, in
    /// either direction. So a fence that crosses itself holds all that it encloses. A point is
    /// *allowed* if it is inside of an inclusion zone, or if there is none, and inside of no
    /// exclusion zone ([`zone`](Curve::zone)). [`Side::Inside`] says so, and the distance is
    /// negative.
    ///
    /// The distance is that to the nearest line of any zone. Nearer than its lower end the side
    /// does not change. Where zones overlap, a line may have the same side on both sides: then the
    /// edge of what is allowed is farther away.
    ///
    /// The side is that of the input's curve in real arithmetic, never a wrong one. It is
    /// undecided:
    /// - for [`OnSurface`](Undecided::OnSurface) if the lower end of the distance is 0: on a line,
    ///   and closer to it than the surface error, rounding and the tolerances of the budget;
    /// - for [`Steps`](Undecided::Steps) or [`Scratch`](Undecided::Scratch) if these ended the
    ///   search before that.
    ///
    /// `scratch` as for [`closest_point`](Curve::closest_point); only the distance needs it. A
    /// polyline without area, with all points on one segment, encloses nothing. Farther than 2^24
    /// times the curve's size the curve's box gives the interval. A tolerance of the budget
    /// shortens the search for the distance. Steps are those of both searches, the side's first.
    ///
    /// Cost: that of the closest point. For the side, two integers are compared for each segment of
    /// runs of up to 64 of them near the point, and a capsule is tested for each larger run.
    /// Source: Hormann & Agathos 2001; for runs of points `zone_walk`.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Curve, Scratch, Side};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/fence.msw"));
    /// let (fence, mut scratch) = (Curve::open(bytes)?, Scratch::<64>::new());
    /// let here = fence.signed_distance([50.0, 7.0], Budget::EXACT, &mut scratch)?;
    /// assert_eq!(here.side, Side::Inside);
    /// assert!(here.distance.lower <= -7.0 && -7.0 <= here.distance.upper);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`check_fence`](Curve::check_fence) and [`closest_point`](Curve::closest_point).
    #[inline(never)]
    pub fn signed_distance(
        &self,
        point: [f32; 2],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<CurveSignedDistance, QueryError> {
        budget.check_with(scratch)?;
        let Budget { relative, absolute, steps } = budget;
        let [x, y] = point;
        let mut p = self.frame.local([x, y, 0.0])?;
        p.z = self.plane()?;
        let mut work = Work::default();
        let allowed = is_allowed(self, p, steps, &mut work).ok_or(QueryError::Unchecked)?;
        let steps = steps.saturating_sub(work.opened);
        let mut closest = closest_point(self, p, [relative, absolute], steps, scratch)?;
        closest.work = closest.work.and(work);
        let side = match allowed {
            Err(Undecided::Steps) => Side::Undecided(Undecided::Steps),
            Ok(is_allowed) if closest.distance.lower > 0.0 => {
                if is_allowed {
                    Side::Inside
                } else {
                    Side::Outside
                }
            }
            _ => Side::Undecided(match closest.ended {
                ended @ (Ended::Steps | Ended::Scratch) => ended.undecided(),
                _ => Undecided::OnSurface,
            }),
        };
        if side == Side::Undecided(Undecided::OnSurface) {
            closest.ended = closest.ended.uncertain();
        }
        Ok(CurveSignedDistance { distance: closest.distance.on(side), side, closest })
    }

    /// The z of all points, local frame, if the curves bound areas of a plane.
    fn plane(&self) -> Result<f64, QueryError> {
        let (low, high) = (self.bounds.min.z, self.bounds.max.z);
        if low != high {
            return Err(QueryError::NotPlanar);
        }
        let mut polylines = 0..self.header.polylines;
        match polylines.find(|&polyline| self.is_closed(polyline) != Some(true)) {
            Some(polyline) => Err(QueryError::OpenPolyline { polyline }),
            None => Ok(f64::from(low)),
        }
    }
}
