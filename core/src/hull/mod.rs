//! The hull hierarchy: nested outer hulls under split tables, and the cover tree over the surface.
//!
//! | where | what lies there |
//! | --- | --- |
//! | `format/` | the bytes: indices, tables, the check of opening |
//! | `refined_hull` | the hull refined where a query needs it |
//! | `hull_faces` | the triangles of one level |
//! | `closest_point` | closest point on the cover tree |
//! | `segment_hits` | first hit and all hits on the cover tree |
//! | `outer_hits` | hits from outside on the refined hull |

mod closest_point;
pub mod format;
mod hull_faces;
mod outer_hits;
mod refined_hull;
mod segment_hits;

pub use format::{Hull, Level};
pub use hull_faces::HullFace;
pub use outer_hits::{OuterHits, Search};
pub use refined_hull::{Face, RefinedHull};
