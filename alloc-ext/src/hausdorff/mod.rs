//! Certified bounds of the Hausdorff distance: how far the farthest point of one surface is from
//! another surface.
//!
//! Branch and bound. The distance to a surface is 1-Lipschitz, so a triangle is bounded from its
//! centre. The distance to one surface triangle is convex, so a triangle is also bounded from its
//! corners. The piece with the largest bound is cut, until that bound is close enough to a distance
//! that was found.
//!
//! A piece is cut in halves. A piece that is many times as large as it is far away is cut along an
//! edge of the surface triangle next to it. Near a flat wall the Lipschitz bound needs pieces no
//! larger than the gap. Over one wall triangle the convex bound is exact.
//!
//! Vertices are read as f32. The interval includes that rounding of both meshes, so no distance is
//! known better. The search ends where it could only bound the rounding more closely.
//!
//! | file | owns |
//! | --- | --- |
//! | `piece` | a part of a triangle: its bound, and its parts |
//! | `farthest` | one side, to a few percent, for the builders |
//! | `profile` | mean and quantiles over the area, and the distance of each vertex |
//! | `surface` | a mesh with its box tree: the distance of a point, in f64 |
//! | `two_meshes` | two meshes, to any precision, with the points that attain the distance |

mod farthest;
mod piece;
mod profile;
mod surface;
mod two_meshes;

pub use farthest::{Farthest, Nearest, farthest, farthest_of_many, is_within, nearest_in};
pub use profile::{Profile, profile};
pub use two_meshes::{Attained, Direction, Ended, Hausdorff, Precision, Refused, hausdorff};
