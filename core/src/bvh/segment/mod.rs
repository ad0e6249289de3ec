//! Questions about a segment.
//!
//! | file | owns |
//! | --- | --- |
//! | `first_hit`, `any_hit`, `all_hits` | the questions |
//! | `ray` | the same questions about a ray |
//! | `query` | a segment in grid units, ready for the descent |
//! | `start` | where a segment's line begins |
//! | `model_box/` | a segment against the model's box |
//! | `leaf` | a segment and the triangles of a leaf; the visitor of the questions |
//! | `blocks` | the descent of unlimited questions on targets with vector registers |

mod all_hits;
pub(super) mod any_hit;
#[cfg(meshsweep_wide)]
pub(super) mod blocks;
pub(super) mod first_hit;
pub(super) mod leaf;
mod model_box;
pub(super) mod query;
mod ray;
mod start;

pub use leaf::Facing;
