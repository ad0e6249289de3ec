//! Certified bounds of the Hausdorff distance: how far the farthest point of one surface is from
//! another surface.
//!
//! Branch and bound. The distance to a surface is 1-Lipschitz, so a triangle is bounded from its
//! centre. The distance to one surface triangle is convex, so a triangle is also bounded from its
//! corners. The piece with the largest bound is cut, until that bound is close enough to a distance
//! that was found.
//!
//! A piece is cut in halves. A piece that is many times as large as it is far away is cut along an
//! edge of the surface triangle next to it. So a hull close to a flat wall is cut into the parts
//! over each of the wall's triangles.
//!
//! | file | owns |
//! | --- | --- |
//! | `cuts` | the size of a piece, and its parts |
//! | `farthest` | one side, to a few percent, for the builders |
//! | `between` | two meshes, to any precision, with the points that attain the distance |

mod between;
mod cuts;
mod farthest;

pub use between::{Attained, Direction, Hausdorff, Precision, hausdorff};
pub use farthest::{Farthest, Nearest, farthest, is_within, nearest_in};
