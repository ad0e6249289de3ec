//! The program in one variable, on the line where two planes meet.

use glam::DVec3;

use super::half_space::HalfSpace;
use super::insertion::offset;
use super::interval::Interval;
use super::order::Run;
use super::tolerance::{CONTRADICTION, PARALLEL, scale};

/// A line, by its point nearest to the origin.
#[derive(Clone, Copy)]
struct Line {
    base: DVec3,
    /// Along the line, of any length.
    direction: DVec3,
    /// No `normal · direction` below this tells the line from a parallel of the plane.
    least_rate: f64,
}

/// A plane through which lines are computed.
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

/// The point nearest to `pull` on the line of `first` and `second`'s plane that satisfies
/// `constraints`.
///
/// `without` is the answer without `second`. It stays the answer where the planes are parallel and
/// contradict each other by no more than rounding. `None` if no point of the line satisfies the
/// constraints.
#[inline(always)]
pub(super) fn nearest<const CONE: bool>(
    run: &mut Run,
    first: &Plane,
    second: &HalfSpace,
    without: DVec3,
    pull: DVec3,
    constraints: &[HalfSpace],
) -> Option<DVec3> {
    // Nearly parallel normals are equal in their leading digits. Their difference is exact, so that
    // the product with it keeps all its digits where `first × second` would cancel.
    let facing = 1.0f64.copysign(first.normal.dot(second.normal));
    let direction = first.normal.cross(second.normal - first.normal * facing);
    let sine_sq = direction.length_squared();
    let missing = offset::<CONE>(second) - second.normal.dot(first.foot);
    if sine_sq < PARALLEL * PARALLEL {
        return (missing <= CONTRADICTION * scale(first.foot)).then_some(without);
    }
    let inverse = 1.0 / sine_sq;
    // In `first`, across the line, towards the inside of `second`; as long as the sine, so that a
    // step of `missing` over the sine's square along it ends in `second`.
    let inward = direction.cross(first.normal);
    let base = first.foot + inward * (missing * inverse);
    let target = direction.dot(pull) * inverse;
    let line = Line { base, direction, least_rate: PARALLEL * (scale(direction) - 1.0) };
    run.tests += constraints.len() as u64;
    if let Some(t) = line.clip::<CONE>(constraints).and_then(|interval| interval.nearest(target)) {
        return Some(base + direction * t);
    }
    run.tests += 2 * constraints.len() as u64;
    line.nearest_in_doubt::<CONE>(target, constraints)
}

impl Line {
    /// What `constraints` leave of the line; `None` if one parallel to it excludes all.
    #[inline(always)]
    fn clip<const CONE: bool>(&self, constraints: &[HalfSpace]) -> Option<Interval> {
        let mut interval = Interval::ALL;
        for h in constraints {
            let rate = h.normal.dot(self.direction);
            let bound = offset::<CONE>(h) - h.normal.dot(self.base);
            if rate.abs() > self.least_rate {
                interval.clip(rate, bound);
            } else if bound > CONTRADICTION * scale(self.base) {
                return None;
            }
        }
        Some(interval)
    }

    /// The answer where `constraints` exclude the whole line, but perhaps by no more than rounding
    /// would.
    #[cold]
    #[inline(never)]
    fn nearest_in_doubt<const CONE: bool>(
        &self,
        target: f64,
        constraints: &[HalfSpace],
    ) -> Option<DVec3> {
        let interval = self.clip::<CONE>(constraints)?;
        let point = self.base + self.direction * interval.nearest_or_middle(target);
        let tolerance = CONTRADICTION * scale(point);
        let holds = |h: &HalfSpace| offset::<CONE>(h) - h.normal.dot(point) <= tolerance;
        constraints.iter().all(holds).then_some(point)
    }
}
