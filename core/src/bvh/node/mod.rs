//! The node kernels: eight child boxes at a time.
//!
//! A node's eight child boxes share a frame: an integer rotation matrix from a quaternion of four
//! bytes, an origin on the grid, a power of two for each axis. A point is brought into the frame
//! once for each node. Then the test is the plain axis-aligned one, in 8 bits. Segments have boxes
//! of their own, which are axis-aligned.
//!
//! | file | owns |
//! | --- | --- |
//! | `keys` | a child's bound with its lane in the low bits |
//! | `frame` | a point in the frame of a node's boxes |
//! | `box_distances` | a point against eight boxes |
//! | `box_entries` | a segment against eight boxes |

mod box_distances;
mod box_entries;
mod frame;
mod keys;
#[cfg(test)]
mod tests;

pub use box_distances::box_distances;
pub use box_entries::{Slabs, box_entries};
pub use frame::NodeFrame;
pub use keys::{LANE_MASK, NO_CHILD, WIDE, in_memory, nearest_lane};
