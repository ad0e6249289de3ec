//! Polygonal curves in 2-D and 3-D (Guéziec 2000, section 3): fences and tool paths.
//!
//! | where | what lies there |
//! | --- | --- |
//! | `format/` | the bytes: polylines, points, the hierarchy, the check of opening |
//! | `capsules` | bounds of runs of points, and distances of segments, for one query point |
//! | `descent` | the search that the next three share |
//! | `closest_point` | closest point, and how far the query may move |
//! | `within` | whether a curve is within a distance |
//! | `neighbors` | the nearest segments, and all within a distance |
//! | `kept_sweep` | a search that goes on after an interruption, or after its point has moved |
//! | `signed_distance` | whether a point is inside of a fence, and how far from its line |
//! | `zone_walk` | winding numbers of the polylines about a point, and what their zones allow |

mod capsules;
mod closest_point;
mod descent;
pub mod format;
mod kept_sweep;
mod neighbors;
mod signed_distance;
mod within;
mod zone_walk;

pub use closest_point::CurveClosest;
pub use format::{Curve, CurveSegment, Zone};
pub use kept_sweep::CurveSweep;
pub use neighbors::CurveNeighbor;
pub use signed_distance::CurveSignedDistance;
