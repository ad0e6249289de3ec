//! Why a query was refused.

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
