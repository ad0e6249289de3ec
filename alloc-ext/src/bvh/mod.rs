//! The box tree: triangle fans, an 8-wide tree over them, quantised boxes, and their bytes.
//!
//! ```text
//! mesh ─ stored_triangles ─ store (grid) ─ packing ─ fans (leaves) ─ nodes (topology, boxes) ─ encode ─ sections
//! ```
//!
//! Any triangle soup will do. The mesh need not be closed or manifold.
//!
//! **Lost:** candidate lists, an octree whose cells name the triangles that can be closest to a
//! point of them. They were to take a third of the tree's instructions at 30 bytes a triangle. A
//! trial without bounds of rounding and without checks of bytes had, on a Cortex-M4F, far / near /
//! along a path:
//!
//! | mesh | box tree | candidate lists | bytes a triangle |
//! | --- | --- | --- | --- |
//! | bracket, 1,948 triangles | 9,685 / 9,963 / 10,769 | 5,924 / 4,618 / 10,360 | 14; 65 |
//! | rocker arm, simplified to 2,500 | 8,702 / – / – | 2,767 / 1,754 / 3,193 | 13; 60 |
//!
//! The tree's numbers are those of `bracket_tree` in `host-tests/costs.txt`, and of `cargo xtask
//! count --board "bvh BLOB 0"`. The lists' are means of 200 questions, with 28 bytes a triangle for
//! corners and planes.

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
