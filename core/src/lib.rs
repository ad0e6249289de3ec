//! Geometric questions about triangle meshes, answered from a binary blob where it lies: no heap,
//! no recursion, no panic.
//!
//! A host tool (`meshsweep`) turns a mesh into a blob; [`Model::open`] checks every byte of
//! it once; the functions of [`query`] then answer with intervals that contain the true distance to
//! the input mesh in real arithmetic.
//!
//! ```
//! use meshsweep_core::{Bvh, query::{Budget, tree::{ScratchEntry, closest_point}}};
//! # fn probe(blob: &[u8]) -> Result<(), Box<dyn core::error::Error>> {
//! let tree = Bvh::open(blob)?;
//! let mut stack = [ScratchEntry::EMPTY; 64]; // `tree.header().stack_entries` says what this mesh needs
//! let answer = closest_point(&tree, [0.1, 0.2, 0.3], &Budget::EXACT, &mut stack)?;
//! assert!(answer.lower <= answer.upper);
//! # Ok(()) }
//! ```
//!
//! # Layers
//! Each layer may use those to its left and no other: `num` ← `geom` ← `fan` ← {`tree`, `refine`} ←
//! `query`, with `blob` under the last three. `geom` and `fan` know no bytes; of geometry `blob`
//! knows the box and how lanes of a fan lie side by side.
//!
//! | folder | owns |
//! | --- | --- |
//! | [`num`] | directed rounding, stored radii, every tolerance with its derivation |
//! | [`geom`] | closed-form kernels: point–triangle, segment–triangle, swept triangle |
//! | [`fan`] | point–fan and ray–fan kernels, scalar and eight lanes wide; normal cones |
//! | [`blob`] | the format: header, sections, checked views; the only place that reads bytes |
//! | [`tree`] | the box tree: eight boxes at a time |
//! | [`tribox`] | bounds of eighteen planes: closure, boundary, reach |
//! | [`refine`] | split tables: the selectively refined hull, the faces of a level |
//! | [`query`] | one file per question; stop rules, intervals, work counters |
//!
//! # The same bits everywhere
//! Only `+ − × ÷ √` and comparisons, in one written order, never fused. The square root is
//! `libm`'s, which is correctly rounded on every target; the box tree's is [`num::sqrt_approx`]. The same
//! blob and query give the same bits on a workstation and on a Cortex-M0.

#![no_std]
#![forbid(unsafe_code)]

pub mod blob;
mod bvh;
mod format;
pub mod geom;
mod hull;
pub mod num;
pub mod query;
#[doc(hidden)]
pub mod tight;
pub mod tribox;

// Old paths, until the callers have moved.
#[doc(hidden)]
pub mod fan {
    pub use crate::geom::fan::*;
    pub use crate::num::tolerance::STILL;
}
#[doc(hidden)]
pub mod tree {
    pub use crate::bvh::node::*;
}
#[doc(hidden)]
pub mod refine {
    pub use crate::hull::{Face, HullFace, Refined, RefinedHull, hull_faces};
}

pub use bvh::Bvh;
pub use format::OpenError;
pub use hull::{Model, QueueEntry};
pub use query::QueryError;
pub use tight::{TightHull, TightHulls};
pub use tribox::Triboxes;
