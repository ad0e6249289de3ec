//! The distance field: a lattice of distances, or a tree of functions, and for each cell errors
//! that are proved.
//!
//! ```text
//! domain    cells and units, from a number of bytes
//! facet     a triangle: its closest point, and bounds of its distance
//! region    the triangles that can be nearest in a box
//! truth     distances and sides
//! samples   distances at places in each cell
//! function  the function of a cell
//! codes     the lattice: rounded distances, moved until cells are narrow
//! bound     bounds of distance less function in a box
//! prove     a cell's errors, by branch and bound
//! books     books of errors or widths
//! encode    the section's bytes of a lattice
//! widths    mean and largest width of intervals
//! allowed   the width that intervals may have at most
//! tree      the stages of the other layout
//! options   how to build a field
//! field     the stages of a field, and its report
//! fewest    the field of the fewest bytes for a largest width
//! build     which field is kept
//! ```
//!
//! *Where errors come from.* Samples tell the errors that a cell needs about. The books are made of
//! them, with a little slack. Then the errors of the books are proved: rounding up to a book gives
//! most cells more slack, which makes the proof short. A cell of a lattice whose proof fails takes
//! the next entry that holds what it needs. A leaf is lowered by whole codes and gets the width
//! that it needs, and the book of widths is made again. Nothing relies on samples.
//!
//! *One proof.* Both layouts are drafted, and the narrower draft is proved: a proof takes about
//! half of the time. It widens the mean, in small fields by much. So the other draft is proved too if
//! the proved field is wider than it by more than a twentieth. With this and with groups of
//! triangles (`region`), a field of 16 KiB of the horse takes 0.55 of the processors' time that it
//! took (*historical*).
//!
//! *Rounding.* All is computed in a frame whose unit is the field's. Lengths are below 2^20 there,
//! so one margin (`region::MARGIN`) in that unit is enough for every mesh.

mod allowed;
mod books;
mod bound;
mod build;
mod codes;
mod domain;
mod encode;
mod facet;
mod fewest;
mod field;
mod function;
mod options;
mod prove;
mod region;
mod samples;
mod tree;
mod truth;
mod widths;

pub use build::build;
pub use field::SdfReport;
pub use meshsweep_core::{SdfKind, SdfLayout};
pub use options::{BYTES, SdfOptions};
