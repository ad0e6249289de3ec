//! What the fuzzers run, as plain functions: a driver test calls the same bodies with seeded bytes.
//!
//! Input bytes are edits of a valid blob, whose CRCs are then computed again, followed by the
//! queries' floats; those of [`mesh`](fn@mesh) are a mesh file. A blob that opens must be safe to
//! ask anything: no panic, and no more work than its tables have records.

mod curves;
mod deform;
mod hull;
mod input;
mod mesh;
mod tight;
mod tree;
mod tribox;
mod triboxes;
mod trusted;

pub use curves::{ask_curve, curve_seeds, curves};
pub use deform::{deform, deform_seeds};
pub use hull::{closest, open, outer, overlap, refine, seeds, segment};
pub use input::random_input;
pub use mesh::mesh;
pub use tight::{ask_tight, tight, tight_seeds};
pub use tree::{tree_closest, tree_coherent, tree_open, tree_overlap, tree_seeds, tree_segment};
pub use tribox::tribox;
pub use triboxes::{ask_triboxes, triboxes, triboxes_seeds};
pub use trusted::{tight_trusted, tree_trusted};
