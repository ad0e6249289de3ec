//! Kernels over triangle fans (Galin & Akkouche 2005, sections 3 and 4), scalar and eight lanes
//! wide. Both give the same bits.
//!
//! One leaf of the box tree holds up to [`WIDTH`] triangles in one fan, or in two fans that share a
//! ring vertex. Triangle `i` of a leaf is `(centre, ring[i], ring[i + 1])`. Triangles below `turn`
//! have the first centre, triangles from `turn` on have the second.

mod cone;
mod integer;
mod integer_corner;
mod integer_limit;
mod integer_sharp;
mod integer_vector;
mod integer_weights;
mod lanes;
#[cfg(meshsweep_avx2)]
pub(crate) mod lanes_avx2;
#[cfg(meshsweep_wide)]
mod lanes_wide;
mod point;
#[cfg(meshsweep_wide)]
mod point8;
mod ray;
#[cfg(meshsweep_wide)]
mod ray8;

pub use cone::NormalCone;
pub use integer::{Corner, IntBounds, IntPoint, integer_bounds, is_in_front, vertex_bounds};
pub use integer_corner::{CornerWay, EdgeWay};
pub use integer_limit::{IntLimit, IntLower};
pub use integer_sharp::sharp_lower;
pub use integer_vector::{IntVector, less};
#[cfg(meshsweep_wide)]
pub use lanes::{LANES, Lanes, PIECES, lanes_below, least};
pub use lanes::{LANES_BELOW, WIDTH};
#[cfg(meshsweep_wide)]
pub use lanes_wide::{point_lanes, ray_lanes, ray_leaf8};
pub(crate) use point::is_integer;
pub use point::{
    ABOVE_ZERO, Nearness, PointFan, SpokeTerms, lone_triangle, lower_bound, lower_bound_up_to,
    point_leaf, refined,
};
#[cfg(meshsweep_wide)]
pub use point8::{Edges, LaneNearness};
pub use ray::{Crossing, FanRay, Shadow, ShadowPlane, may_meet, ray_leaf};
#[cfg(meshsweep_wide)]
pub use ray8::{CentreShadows, Ring8, RingLanes, ShadowLanes};
