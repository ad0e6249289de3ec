//! Exact predicates on triangles, and a static tree that finds them.

mod bounds;
mod contact;
mod disks;
mod embedding;
mod enclosure;
mod enclosures;
mod face_tree;
mod inner;
mod lane_corners;
mod moving_boxes;
mod order;
mod predicates;
mod ray;
mod tree;

pub(crate) use bounds::{Bounds, Plane};
pub(crate) use contact::{Contact, crosses};
pub(crate) use embedding::{crosses_itself, faces, fits, is_embedded};
pub(crate) use enclosure::Enclosure;
pub(crate) use enclosures::Enclosures;
pub(crate) use face_tree::FaceTree;
pub(crate) use inner::inner_points;
pub(crate) use moving_boxes::MovingBoxes;
pub(crate) use order::spatial_order;
pub(crate) use predicates::{
    Face, Triangle, are_apart, is_cut_off, is_degenerate, meet, segment_meets, side,
};
pub(crate) use tree::{Frontier, StaticTree};
