//! Whether two models are within a distance, and which triangles may be the nearest, in f32.
//! `gaps/` measures these candidates in f64, and searches again from the roots if f32 gives no
//! verdict.
//!
//! A pair of nodes, leaves or triangles is left out if a gap along some direction is longer than
//! the limit. One direction is kept from pair to pair: along it most of the next pairs are apart
//! too. The first direction is that of the gap of both models' boxes. Each pair of leaves that is
//! apart gives a new one. Two points of two triangles prove that models are near. Derivation:
//! `core/docs/rounding.md` §26.
//!
//! | file | owns |
//! | --- | --- |
//! | `grid_pose` | two models in the grid of the first one, and what rounding does to it |
//! | `between_boxes` | the first direction |
//! | `node_boxes` | the boxes of a node's children: along the direction, and along the axes |
//! | `pending` | pairs that wait, in the caller's scratch memory |
//! | `leaf_hulls` | the hulls of two leaves, and their triangles |
//! | `goal` | what a search wants of pairs of triangles |
//! | `by_heights` | the nearest leaves, one tree at a time |
//! | `search` | the descent of both trees |

mod between_boxes;
mod by_heights;
mod goal;
pub(crate) mod grid_pose;
mod leaf_hulls;
mod node_boxes;
mod pending;
pub(crate) mod search;
