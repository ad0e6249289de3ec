//! The box tests: a point or a segment against the eight child boxes of a node at once. The boxes
//! of two trees are tested in `tree/axis_intervals.rs`.
//!
//! For points, the child boxes of a node share a frame: a rotation, an origin on the grid, a step
//! for each axis. A point is brought into the frame once for each node. Then the test is the plain
//! axis-aligned one, in integers. Segments have boxes of their own, which are axis-aligned.
//!
//! Along one axis of a frame, in key units:
//!
//! ```text
//! byte 0 ─────────── low ═══ high ─────────── 255     low planes count up from byte 0,
//!  first ──────────→ point ←────────────── last       high planes down from byte 255
//!
//! below  = low − first           > 0: the point lies before the box
//! beyond = (255 − high) − last   > 0: the point lies behind the box
//! ```
//!
//! At most one is positive. The sum of the squares over the axes is a lower bound of the squared
//! distance.
//!
//! | file | owns |
//! | --- | --- |
//! | `opened_node` | `OpenedNode`, whose children are tested; the wanted ones of them |
//! | `keys` | a child's bound with its number in the low bits; the target's vector flag, least key, places on the stack |
//! | `frame` | [`KeyPoint`], a point that is prepared for frames; units and rounding constants of the point test |
//! | `grid_line` | `GridLine`, a segment's line in integers, for targets without an FPU |
//! | `box_distances` | a point against eight boxes: the choice between `box_lanes` and `two_in_word` |
//! | `box_lanes` | a point against eight boxes, in vector registers, frame included |
//! | `box_avx2` | the same, and the least key, in registers of 256 bits |
//! | `axis_place` | a point along one axis of a frame, on targets without vector registers |
//! | `two_in_word` | a point against eight boxes, on targets without vector registers |
//! | `slab_ray` | [`SlabRay`], a segment prepared for the test |
//! | `slab_planes` | a segment against one box, on targets without vector registers |
//! | `box_entries` | a segment against eight boxes: the choice between the next two |
//! | `entry_lanes` | a segment against eight boxes, in vector registers |
//! | `entry_avx2` | the same in registers of 256 bits |
//! | `integer_entries` | a segment against eight boxes, on targets without an FPU |

#[cfg(any(test, not(meshsweep_wide)))]
mod axis_place;
#[cfg(meshsweep_avx2)]
mod box_avx2;
mod box_distances;
mod box_entries;
#[cfg(meshsweep_wide)]
mod box_lanes;
#[cfg(meshsweep_avx2)]
mod entry_avx2;
#[cfg(meshsweep_wide)]
mod entry_lanes;
mod frame;
#[cfg(any(all(test, meshsweep_wide), meshsweep_soft_float))]
mod grid_line;
#[cfg(any(all(test, meshsweep_wide), meshsweep_soft_float))]
mod integer_entries;
mod keys;
mod opened_node;
#[cfg(any(test, not(meshsweep_wide)))]
mod slab_planes;
mod slab_ray;
#[cfg(all(test, meshsweep_wide))]
mod tests;
#[cfg(any(test, not(meshsweep_wide)))]
mod two_in_word;

#[cfg(meshsweep_avx2)]
pub(crate) use box_avx2::{keys as box_distances_avx2, take_least as take_least_avx2};
pub use box_distances::box_distances;
#[cfg(not(meshsweep_wide))]
pub(crate) use box_distances::push_boxes;
pub use box_entries::box_entries;
#[cfg(not(meshsweep_wide))]
pub(crate) use box_entries::push_entries;
#[cfg(meshsweep_avx2)]
pub(crate) use entry_avx2::keys as box_entries_avx2;
pub use frame::KeyPoint;
#[cfg(meshsweep_soft_float)]
pub use grid_line::GridLine;
pub use keys::{CHILD_MASK, NO_CHILD, WIDE, in_memory, least_key};
#[cfg(meshsweep_wide)]
pub use keys::{TakenLeast, places_of_wanted, take_least};
pub(crate) use opened_node::OpenedNode;
#[cfg(not(meshsweep_wide))]
pub(crate) use opened_node::Pushed;
pub use slab_ray::SlabRay;
