//! The program in two variables: on a plane.

use glam::DVec3;

use super::half_space::HalfSpace;
use super::insertion::{insert, offset};
use super::line;

/// A plane, and what of it every line in it needs.
#[derive(Clone, Copy)]
pub(super) struct Plane {
    /// Unit normal.
    pub(super) normal: DVec3,
    /// The plane's point nearest to the origin.
    pub(super) foot: DVec3,
}

impl Plane {
    /// The boundary of `h`; `None` if its normal is zero.
    #[inline(always)]
    pub(super) fn of<const CONE: bool>(h: &HalfSpace) -> Option<Self> {
        let (normal, offset) = (h.normal, offset::<CONE>(h));
        if normal.length_squared() < 0.5 {
            return None;
        }
        Some(Self { normal, foot: normal * offset })
    }

    /// The component of `v` along the plane. Two products keep the result at right angles to the
    /// normal to within rounding of its own length; subtracting `v`'s normal component once
    /// would only do so for `v`'s length, and `v` is as long as `1/eps`.
    #[inline(always)]
    fn along(&self, v: DVec3) -> DVec3 {
        self.normal.cross(v.cross(self.normal))
    }
}

/// The point of `h`'s plane nearest to `pull` that satisfies `constraints`.
///
/// `None` if there is none, also if `h`'s normal is zero.
#[inline(always)]
pub(super) fn nearest<const CONE: bool>(
    h: &HalfSpace,
    pull: DVec3,
    constraints: &mut [HalfSpace],
) -> Option<DVec3> {
    let plane = Plane::of::<CONE>(h)?;
    // `pull` enters by its component along the plane alone: the height above it comes from the
    // offset.
    let start = plane.foot + plane.along(pull);
    insert::<CONE>(start, constraints, |second, without, inserted| {
        line::nearest::<CONE>(&plane, second, Some(without), pull, inserted)
    })
}
