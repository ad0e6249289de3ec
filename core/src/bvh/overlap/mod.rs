//! Two box trees, one of them moved: whether their surfaces meet, and where.
//!
//! | file | owns |
//! | --- | --- |
//! | `query` | the two questions and their answers |
//! | `relative_pose` | both trees in one frame: six directions and the rounding along them |
//! | `axis_intervals` | the boxes of two nodes as intervals along these directions |
//! | `leaf_pair` | the triangles of two leaves |
//! | `descent` | the descent of both trees |

mod axis_intervals;
mod descent;
mod leaf_pair;
mod query;
mod relative_pose;

pub use query::{Overlap, Overlaps, TrianglePair};
