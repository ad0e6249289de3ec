//! Tables to bytes, through the constants of `meshsweep_core::internal::format::layout`, and back.

mod bytes;
mod cut;
mod tables;

pub use bytes::{Parts, assemble, blob};
pub use cut::{CutError, Keep, cut, cut_blob};
pub use tables::{NodeRecord, SplitRecord, Tables};
