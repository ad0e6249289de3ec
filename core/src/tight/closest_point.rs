//! The distance of a part by its hull.

use super::side::seen_from;
use crate::num::{sum_down, sum_up};
use crate::query::{Budget, ClosestPoint, Ended, QueryError, ScratchEntry};
use crate::tight::format::TightHull;

/// An interval of the distance from `point` (input units, the mesh's frame) to the mesh that the
/// hull encloses, and the closest point of the hull.
///
/// `upper` is never above the hull's distance and the slack of its closest face. Outside of the
/// hull `lower` is the hull's distance, so that the interval is as wide as the slack there; inside,
/// or where rounding leaves the side open, it is less by the hull's depth, and at least 0.
/// [`point`](ClosestPoint::point) lies on the hull; there is no triangle.
///
/// `stack` as for [`tree::closest_point`](crate::bvh::closest_point), for the hull's
/// [`tree`](TightHull::tree). The tolerances of `stop` shorten nothing: a hull that is as
/// tight as asked for ends with [`Ended::Tolerance`], any other with [`Ended::Level`];
/// [`Ended::Steps`] and [`Ended::Capacity`] as there, with a lower end of 0 where the side was not
/// found.
///
/// Cost: that of the tree's closest point outside of the hull's box, of its
/// [`signed_distance`](crate::bvh::signed_distance) within.
///
/// # Errors
/// [`QueryError::NotFinite`], [`QueryError::Tolerance`], [`QueryError::NoQueue`];
/// [`QueryError::NotServed`] if the hull's tree was not built for distances.
pub fn closest_point(
    hull: &TightHull<'_>,
    point: [f32; 3],
    stop: &Budget,
    stack: &mut [ScratchEntry],
) -> Result<ClosestPoint, QueryError> {
    stop.check()?;
    let (near, is_outside) = seen_from(hull.tree(), point, stop.steps, stack)?;
    let lower = if is_outside {
        near.lower
    } else {
        above_zero(sum_down(near.lower, -hull.record().depth))
    };
    let upper = upper_end(hull, &near);
    let is_cut = matches!(near.ended, Ended::Steps | Ended::Capacity);
    let is_met = upper <= lower * (1.0 + stop.relative) || upper - lower <= stop.absolute;
    let ended = match near.ended {
        ended if is_cut => ended,
        _ if is_met => Ended::Tolerance,
        _ => Ended::Level,
    };
    Ok(ClosestPoint { lower, upper, triangle: None, ended, ..near })
}

/// What the distance from the mesh does not exceed, by the closest point of the hull.
pub(crate) fn upper_end(hull: &TightHull<'_>, near: &ClosestPoint) -> f32 {
    let slack = near.triangle.and_then(|face| hull.slack(face)).unwrap_or(hull.record().slack);
    sum_up(near.upper, slack)
}

fn above_zero(x: f32) -> f32 {
    if x > 0.0 { x } else { 0.0 }
}
