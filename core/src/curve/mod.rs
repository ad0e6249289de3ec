//! Polygonal curves in 2-D and 3-D (Guéziec 2000, section 3): fences and tool paths.
//!
//! | where | what lies there |
//! | --- | --- |
//! | `format/` | the bytes: polylines, points, the hierarchy, the check of opening |
//! | `capsules` | bounds of runs of points, and distances of segments, for one query point |
//! | `closest_point` | closest point, and how far the query may move |
//! | `within` | whether a curve is within a distance |

mod capsules;
mod closest_point;
pub mod format;
mod within;

pub use closest_point::CurveClosest;
pub use format::{Curve, CurveSegment};
