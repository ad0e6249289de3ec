//! The hull hierarchy: nested outer hulls under split tables.
//!
//! | where | what lies there |
//! | --- | --- |
//! | `format/` | the bytes: indices, tables, the check of opening |
//! | `split_set` | the performed splits in fixed memory |
//! | `refined_hull` | the hull refined where a scene needs it: what may be performed and undone |
//! | `focus` | where a scene needs it |
//! | `refine` | how it follows a focus |
//! | `swept_mesh` | the mesh that a sweep ends with |
//! | `hull_faces` | the triangles of hulls |
//! | `geometry` | where a sweep's triangles lie: at rest, at a key frame, or moved |
//! | `front` | the front of the sweeping process: triangles that stand for the surface |
//! | `closest_point` | closest point by a sweep |
//! | `above` | a bound from above, before a triangle of the surface is reached |
//! | `nearest` | the nearest triangle so far, and the bounds of the distance |
//! | `shared_corner` | a corner that is the closest point of many triangles, on boards |
//! | `kept_sweep/` | a sweep that is interrupted, moved, or gives triangle after triangle |
//! | `frame_hull` | the hull between two key frames |
//! | `deformed_hits` | segments against a hull that deforms |
//! | `deformed_overlap` | whether a hull that deforms meets one at rest |
//! | `moved_hull` | the hull under any motion of the mesh's vertices |
//! | `segment_hits`, `ray_hits` | first hit and all hits of a segment, and of a ray, by a sweep |
//! | `overlap/` | a triangle, or another hull hierarchy, against the surface |
//! | `outer_hits` | hits from outside on the refined hull |

mod above;
mod closest_point;
mod deformed_hits;
mod deformed_overlap;
mod focus;
pub mod format;
mod frame_hull;
mod front;
mod geometry;
mod hull_faces;
mod kept_sweep;
mod moved_hull;
mod nearest;
mod outer_hits;
mod overlap;
mod ray_hits;
mod refine;
mod refined_hull;
mod segment_hits;
mod shared_corner;
mod split_set;
mod swept_mesh;

pub use focus::Focus;
pub use format::{DeformableHull, Hull, HullLevel};
pub use frame_hull::FrameHull;
pub use geometry::Geometry;
pub use hull_faces::HullFace;
pub use kept_sweep::Sweep;
pub use moved_hull::{MovedHull, MovedVertex};
pub use outer_hits::{OuterHits, OuterSearch};
pub use refine::{Refinement, SplitChange};
pub use refined_hull::{ErasedHull, RefinedHull};
pub use swept_mesh::SweptMesh;
