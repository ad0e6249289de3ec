//! Kernels over triangle fans (Galin & Akkouche 2005, sections 3 and 4), scalar and eight lanes
//! wide. Both give the same bits.
//!
//! A *patch* is what one leaf of the box tree holds: up to [`WIDTH`] triangles in one fan, or in
//! two that share a ring vertex. Triangle `i` of a patch is `(centre, ring[i], ring[i + 1])`; its
//! centre is the first one below `turn`, the second from there on.

mod cone;
mod point;
mod point8;
mod ray;
mod ray8;

pub use cone::NormalCone;
pub use point::{Nearness, PointFan, SpokeTerms, lone_triangle, lower_bound, point_patch, refined};
pub use point8::{Edges8, LANES_BELOW, Nearness8, point_patch8};
pub use ray::{Crossing, FanRay, STILL, Shadow, ray_patch};
pub use ray8::{Ring8, ray_patch8};

/// Most triangles of a patch, and lanes of the wide kernels.
pub const WIDTH: usize = 8;
