//! Poses: which matrices are rotations, what rounding does to them, and how models move.
//!
//! | file | owns |
//! | --- | --- |
//! | `rotation` | which matrices are rotations, and how far one is from that |
//! | `rounded` | [`RoundedPose`]: poses of quaternions, products, inverses, and their rounding |
//! | `inverse` | the inverse of a matrix that is nearly a rotation, in f64 |
//! | `carried_point` | [`PosedPoint`]: a point in the frame of a moved model |
//! | `world_lengths` | distances in that frame, and those in the world |
//! | `common_units` | [`RelativePose`]: one model in the frame and the units of another |
//! | `joint` | [`Joint`], [`link_poses`]: where the links of a mechanism are |
//! | `motion` | [`Motion`]: how a model moves from pose to pose |
//!
//! Two models have a pose in these forms.
//!
//! | type | frame and unit | numbers | surface errors |
//! | --- | --- | --- | --- |
//! | `PlacedPair` (`bvh/pair`) | first model, input units; from two poses in the world | f32 | none; how world lengths differ |
//! | `FramePose` (`bvh/pair/separation`) | first model, input units | f32, and the error of its rounding | none |
//! | `GridPose` (`bvh/pair/separation`) | first grid, its units | f32, and the rounding of places | in `error`, not in `rounding` |
//! | [`VertexPose`] | common units, for vertices | f32 and f64, and the rounding of places | of both [`Extended`] |
//! | [`CommonPose`] | a [`VertexPose`], and whether f32 can hold its numbers | the same | the same |
//! | [`RelativePose`] | a [`VertexPose`], and one frame a model for boxes | the same | the same |
//! | `StoredPair` (`bvh/pair`) | two trees and their [`CommonPose`] | the same | none; their sum beside it |

mod carried_point;
mod common_units;
mod inverse;
mod joint;
mod motion;
mod rotation;
mod rounded;
mod world_lengths;

pub use carried_point::PosedPoint;
pub(crate) use common_units::{
    CommonPose, DIRECTIONS, Extended, ModelFrame, RelativePose, UNITS_APART, VertexPose,
};
pub(crate) use inverse::PoseInverse;
pub use joint::{Joint, JointAxis, JointKind, link_poses};
pub use motion::Motion;
pub(crate) use rotation::{
    check_rigid, checked_skew, is_rotation, is_turn, longest, skew, skew_of,
};
pub use rounded::RoundedPose;
pub(crate) use world_lengths::WorldLengths;
