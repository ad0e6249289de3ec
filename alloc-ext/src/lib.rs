//! Builds `meshsweep` blobs from mesh files: progressive hulls, split tables, certified radii.
//!
//! ```text
//! mesh file ─ mesh::read ─ mesh::repair ─ precision::store ─ collapse ─ sweep ─ emit ─ blob
//! ```
//!
//! Each stage takes a value and returns a value and one invariant more; [`hull::build()`] runs
//! them. The kernels are `meshsweep-core`'s, so that builder and reader compute the same bits; the
//! core opens what was written before it is handed out.

pub mod bvh;
pub mod collapse;
pub mod counted;
pub mod cut;
pub mod emit;
pub mod hausdorff;
pub mod hull;
pub mod lp;
pub mod mesh;
pub mod surface;
pub mod tight;
pub mod tribox;

// Paths of before, until their users are moved.
pub use bvh as tree;
pub use bvh::fans as fan;
pub use surface as precision;

/// The names of [`tight`] under which the program and the tests use one hull.
pub mod wrap {
    pub use crate::tight::{
        Goal, Hull, HullStage as Stage, NoVolume, Options, Outcome, Progress, Report, Start,
        WrapError, parts, share, wrap, wrap_all,
    };
}
