//! Closed-form kernels. They know vectors and nothing of blobs, so the builder calls the very same
//! code.

mod boxes;
mod lanes;
mod point_triangle;
mod segment_triangle;
mod swept_triangle;
mod triangle_pair;

pub use boxes::{Aabb, Clipped};
pub use lanes::{LANES, Lanes};
pub use point_triangle::{PointTriangle, point_triangle};
pub use segment_triangle::{SegmentTriangle, comes_within, segment_triangle};
pub use swept_triangle::{PointProbe, SegmentProbe, Support, direction_bound};
pub use triangle_pair::{
    Contact, Real, determinant_margin, straddling_triangles_meet, triangles_meet,
};
