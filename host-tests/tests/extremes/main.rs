//! Meshes and points where floating point is at its worst, on every structure, and points of
//! triangles without area, which no structure's answer forgets. The oracle is exact.

mod checks;
#[macro_use]
mod named;
mod bounds;
mod hulls;
mod invariance;
mod large;
mod no_area;
mod scene;
mod tree;
