//! One triangle surface for all builders: stored precision, connected components, compaction,
//! closing, volume.

mod closing;
mod compact;
mod components;
mod fronts;
mod precision;
mod solid;
mod valid;

pub(crate) use crate::mesh::{EdgeTable, SignedVolume, ends};
pub use closing::{Closed, close};
pub(crate) use compact::{compact, compact_in_order};
pub(crate) use components::{components, least_connected};
pub(crate) use fronts::{Defect, Fronts, most_crossings};
pub use precision::{Grid, Stored, VertexBits, snap, store};
pub(crate) use precision::{fitting_grid, scale_exponent, split_exponent};
pub(crate) use solid::Solid;
pub(crate) use valid::require_valid;
