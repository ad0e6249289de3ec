//! The box tree: an index of triangles that answers distances, segments and overlaps.
//!
//! | where | what lies there |
//! | --- | --- |
//! | `format/` | the bytes: header, nodes, leaves, the check of `Bvh::open` |
//! | `node/` | the node kernels: eight boxes at a time |
//! | `point_query`, `segment_query` | a point or segment in grid units, ready for the descent |
//! | `descent` | the descent of the distance questions |
//! | `leaf_distance`, `triangle_bounds` | a point and the triangles of a leaf |
//! | `closest_point`, `closest_points` | one closest point, many of them |
//! | `within`, `all_within`, `nearest`, `k_nearest` | distance verdicts, and the nearest triangles |
//! | `signed_distance`, `pseudonormal` | the side of a closed mesh |
//! | `segment_hits` | first hit, any hit, all hits |
//! | `front_facing` | triangles that may face an eye |
//! | `overlap/` | two trees, one of them moved |
//! | `coherent/` | a query that moves |

mod all_within;
mod closest_point;
mod closest_points;
mod coherent;
mod descent;
pub mod format;
mod front_facing;
mod k_nearest;
mod leaf_distance;
mod nearest;
pub mod node;
mod overlap;
mod point_query;
mod pseudonormal;
mod segment_hits;
mod segment_query;
mod side_search;
mod signed_distance;
mod triangle_bounds;
mod within;

pub use all_within::{AllWithin, all_within};
pub use closest_point::{Hint, closest_point, closest_point_from};
pub use closest_points::{BatchError, closest_points};
pub use coherent::{CoherentClosest, CoherentQuery};
pub use format::Bvh;
pub use front_facing::{FrontFacing, Sight, front_facing};
pub use k_nearest::Neighbor;
pub use nearest::{Nearest, nearest};
pub use overlap::{Overlap, Overlaps, PairEntry, TrianglePair, all_overlaps, overlap};
pub use segment_hits::{AnyHit, Facing, all_hits, any_hit, first_hit};
pub use side_search::Side;
pub use signed_distance::{SignedDistance, signed_distance};
pub use within::{Verdict, Within, is_within};
