//! Questions to the tribox hierarchy: what can be told without a triangle.
//!
//! | question | function |
//! | --- | --- |
//! | are two moved models apart? | [`apart`] |
//! | which of their triboxes may meet? | [`candidates`] |
//! | a lower bound of the distance to a point | [`distance`] |
//! | before where is a segment clear of the model? | [`clip`] |
//!
//! Whatever they prove is true of the input mesh in real arithmetic, and where [`Triboxes::is_solid`](crate::Triboxes::is_solid) says so of its inside. A coarser
//! answer for less work comes of [`Triboxes::coarser`](crate::Triboxes::coarser).

mod apart;
mod axes;
mod nearest;

pub use apart::{Candidates, NodePair, Reject, apart, candidates, stack_entries};
pub use nearest::{Bound, BoundEntry, clip, distance};
