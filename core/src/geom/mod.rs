//! Closed-form kernels. They know vectors and no bytes. The builder calls the same code.

mod boxes;
mod convex_gap;
pub mod fan;
mod hull_gap;
mod lanes;
mod point_segment;
mod point_triangle;
mod pose;
mod real_vector;
mod rows;
mod segment_triangle;
mod solid_angle;
mod support;
mod swept_pair;
mod swept_triangle;
mod triangle_distance;
mod triangle_pair;
mod vector;

pub use boxes::{Aabb, Clipped};
pub use convex_gap::{ConvexGap, convex_gap};
pub use hull_gap::{GapLimits, HullGap, hull_gap, triangle_gap};
pub use lanes::{LANES, Lanes};
pub use point_segment::{CapsulePoint, PointSegment, point_segment};
pub use point_triangle::{PointTriangle, point_triangle};
pub use pose::Pose;
pub(crate) use real_vector::RealVector;
pub(crate) use rows::{Rows, columns, turned};
pub use segment_triangle::{SegmentTriangle, comes_within, segment_triangle, way_triangle};
pub use solid_angle::{SeenCorner, SolidAngles};
pub use support::Support;
pub use swept_pair::SweptTriangle;
pub use swept_triangle::{SweptPoint, SweptSegment, direction_bound};
pub use triangle_distance::{TriangleDistance, crossing, triangle_distance};
pub use triangle_pair::{Contact, determinant_margin, straddling_triangles_meet, triangles_meet};
pub use vector::Precision;
pub(crate) use vector::{Point, cross, dot, minus, norm_1, transposed};
