//! The distance field: bounds of the distance from a point, by one look-up in a lattice.
//!
//! *Why a lattice.* A search costs thousands of instructions whatever the tolerance, for it has to
//! reach a triangle. A trilinear function of eight corners costs some hundred. Firmware that uses
//! one today has no bound of its error, or one bound for all of it, and then the worst cell decides:
//! a cell at a sharp edge or in a thin wall. Here each cell has errors of its own, one below and one
//! above, in one byte: numbers in two books of sixteen. The interval is 2.5 to 40 times narrower for
//! the same bytes (*historical*). `build` prints the mean width, and that of the widest cell, which a
//! plain lattice would have everywhere.
//!
//! *Units.* Points, distances and errors are whole numbers of one unit, a 2048th of a cell. So a
//! processor without floating point needs no conversion, and every number of a query fits 32 bits.
//!
//! *Kinds.* Signed distances are what forces need. A guard asks only that the inside is never clear:
//! the distance to the solid is 0 there, and a thin wall costs nothing. A mesh with holes has a
//! distance without sign.
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
