//! The distance field: bounds of the distance from a point, by one look-up in a lattice.
//!
//! *Why a lattice.* A search costs thousands of instructions whatever the tolerance, for it has to
//! reach a triangle. A trilinear function of eight corners costs some hundred. Firmware that uses
//! one today has no bound of its error, or one bound for all of it, and then the worst cell decides:
//! a cell at a sharp edge or in a thin wall. Here each cell has an error of its own below and one
//! above. Both are in one byte: two numbers of four bits, each into a book of sixteen errors. The interval is 2.5 to 40 times narrower for
//! the same bytes (*historical*). `build` prints the mean width, and that of the widest cell, which a
//! plain lattice would have everywhere.
//!
//! *Units.* Points, distances and errors are whole numbers of one unit, a 2048th of a cell. So a
//! processor without floating point needs no conversion, and every number of a query fits 32 bits.
//!
//! *Kinds.* Forces need signed distances. A guard only needs that no point inside is called clear: it
//! takes the distance to the solid, which is 0 inside, and walls thinner than a cell do not widen the
//! interval. A mesh with holes has a distance without sign only.
//!
//! *Lost* (*historical*, by a prototype on four meshes). Octrees with one constant or two planes a
//! leaf: wider at the same bytes. Codes of sixteen bits: half as many cells, three times as wide.
//! Bricks of cells in a tree: corners are stored twice. A tree that halves any subset of the axes,
//! with a plane and a curvature a leaf, is narrower on machined parts, takes as many instructions,
//! and is not built yet.
//!
//! | where | what lies there |
//! | --- | --- |
//! | `format/` | the bytes: header, codes of the corners, errors of the cells, the check of opening |
//! | `place` | from a point to a cell and a place within it |
//! | `value` | the interval at a place, in integers, and the gradient |
//! | `distance` | the questions in input units |
//! | `units` | the questions in whole units, for processors without floating point |

mod distance;
pub mod format;
mod place;
mod units;
mod value;

pub use distance::FieldDistance;
pub use format::{Sdf, SdfKind};
pub use units::UnitDistance;
