//! Stop rules, answers, counters and errors.

use super::work::Work;

/// Why a query ended. Whatever the reason, its interval holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ended {
    /// Nothing is left to look at: the interval is as narrow as the stored surface allows.
    Exact,
    /// The tolerance of [`Budget`] was met.
    Tolerance,
    /// The step budget of [`Budget`] was used up.
    Steps,
    /// The caller's memory was too short; [`Model::capacities`](crate::hull::format::Model::capacities), or of a
    /// tree [`BvhHeader::stack_entries`](crate::bvh::format::BvhHeader::stack_entries), says what is
    /// needed.
    Capacity,
    /// The blob knows the surface only to within an error, and that decides: it was cut after a
    /// coarser level, or a segment passes so near that vertices moved to a grid leave it open.
    Level,
}

/// Closest point of the surface: `lower ≤ distance to the input mesh ≤ upper`, in real arithmetic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClosestPoint {
    /// Not above the distance, input units.
    pub lower: f32,
    /// Not below the distance, input units.
    pub upper: f32,
    /// A point of the surface at most `upper` away, rounded to f32; on a cut blob a point of the
    /// hull.
    pub point: [f32; 3],
    /// Number in the input file of the triangle that holds `point`; ties go to the least in blob
    /// order. `None` on a cut blob.
    pub triangle: Option<u32>,
    /// What it cost.
    pub work: Work,
    /// Why it ended.
    pub ended: Ended,
}
