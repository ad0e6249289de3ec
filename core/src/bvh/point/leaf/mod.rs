//! A point and the triangles of a leaf.
//!
//! | file | owns |
//! | --- | --- |
//! | `distance` | the nearest triangle of a leaf |
//! | `nearest` | what a leaf tells: its nearest triangle, and those to be refined |
//! | `limit` | what limits the triangles that a question looks at |
//! | `bounds` | lower bounds of a triangle's distance, slivers |
//! | `plane` | without vectors: a plane behind which no triangle counts |
//! | `plain_side` | which side of a triangle f32 shows plainly |
//! | `integer` | without floating point: a leaf in integers, f32 only for what may be the nearest |
//! | `squares` | without floating point: distances of triangles that are looked at again |

pub(in crate::bvh) mod bounds;
pub(in crate::bvh) mod distance;
#[cfg(not(meshsweep_wide))]
pub(in crate::bvh) mod integer;
pub(in crate::bvh) mod limit;
pub(in crate::bvh) mod nearest;
pub(in crate::bvh) mod plain_side;
pub(in crate::bvh) mod plane;
pub(in crate::bvh) mod squares;
