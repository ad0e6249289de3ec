//! The distance field: bounds of the distance from a point, by one look-up in a lattice or a tree.
//!
//! *Why a lattice.* A search costs thousands of instructions whatever the tolerance, for it has to
//! reach a triangle. A trilinear function of eight corners costs some hundred. Firmware that uses
//! one today has no bound of its error, or one bound for all of it, and then the worst cell
//! decides: a cell at a sharp edge or in a thin wall. Here each cell has an error of its own below
//! and one above. Both are in one byte: two numbers of four bits, each into a book of sixteen
//! errors. Beside a plain grid of as many bytes the mean interval is 11 times narrower about the
//! bracket and 3.7 times about the torus, at 16 KiB (`cargo xtask measure --field
//! fixtures/bracket.stl fixtures/torus.ply`).
//!
//! *Why a tree.* On machined parts the distance is a plane over long boxes and bends at few places.
//! A node halves any of the three axes at once, so its children are cubes, plates or rods. A leaf
//! has 40 bits: a plane, one curvature across it, and a width. On winding smooth shapes the lattice
//! is narrower, for cells share corners. The builder drafts both and keeps the narrower.
//!
//! *Cost of a tree.* An entry that a look-up reads takes 20 instructions of a Cortex-M4F. Mean and
//! most at random points of the field, by
//! `cargo xtask count --board "field field.msw" "units field.msw"` (the first row; the others are
//! *historical*: of an older builder's fields):
//!
//! | field | entries, mean | M4F: f32 | M4F: units | M0: f32 | M0: units |
//! | --- | --- | --- | --- | --- | --- |
//! | `bracket.stl`, tree of 16 KiB | 3.5 | 225 / 320 | 199 / 280 | 2,113 / 2,240 | 311 / 440 |
//! | `bracket.stl`, tree of 4 KiB | 2.7 | 208 / 280 | 182 / 240 | 2,083 / 2,200 | 281 / 360 |
//! | `torus.ply`, tree of 2 KiB | 2.5 | 205 / 240 | 180 / 200 | 2,086 / 2,200 | 277 / 320 |
//! | `bracket.stl`, lattice of 16 KiB | – | 180 / 200 | 135 / 160 | 2,040 / 2,120 | 232 / 240 |
//!
//! What made it cheaper, by a quarter in all (*historical*):
//! - The place of a child counts from its node. So the descent ends, and no step is counted.
//! - One jump leads to a case for each set of axes.
//! - Offsets lose four bits before they are squared, and one fewer for every two halvings. So the
//!   bend is shifted by 8 or 7.
//! - Bits of f32 are compared in place of signs and ends.
//!
//! *Lost*: the leaf's code in both the questions inside and beyond the field.
//!
//! *Units.* Points, distances and errors are whole numbers of one unit, a 2048th of a lattice's
//! cell or a 65,536th of a tree's root cell. So a processor without floating point needs no
//! conversion, and every number of a query fits 32 bits.
//!
//! *Kinds.* Forces need signed distances. A guard only needs that no point inside is called clear:
//! it takes the distance to the solid, which is 0 inside, and walls thinner than a cell do not
//! widen the interval. A mesh with holes has a distance without sign only.
//!
//! *Lost* (*historical*, by a prototype on four meshes). Octrees with one constant or two planes a
//! leaf: wider at the same bytes. Codes of sixteen bits: half as many cells, three times as wide.
//! Bricks of cells in a tree: corners are stored twice. Leaves of two planes, or of ten numbers
//! beside those of the tree: an eighth narrower for a second kernel.
//!
//! | where | what lies there |
//! | --- | --- |
//! | `format/` | the bytes: header, codes of the corners, errors of the cells, the check of opening |
//! | `place` | from a point to a cell and a place within it |
//! | `value` | the interval at a place of a lattice, in integers, and the gradient |
//! | `tree` | the same of a tree |
//! | `distance` | the questions in input units |
//! | `within` | whether the surface is within a distance |
//! | `units` | the questions in whole units, for processors without floating point |

mod distance;
pub mod format;
mod place;
mod tree;
mod units;
mod value;
mod within;

pub use distance::FieldDistance;
pub use format::{Sdf, SdfKind, SdfLayout};
pub use units::UnitDistance;
pub(crate) use within::Near;
