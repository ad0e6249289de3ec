//! Segments on the box tree against exact predicates on the input mesh.

mod aimed;
mod all_hits;
mod rays;
pub mod scenes;
mod settled;
mod soups;
mod truth;
mod watertight;
