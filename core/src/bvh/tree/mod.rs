//! What all questions of the box tree stand on.
//!
//! | file | owns |
//! | --- | --- |
//! | `format/` | the bytes: header, nodes, leaves, the check of [`Bvh::open`](format::Bvh::open) |
//! | `node/` | the box tests: eight boxes at a time |
//! | `descent` | the descent of one tree, for a point, a segment or a solid |
//! | `block_walk`, `prefetch` | that of exact answers, on targets with vector registers |
//! | `triangle_at` | the place of a triangle, in one word |
//! | `axis_intervals` | the boxes of a node as intervals along directions |
//! | `extended` | a model's extent, for its pose in the frame of another |
//! | `gap` | measured distances: the nearest, or one within a distance |
//! | `input_box` | a box that holds the input's vertices |
//! | `stored_lengths` | from distances of stored surfaces to those of the input |

pub(super) mod axis_intervals;
#[cfg(meshsweep_wide)]
pub(super) mod block_walk;
pub(super) mod descent;
pub(super) mod extended;
pub mod format;
pub(super) mod gap;
pub(super) mod input_box;
pub mod node;
#[cfg(meshsweep_wide)]
pub(super) mod prefetch;
pub(super) mod stored_lengths;
pub(super) mod triangle_at;
