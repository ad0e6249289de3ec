//! Builds `meshsweep` blobs from mesh files: progressive hulls, split tables, certified radii.
//!
//! ```text
//! mesh file ─ mesh::read ─ mesh::repair ─ precision::store ─ hull::build ─ sweep::cover ─ emit::emit ─ blob
//! ```
//!
//! Each stage takes a value and returns a value and one invariant more. The kernels are `meshsweep-core`'s, so that builder
//! and reader compute the same bits; the core opens what was written before it is handed out.

pub mod collapse;
pub mod lp;
pub mod mesh;
pub mod precision;
