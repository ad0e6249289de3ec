//! Stop rules, answers, counters and errors.

/// When a query may stop before its answer is exact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Budget {
    /// Stop when `upper ≤ lower · (1 + relative)`. 0 for exact.
    pub relative: f32,
    /// Stop when `upper − lower ≤ absolute`, input units. 0 for exact.
    pub absolute: f32,
    /// Stop after opening so many nodes.
    pub steps: u32,
}

impl Budget {
    /// Go on until the interval is as narrow as arithmetic allows.
    pub const EXACT: Budget = Budget { relative: 0.0, absolute: 0.0, steps: u32::MAX };

    pub(super) fn check(&self) -> Result<(), QueryError> {
        let fine = |x: f32| x >= 0.0 && x.is_finite();
        if fine(self.relative) && fine(self.absolute) { Ok(()) } else { Err(QueryError::Tolerance) }
    }
}

impl Default for Budget {
    fn default() -> Self {
        Budget::EXACT
    }
}

/// Why a query ended. Whatever the reason, its interval holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ended {
    /// Nothing is left to look at: the interval is as narrow as the stored surface allows.
    Exact,
    /// The tolerance of [`Budget`] was met.
    Tolerance,
    /// The step budget of [`Budget`] was used up.
    Steps,
    /// The caller's memory was too short; [`Model::capacities`](crate::Model::capacities), or of a
    /// tree [`BvhHeader::stack_entries`](crate::blob::BvhHeader::stack_entries), says what is
    /// needed.
    Capacity,
    /// The blob knows the surface only to within an error, and that decides: it was cut after a
    /// coarser level, or a segment passes so near that vertices moved to a grid leave it open.
    Level,
}

/// What a query did: the price of its accuracy, the same number on every target.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Cover nodes or boxes tested.
    pub nodes: u32,
    /// Triangles of surface or hull tested in f32.
    pub triangles: u32,
    /// Triangles evaluated in f64.
    pub exact: u32,
    /// Nodes opened, or vertex splits performed.
    pub splits: u32,
}

impl Work {
    /// What this and another search did together.
    pub(super) fn and(self, other: Work) -> Work {
        Work {
            nodes: self.nodes.saturating_add(other.nodes),
            triangles: self.triangles.saturating_add(other.triangles),
            exact: self.exact.saturating_add(other.exact),
            splits: self.splits.saturating_add(other.splits),
        }
    }

    /// One number for a column: everything tested and opened.
    pub fn total(&self) -> u32 {
        self.nodes
            .saturating_add(self.triangles)
            .saturating_add(self.exact)
            .saturating_add(self.splits)
    }
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

/// A common point of a segment and the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Parameter, 0 at the segment's start, 1 at its end.
    pub t: f32,
    /// The point.
    pub point: [f32; 3],
    /// Number of the triangle in the input file; `None` on a cut blob, where the hit is a hull's.
    pub triangle: Option<u32>,
}

impl Hit {
    /// Any value, for filling arrays.
    pub const EMPTY: Hit = Hit { t: f32::INFINITY, point: [0.0; 3], triangle: None };
}

/// First hit of a segment.
///
/// The segment is proved clear of the surface before `lower` (everywhere, if `lower` is infinite).
/// If `hit` is there and `ended` is [`Ended::Exact`], the first common point has a parameter in
/// `lower ..= upper`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SegmentHit {
    /// No common point below this parameter; infinity if there is none at all.
    pub lower: f32,
    /// The first common point, if there is one, is not above this parameter; infinity if none is
    /// known. 1 where the segment touches an edge or a plane so flatly that rounding leaves
    /// more open.
    pub upper: f32,
    /// The first hit found. With [`Ended::Level`] only the first place where the surface may be;
    /// with [`Ended::Steps`] or [`Ended::Capacity`] perhaps not the first.
    pub hit: Option<Hit>,
    /// What it cost.
    pub work: Work,
    /// Why it ended.
    pub ended: Ended,
}

impl SegmentHit {
    /// Proved: no point of the segment lies on the input mesh.
    pub fn is_clear(&self) -> bool {
        self.lower == f32::INFINITY
    }
}

/// How a search for all hits went; the hits are in the caller's slice, by rising `t`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AllHits {
    /// Hits in the slice.
    pub stored: usize,
    /// Hits that did not fit; those kept are the first.
    pub dropped: u32,
    /// What it cost.
    pub work: Work,
    /// Why it ended. Unless [`Ended::Exact`], more hits may exist.
    pub ended: Ended,
}

/// Why a query was refused. Nothing was computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum QueryError {
    /// A coordinate of the query is NaN or infinite.
    NotFinite,
    /// A tolerance is negative, NaN or infinite.
    Tolerance,
    /// A point or an end of a segment is too far away: on the cover tree farther than 2^40 times
    /// the model's size from its origin, on the box tree 2^38 grid units from the model's
    /// farthest corner, of triboxes beyond [`Tribox::DOMAIN`](crate::tribox::Tribox::DOMAIN). Clip
    /// the segment first.
    OutOfDomain,
    /// An entry of a pose's matrix is beyond 2, of triboxes its translation beyond
    /// [`Tribox::DOMAIN`](crate::tribox::Tribox::DOMAIN), or one of two models is so much larger
    /// that the other is a point beside it: their grids differ by more than 2^40; or a blob's
    /// surface error is far larger than its model.
    PoseOutOfDomain,
    /// The caller's queue is empty.
    NoQueue,
    /// The blob was built without the sections that this question needs (`meshsweep build --for`).
    NotServed,
    /// The model is not one that `Model::open` returned. Cannot happen.
    Model,
}

impl core::fmt::Display for QueryError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            QueryError::NotFinite => "a coordinate of the query is NaN or infinite",
            QueryError::Tolerance => "a tolerance is negative, NaN or infinite",
            QueryError::OutOfDomain => "a point or a segment's end is too far from the model: clip segments first",
            QueryError::PoseOutOfDomain => {
                "an entry of the matrix is beyond 2, the translation too large, or one model 2^40 times as large as the other"
            }
            QueryError::NoQueue => "the queue has no entries",
            QueryError::NotServed => "the blob was built without the sections that this question needs",
            QueryError::Model => "the model was not opened",
        })
    }
}

impl core::error::Error for QueryError {}
