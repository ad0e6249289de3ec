//! Questions to the tribox hierarchy: what can be told without a triangle.
//!
//! | question | function |
//! | --- | --- |
//! | are two moved models apart? | [`apart`] |
//! | which of their triboxes may meet? | [`candidates`] |
//! | a lower bound of the distance to a point | [`distance`] |
//! | before where is a segment clear of the model? | [`clip`] |
//!
//! Whatever they prove is true of the input mesh in real arithmetic, and where
//! [`Triboxes::is_solid`](crate::Triboxes::is_solid) says so of its inside. A coarser answer for
//! less work comes of [`Triboxes::coarser`](crate::Triboxes::coarser).
//!
//! ```
//! use meshsweep_core::{Triboxes, tribox::Pose, query::tribox::{BoundEntry, NodePair, apart, distance}};
//! # fn probe(part: &[u8], tool: &[u8]) -> Result<(), Box<dyn core::error::Error>> {
//! // Of blobs built with `meshsweep build part.stl -o part.msw --for triboxes --triboxes 64`.
//! let (part, tool) = (Triboxes::open(part)?, Triboxes::open(tool)?);
//! let mut pairs = [NodePair::EMPTY; 32]; // `stack_entries` says what these two need
//! let pose = Pose { translation: [30.0, 0.0, 0.0], ..Pose::IDENTITY };
//! if apart(&part, &tool, &pose, &mut pairs)?.is_apart() { /* proved: the tool, moved, does not meet the part */ }
//! let mut stack = [BoundEntry::EMPTY; 32]; // `part.depth()` + 2 are enough
//! let bound = distance(&part, [0.1, 0.2, 0.3], &mut stack)?;
//! if bound.lower > 0.5 { /* proved: the part is farther than 0.5 */ }
//! # Ok(()) }
//! ```

mod apart;
mod axes;
mod nearest;

pub use apart::{Candidates, NodePair, Reject, apart, candidates, stack_entries};
pub use nearest::{Bound, BoundEntry, clip, distance};
