//! The hull hierarchy: nested outer hulls under split tables, and the cover tree over the surface.
//!
//! | where | what lies there |
//! | --- | --- |
//! | `format/` | the bytes: indices, tables, the check of opening |
//! | `split_set` | the performed splits in fixed memory |
//! | `refined_hull` | the hull refined where a scene needs it: what may be performed and undone |
//! | `focus` | where a scene needs it |
//! | `refine` | how it follows a focus |
//! | `hull_faces` | the triangles of hulls |
//! | `closest_point` | closest point on the cover tree |
//! | `segment_hits` | first hit and all hits on the cover tree |
//! | `outer_hits` | hits from outside on the refined hull |

mod closest_point;
mod focus;
pub mod format;
mod hull_faces;
mod outer_hits;
mod refine;
mod refined_hull;
mod segment_hits;
mod split_set;

pub use focus::Focus;
pub use format::{Hull, Level};
pub use hull_faces::HullFace;
pub use outer_hits::{OuterHits, Search};
pub use refine::{Change, Refinement};
pub use refined_hull::RefinedHull;
