//! Tables to bytes, through the constants of `meshsweep_core::blob::layout`, and back.

mod bytes;
mod cut;
mod tables;

pub use bytes::blob;
pub use cut::{CutError, cut};
pub use tables::{NodeRecord, SplitRecord, Tables};
