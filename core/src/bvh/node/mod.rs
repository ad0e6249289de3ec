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
//! | `key_point` | [`KeyPoint`], a prepared point |
//! | `frame` | `NodeFrame`, the point in a node's frame, for targets without vectors |
//! | `grid_line` | [`GridLine`], a segment's line in integers, for targets without an FPU |
//! | `box_distances` | a point against eight boxes |
//! | `box_lanes` | the same in vector registers, frame included |
//! | `box_entries` | [`Slabs`], a segment prepared for the test; a segment against eight boxes |

mod box_distances;
mod box_entries;
#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
mod box_lanes;
#[cfg(any(test, not(any(target_arch = "x86_64", target_arch = "aarch64"))))]
mod frame;
mod grid_line;
mod key_point;
mod keys;
#[cfg(test)]
mod tests;

pub use box_distances::box_distances;
pub use box_entries::{Slabs, box_entries};
pub use grid_line::GridLine;
pub use key_point::KeyPoint;
#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
pub use keys::places_of_wanted;
pub use keys::{CHILD_MASK, NO_CHILD, WIDE, in_memory, least_key};
