//! Slow, exact answers that share no code with what they check.

mod between;
mod distance;
mod double;
pub mod exact;
pub mod field;
pub mod lp;
pub mod moved;
pub mod placed;
mod polyline;
pub mod polytope;
pub mod replayed;
mod segment;
mod wide;
mod winding;
mod written;

pub use between::{distance_of_meshes, distance_of_moved_triangles, distance_of_placed};
pub use distance::{
    Bounded, distance_to_mesh, distance_to_moved_mesh, distance_to_triangle, rough_distance_sq,
    wide_distance_sq,
};
pub use double::{Double, Vector};
pub use polyline::{distance_to_segments, winding_about};
pub use segment::{Contact, contacts, gap_to_triangle, meets};
pub use wide::distance_to_wide_mesh;
pub use winding::winding_number;
pub use written::Around;
