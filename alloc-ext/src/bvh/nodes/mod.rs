//! Nodes of the box tree: which leaves they hold, and the boxes of their children.

pub(super) mod boxes;
pub(super) mod collapse;
mod extent;
mod extremes;
pub(super) mod fit;
pub(super) mod frame;
pub(super) mod order;
mod rotation;
mod sah;
mod subtree;
