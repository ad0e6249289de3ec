//! Overlap of two box trees against exact predicates on the input meshes.

mod extremes;
mod limits;
mod pairs;
mod scene;
mod touching;
mod truth;
