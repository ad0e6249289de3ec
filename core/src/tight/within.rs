//! Is a part within a distance? By its hull.

use super::closest_point::upper_end;
use super::side::is_outside_box;
use crate::bvh::{self, Side, Verdict, Within, signed_distance};
use crate::query::{Budget, Ended, QueryError, ScratchEntry};
use crate::tight::format::TightHull;

/// Is the part that the hull encloses at most `distance` (input units) from `point`?
///
/// `No` is said outside of the hull only, so that it holds for a solid part with its inside; within
/// the hull, and as far from it as its slack, the answer is `Yes` or `Unknown`. Who has to stay
/// clear takes `Unknown` for `Yes`, which names no triangle. `stack` and `stop` as for
/// [`tree::is_within`](crate::bvh::is_within).
///
/// Cost: where the hull is farther, that of its tree's `is_within`, and within its box that of its
/// [`signed_distance`]; else that of the tree's [`closest_point`](tree::closest_point) as well.
///
/// # Errors
/// [`QueryError::NotFinite`]; [`QueryError::Tolerance`] also for a distance that is negative, NaN
/// or infinite; [`QueryError::NoQueue`]; [`QueryError::NotServed`].
pub fn is_within(
    hull: &TightHull<'_>,
    point: [f32; 3],
    distance: f32,
    stop: &Budget,
    stack: &mut [ScratchEntry],
) -> Result<Within, QueryError> {
    let near = bvh::is_within(hull.tree(), point, distance, stop, stack)?;
    let answer = |verdict, work, ended| Ok(Within { verdict, work, ended });
    if near.is_clear() && is_outside_box(hull.tree(), point) {
        return answer(Verdict::No, near.work, Ended::Exact);
    }
    // A side needs the closest point itself.
    let stop = Budget { steps: stop.steps, ..Budget::EXACT };
    let (closest, side) = if near.is_clear() {
        let signed = signed_distance(hull.tree(), point, &stop, stack)?;
        (signed.closest, signed.side)
    } else {
        (bvh::closest_point(hull.tree(), point, &stop, stack)?, Side::Undefined)
    };
    let work = near.work.and(closest.work);
    if side == Side::Outside {
        return answer(Verdict::No, work, Ended::Exact);
    }
    if upper_end(hull, &closest) <= distance {
        return answer(Verdict::Yes { triangle: None }, work, Ended::Exact);
    }
    let is_cut = matches!(closest.ended, Ended::Steps | Ended::Capacity);
    answer(Verdict::Unknown, work, if is_cut { closest.ended } else { Ended::Level })
}
