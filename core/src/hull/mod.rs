//! The hull hierarchy: nested outer hulls under split tables.
//!
//! | where | what lies there |
//! | --- | --- |
//! | `format/` | the bytes: indices, tables, the check of opening |
//! | `refined_hull` | the hull refined where a query needs it |
//! | `hull_faces` | the triangles of one level |
//! | `sweep` | the front of the sweeping process |
//! | `sweep_queue` | its triangles that wait |
//! | `closest_point` | closest point by a sweep |
//! | `kept_sweep` | a sweep that is interrupted, moved, or gives triangle after triangle |
//! | `segment_hits` | first hit and all hits by a sweep |
//! | `outer_hits` | hits from outside on the refined hull |

mod closest_point;
pub mod format;
mod hull_faces;
mod kept_sweep;
mod outer_hits;
mod refined_hull;
mod segment_hits;
mod sweep;
mod sweep_queue;

pub use format::{Hull, Level};
pub use hull_faces::HullFace;
pub use kept_sweep::Sweep;
pub use outer_hits::{OuterHits, Search};
pub use refined_hull::{Face, RefinedHull};
