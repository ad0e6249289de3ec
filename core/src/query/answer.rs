//! Intervals, closest points, signed distances, and why a search ended.

use super::verdict::{Side, Undecided};
use super::work::Work;

/// The true value lies in `lower ..= upper`: that of the input mesh, in real arithmetic.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Interval {
    /// Not above the true value.
    pub lower: f32,
    /// Not below the true value.
    pub upper: f32,
}

impl Interval {
    /// All numbers from `lower` to `upper`.
    pub const fn new(lower: f32, upper: f32) -> Interval {
        Interval { lower, upper }
    }
}

/// Why a search ended. The interval holds with every reason.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Ended {
    /// The search is complete: the interval is as narrow as the stored surface allows.
    Exact,
    /// The tolerance of the [`Budget`](crate::Budget) was met.
    Tolerance,
    /// The steps of the [`Budget`](crate::Budget) were used up.
    Steps,
    /// The scratch memory was too short. `scratch_entries` of the view says how much is enough.
    Scratch,
    /// The stored precision leaves the answer undecided. The blob was cut after a coarser level, or
    /// the answer depends on less than the surface error and rounding.
    Resolution,
}

impl Ended {
    /// Why there is no verdict if the search ended so.
    pub(crate) fn undecided(self) -> Undecided {
        match self {
            Ended::Steps => Undecided::Steps,
            Ended::Scratch => Undecided::Scratch,
            _ => Undecided::Resolution,
        }
    }

    /// The same, but what is known is not certain.
    pub(crate) fn uncertain(self) -> Ended {
        if self == Ended::Exact { Ended::Resolution } else { self }
    }
}

/// Closest point of the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct ClosestPoint {
    /// The distance to the input mesh, input units.
    pub distance: Interval,
    /// A point of the surface at most `distance.upper` away, rounded to f32. On a cut blob a point
    /// of the hull.
    pub point: [f32; 3],
    /// Number in the input file of the triangle that holds `point`. Of equidistant triangles the
    /// least in blob order. `None` on a cut blob.
    pub triangle: Option<u32>,
    /// The work of the search.
    pub work: Work,
    /// Why the search ended.
    pub ended: Ended,
}

impl ClosestPoint {
    /// Any value, for filling arrays.
    pub const EMPTY: ClosestPoint = ClosestPoint {
        distance: Interval::new(0.0, f32::INFINITY),
        point: [0.0; 3],
        triangle: None,
        work: Work::NONE,
        ended: Ended::Exact,
    };
}

/// Signed distance: positive outside, negative inside.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct SignedDistance {
    /// The signed distance to the input mesh, input units. If the side is undecided, from minus the
    /// distance to the distance.
    pub distance: Interval,
    /// The side of the point.
    pub side: Side,
    /// The closest point, and the distance without sign. `work` and `ended` are those of the whole
    /// search. [`Ended::Resolution`]: sides are defined, and the stored surface or rounding leaves
    /// this one undecided.
    pub closest: ClosestPoint,
}

impl SignedDistance {
    pub(crate) fn new(closest: ClosestPoint, side: Side) -> Self {
        SignedDistance { distance: closest.distance.on(side), side, closest }
    }
}

impl Interval {
    /// The signed distance of a point on this side at this distance.
    pub(crate) fn on(self, side: Side) -> Interval {
        let Interval { lower, upper } = self;
        match side {
            Side::Outside => Interval { lower, upper },
            Side::Inside => Interval { lower: -upper, upper: -lower },
            Side::Undecided(_) => Interval { lower: -upper, upper },
        }
    }
}
