//! Segments on the box tree against exact predicates on the input mesh.

mod aimed;
mod all_hits;
mod scene;
mod settled;
mod soup;
mod truth;
mod watertight;
