//! A chain of tight hulls for a blob. Each hull is usable alone: it has a box tree of its own and
//! certified distances both ways between it and the mesh.
//!
//! ```text
//! mesh ─ wrap, for each number of faces ─ distances ─ bvh::build ─ section
//! ```
//!
//! | file | what lies there |
//! | --- | --- |
//! | `chain.rs` | options, wraps the mesh for each number of faces, report |
//! | `distances.rs` | certified distances between a hull and the mesh |
//! | `section.rs` | the bytes: writing, cutting, reading a hull back |
//!
//! Every hull of a chain is made from the mesh, as tight as possible, and need not enclose the
//! others.

mod chain;
mod distances;
mod section;

pub use chain::{ChainOptions, HullReport, MAX_HULLS, build};
pub use distances::{Distances, distances};
pub use section::{cut, hull_mesh};
