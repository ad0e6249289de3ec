//! Nodes of the box tree: which leaves they hold, and the boxes of their children.
//!
//! ```text
//! boxes of leaves ─ sah ─ collapse ─ order (Topology) ─ fit (NodeBoxes of every node)
//! ```
//!
//! | file | owns |
//! | --- | --- |
//! | `sah` | the binary tree, by surface area heuristic |
//! | `blocks` | the top of a large tree, by bins |
//! | `collapse` | its collapse into nodes of up to eight children |
//! | `order` | `Topology`: the order of nodes and leaves |
//! | `fit` | frames and boxes of all nodes, bottom-up |
//! | `subtree` | the points below a node |
//! | `extremes` | few points that stand for many in the search |
//! | `frame` | the search of a node's rotation |
//! | `rotation` | quaternions and principal axes |
//! | `extent` | extents in a frame |
//! | `boxes` | their rounding to 8 bits |

pub(super) mod blocks;
pub(super) mod boxes;
pub(super) mod collapse;
mod extent;
mod extremes;
pub(super) mod fit;
pub(super) mod frame;
pub(super) mod order;
mod rotation;
pub(super) mod sah;
mod subtree;
