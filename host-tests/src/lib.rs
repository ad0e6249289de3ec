//! Oracles, generators and corrupters that the tests, the laboratory and the fuzz targets share.

pub mod blobs;
pub mod c_answers;
pub mod corrupt;
pub mod counted;
pub mod fuzz_targets;
pub mod generate;
pub mod golden;
#[cfg(doctest)]
mod guide;
pub mod motion;
pub mod oracle;
pub mod picture;
pub mod scene;
pub mod workload;

/// Whether all is optimised, as `cargo test --release` has it: tests may draw more.
pub const IS_RELEASE: bool = !cfg!(debug_assertions);
