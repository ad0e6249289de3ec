//! The bytes of the box tree.
//!
//! | file | owns |
//! | --- | --- |
//! | `layout` | sizes and limits of the sections |
//! | `header` | the tree's own header |
//! | `view` | [`Bvh`]: nodes, links, boxes and source numbers where they lie |
//! | `units` | grid units and input units |
//! | `leaf` | [`FanLeaf`]: one or two fans where they lie |
//! | `leaf_shape` | [`LeafShape`]: the byte that says how many vertices and triangles a leaf has |
//! | `grid_ring` | [`GridRing`]: the stored integers of a leaf on the grid |
//! | `leaf_corners` | which triangles of a leaf have a corner at a place |
//! | `leaf_lanes` | a leaf's fans a register at a time, on vector targets |
//! | `leaf_avx2` | the same in registers of 256 bits |
//! | `cone` | the bytes of a leaf's normal cone |
//! | `moments` | the bytes of a node's moments |
//! | `triangle_bits` | a bit for each triangle: whether it is turned for sides, or tells none |
//! | `check` | the check of `Bvh::open` |

mod check;
mod cone;
mod grid_ring;
mod header;
pub mod layout;
mod leaf;
#[cfg(meshsweep_avx2)]
mod leaf_avx2;
mod leaf_corners;
#[cfg(meshsweep_wide)]
mod leaf_lanes;
mod leaf_shape;
mod moments;
mod triangle_bits;
mod units;
mod view;

#[cfg(not(meshsweep_wide))]
pub use grid_ring::FullRing;
pub use grid_ring::GridRing;
pub use header::BvhHeader;
pub use leaf::{CORNERS, FanLeaf, RING, lanes_of, slots};
#[cfg(meshsweep_wide)]
pub(crate) use leaf_lanes::LanePoint;
pub use leaf_shape::LeafShape;
pub use moments::NodeMoments;
pub(crate) use units::{Units, at_least, at_most};
pub use view::{Bvh, BvhChild, Links};
