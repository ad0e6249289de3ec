//! What all questions share: budgets, scratch memory, intervals, work counters, errors.

mod answer;
mod budget;
mod error;
mod frame;
mod hits;
mod scratch;
mod work;

pub use answer::{ClosestPoint, Ended};
pub use budget::Budget;
pub use error::QueryError;
pub(crate) use frame::Frame;
pub(crate) use hits::insert;
pub use hits::{AllHits, Hit, SegmentHit};
pub use scratch::ScratchEntry;
pub use work::Work;

// Old paths, until the callers have moved.
#[doc(hidden)]
pub use crate::hull::{
    OuterHits, QueueEntry, Search, all_hits, closest_point, first_hit, outer_hits,
};
#[doc(hidden)]
pub mod tree {
    pub use crate::bvh::*;
    pub use crate::geom::Contact;
    pub use crate::query::ScratchEntry;
}
#[doc(hidden)]
pub use crate::tight;
#[doc(hidden)]
pub mod tribox {
    pub use crate::tribox::{
        Bound, BoundEntry, Candidates, NodePair, Reject, apart, candidates, clip, distance,
        stack_entries,
    };
}
