//! Overlap of two box trees against exact predicates on the input meshes.

mod extremes;
mod limits;
mod motions;
mod pairs;
mod touching;
mod truth;
