//! The box tree: eight boxes at a time, and the descent that all questions share.
//!
//! A node's eight child boxes share a frame: an integer rotation matrix from a quaternion of four
//! bytes, an origin on the grid, a power of two for each axis. A query is brought into the frame
//! once for each node; then the test is the plain axis-aligned one, in 8 bits.

mod frame;
mod lanes;
mod slab;
#[cfg(test)]
mod tests;

pub use frame::NodeFrame;
pub use lanes::{LANE_MASK, NO_CHILD, WIDE, box_distances, in_memory, nearest_lane};
pub use slab::{Slabs, box_entries};
