//! What a caller asks: one file per question, with stop rules, intervals and work counters.
//!
//! | question | function | engine |
//! | --- | --- | --- |
//! | closest point, distance interval | [`closest_point`] | cover tree, best first (Guéziec 2000, 4.3) |
//! | first hit of a segment | [`first_hit`] | cover tree |
//! | all hits of a segment | [`all_hits`] | cover tree |
//! | all of these and more, faster | [`tree`] | box tree over triangle fans |
//! | are two moved models apart; bounds without triangles | [`tribox`] | tribox hierarchy (Crosnier & Rossignac 1999, 4) |
//! | distance of a part that is known by its hull alone | [`tight`] | box tree of a tight hull |
//! | hits of a segment from outside | [`outer_hits`] | selectively refined hull (Platis & Theoharis 2003, 3.2) |

mod answer;
mod closest;
mod frame;
mod frontier;
mod outer_hits;
mod segment;
pub mod tight;
pub mod tree;
pub mod tribox;

pub use answer::{AllHits, Budget, ClosestPoint, Ended, Hit, QueryError, SegmentHit, Work};
pub use closest::closest_point;
pub use frontier::QueueEntry;
pub use outer_hits::{OuterHits, Search, outer_hits};
pub use segment::{all_hits, first_hit};
