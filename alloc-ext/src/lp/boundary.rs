//! The boundary plane of a half-space.

use glam::DVec3;

use super::half_space::HalfSpace;
use super::insertion::offset;

/// The boundary of a half-space, as every line in it needs it.
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
    pub(super) fn along(&self, v: DVec3) -> DVec3 {
        self.normal.cross(v.cross(self.normal))
    }
}
