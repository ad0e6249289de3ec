//! The bytes of the box tree.
//!
//! | file | owns |
//! | --- | --- |
//! | `layout` | sizes and limits of the sections |
//! | `header` | the tree's own header |
//! | `view` | [`Bvh`]: nodes, links, boxes and source numbers where they lie |
//! | `units` | grid units and input units |
//! | `leaf` | [`FanLeaf`]: one or two fans where they lie |
//! | `leaf_corners` | which triangles of a leaf have a corner at a place |
//! | `leaf_lanes` | a leaf's fans a register at a time, on vector targets |
//! | `leaf_avx2` | the same in registers of 256 bits |
//! | `cone` | the bytes of a leaf's normal cone |
//! | `moments` | the bytes of a node's moments |
//! | `triangle_bits` | a bit for each triangle: whether it is turned for sides, or tells none |
//! | `check` | the check of `Bvh::open` |

mod check;
mod cone;
mod header;
pub mod layout;
mod leaf;
#[cfg(meshsweep_avx2)]
mod leaf_avx2;
mod leaf_corners;
#[cfg(meshsweep_wide)]
mod leaf_lanes;
mod moments;
mod triangle_bits;
mod units;
mod view;

pub use header::BvhHeader;
#[cfg(not(meshsweep_wide))]
pub use leaf::FullRing;
pub use leaf::{CORNERS, FanLeaf, GridRing, LeafShape, RING, lanes_of, slots};
#[cfg(meshsweep_wide)]
pub(crate) use leaf_lanes::LanePoint;
pub use moments::NodeMoments;
pub(crate) use units::{Units, at_least, at_most};
pub use view::{Bvh, BvhChild, Links};
