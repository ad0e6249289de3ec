//! A chain of tight hulls for a blob: each usable alone, with a box tree of its own and certified
//! distances both ways between it and the mesh.
//!
//! ```text
//! mesh ─ wrap, for each number of faces ─ distances ─ tree::build ─ section
//! ```
//! Hulls of a chain are made of the mesh, each as tight as it can be, and need not enclose each
//! other. A nested chain wraps each hull around the next finer one: from coarse to fine every hull
//! encloses all that follow, at a price in volume, which [`HullReport::free_void`] tells.

mod chain;
mod distances;
mod store;

pub use chain::{ChainOptions, HullReport, MAX_HULLS, Stage, chain};
pub use distances::{Distances, distances};
pub use store::{TightTables, cut, hull_mesh};
