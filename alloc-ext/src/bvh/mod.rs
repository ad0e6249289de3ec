//! The box tree: triangle fans, an 8-wide tree over them, quantised boxes, and their bytes.
//!
//! ```text
//! mesh ─ stored_triangles ─ store (grid) ─ packing ─ fans (leaves) ─ nodes (topology, boxes) ─ encode ─ sections
//! ```
//!
//! Any triangle soup will do. The mesh need not be closed or manifold.

mod batch;
mod build;
mod cones;
mod encode;
mod exact;
mod fans;
mod fast;
mod file_sides;
mod half_widths;
mod moments;
mod morton;
mod nodes;
mod packing;
mod sides;
mod source;
mod store;
mod stored_triangles;
mod unfold;

pub use batch::{BATCH, RefusedPoint, closest_points, closest_points_until_refused};
pub use build::{MAX_TRIANGLES, TreeOptions, TreeReport, WhyF32, build};
pub use encode::sections_of;
pub(crate) use exact::exact_blob_watched;
pub use exact::{blob_for, exact_blob};
pub use fast::FastBvh;
pub(crate) use file_sides::FileSides;
pub use half_widths::half_widths;
pub use packing::PackingReport;
pub use sides::{SideDefect, SidesReport};
pub use store::is_too_far_for_grid;
