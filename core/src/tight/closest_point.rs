//! The distance of a part by its hull.

use super::side::seen_from;
use crate::num::{sum_down, sum_up};
use crate::query::{Budget, ClosestPoint, Ended, Interval, QueryError, ScratchEntry};
use crate::tight::format::TightHull;

impl TightHull<'_> {
    /// An interval of the distance from `point` (input units) to the mesh inside the hull, and the
    /// closest point of the hull.
    ///
    /// `distance.upper` is at most the hull's distance plus the slack of its closest face. Outside
    /// the hull `distance.lower` is the hull's distance, so that the interval is as wide as the
    /// slack there. Inside, and nearer to the hull than 1/32 of its grid's unit (2 units with f32
    /// vertices) and the surface error, it is less by the hull's depth, and at least 0.
    /// [`point`](ClosestPoint::point) lies on the hull. There is no triangle.
    ///
    /// `scratch` as for [`Bvh::closest_point`](crate::Bvh::closest_point), for the hull's
    /// [`bvh`](TightHull::bvh). The budget's tolerances do not shorten the search. If the hull is
    /// as tight as the tolerance, it ends with [`Ended::Tolerance`], else with
    /// [`Ended::Resolution`]. [`Ended::Steps`] and [`Ended::Scratch`] as there.
    ///
    /// Cost: that of the box tree's closest point. Inside the hull's box a ray through the hull
    /// comes on top. It reads few leaves if the hull has boxes for segments, else all.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Scratch, TightHulls};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/hulls.msw"));
    /// let (hulls, mut scratch) = (TightHulls::open(bytes)?, Scratch::<64>::new());
    /// let hull = hulls.finest().expect("a blob has at least one hull");
    /// let near = hull.closest_point([300.0, 0.0, 0.0], Budget::EXACT, &mut scratch)?;
    /// assert!(near.distance.lower > 0.0);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
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
        budget.check()?;
        let (near, is_outside) = seen_from(self.bvh(), point, budget.steps, scratch)?;
        let lower = if is_outside {
            near.distance.lower
        } else {
            above_zero(sum_down(near.distance.lower, -self.record().depth))
        };
        let upper = upper_end(self, &near);
        let is_cut = matches!(near.ended, Ended::Steps | Ended::Scratch);
        let is_met = upper <= lower * (1.0 + budget.relative) || upper - lower <= budget.absolute;
        let ended = match near.ended {
            ended if is_cut => ended,
            _ if is_met => Ended::Tolerance,
            _ => Ended::Resolution,
        };
        Ok(ClosestPoint { distance: Interval { lower, upper }, triangle: None, ended, ..near })
    }
}

/// Upper bound of the distance to the mesh, by the closest point of the hull.
pub(crate) fn upper_end(hull: &TightHull<'_>, near: &ClosestPoint) -> f32 {
    let slack = near.triangle.and_then(|face| hull.slack(face)).unwrap_or(hull.record().slack);
    sum_up(near.distance.upper, slack)
}

fn above_zero(x: f32) -> f32 {
    if x > 0.0 { x } else { 0.0 }
}
