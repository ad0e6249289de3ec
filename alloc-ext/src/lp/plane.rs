//! The program in two variables: on a plane.

use glam::DVec3;

use super::half_space::HalfSpace;
use super::insertion::insert;
use super::line::{self, Plane};
use super::order::Run;

/// The point of `h`'s plane nearest to `pull` that satisfies `constraints`.
///
/// `None` if there is none, also if `h`'s normal is zero.
#[inline(always)]
pub(super) fn nearest<const CONE: bool>(
    run: &mut Run,
    h: &HalfSpace,
    pull: DVec3,
    constraints: &mut [HalfSpace],
) -> Option<DVec3> {
    let plane = Plane::of::<CONE>(h)?;
    // `pull` enters by its component along the plane alone: the height above it comes from the
    // offset.
    let start = plane.foot + plane.along(pull);
    insert::<CONE>(run, start, constraints, |run, second, without, inserted| {
        line::nearest::<CONE>(run, &plane, second, without, pull, inserted)
    })
}
