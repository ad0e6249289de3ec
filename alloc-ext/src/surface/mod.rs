//! One triangle surface for all builders: stored precision, connected components, compaction,
//! closing, exact predicates, volume, enclosure, and one static tree for searches.

mod bounds;
mod closing;
mod compact;
mod components;
mod embedding;
mod enclosures;
mod lane_corners;
mod order;
mod precision;
mod predicates;
mod solid;
mod tree;
mod valid;

pub(crate) use crate::mesh::{EdgeTable, Enclosure, SignedVolume, ends};
pub(crate) use bounds::{Bounds, Plane};
pub use closing::{Closed, close};
pub(crate) use compact::{compact, compact_in_order};
pub use components::components_whose_boxes_meet;
pub(crate) use components::{components, least_connected};
pub(crate) use embedding::{crosses_itself, faces, is_embedded};
pub(crate) use enclosures::Enclosures;
pub(crate) use order::spatial_order;
pub use precision::{Grid, Stored, VertexBits, snap, store};
pub(crate) use precision::{fitting_grid, scale_exponent, split_exponent};
pub(crate) use predicates::{Face, Triangle, are_apart, is_cut_off, is_degenerate, meet, side};
pub(crate) use solid::Solid;
pub(crate) use tree::{Frontier, StaticTree};
pub(crate) use valid::require_valid;
