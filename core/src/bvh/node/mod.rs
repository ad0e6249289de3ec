//! The box tests: a point or a segment against the eight child boxes of a node at once. The boxes
//! of two trees are tested in `overlap/axis_intervals.rs`.
//!
//! For points, the child boxes of a node share a frame: a rotation, an origin on the grid, a step
//! for each axis. A point is brought into the frame once for each node. Then the test is the plain
//! axis-aligned one, in integers. Segments have boxes of their own, which are axis-aligned.
//!
//! | file | owns |
//! | --- | --- |
//! | `keys` | a child's bound with its number in the low bits |
//! | `frame` | [`KeyPoint`], a point that is prepared for frames |
//! | `grid_line` | [`GridLine`], a segment's line in integers, for targets without an FPU |
//! | `box_distances` | a point against eight boxes |
//! | `box_lanes` | the same in vector registers, frame included |
//! | `axis_place` | `AxisPlace`, a point along one axis of a frame, where there are no vectors |
//! | `pairs` | a point against eight boxes there, two children in a word |
//! | `box_entries` | [`Slabs`], a segment prepared for the test; a segment against eight boxes |

#[cfg(any(test, not(any(target_arch = "x86_64", target_arch = "aarch64"))))]
mod axis_place;
mod box_distances;
mod box_entries;
#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
mod box_lanes;
mod frame;
mod grid_line;
mod keys;
#[cfg(any(test, not(any(target_arch = "x86_64", target_arch = "aarch64"))))]
mod pairs;
#[cfg(test)]
mod tests;

pub use box_distances::box_distances;
pub use box_entries::{Slabs, box_entries};
pub use frame::KeyPoint;
pub use grid_line::GridLine;
#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
pub use keys::places_of_wanted;
pub use keys::{CHILD_MASK, NO_CHILD, WIDE, in_memory, least_key};
