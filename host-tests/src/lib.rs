//! Oracles, generators and corrupters that the tests, the laboratory and the fuzz targets share.

pub mod blobs;
pub mod check;
pub mod corrupt;
pub mod counted;
pub mod fuzz_targets;
pub mod generate;
pub mod golden;
pub mod oracle;
pub mod picture;
pub mod scene;
pub mod workload;

/// The Rust of `README.md`, run unchanged. Its path of a fixture starts in this folder, which is
/// why `fixtures` is a link here.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
mod readme {}

/// The recipes of the guide.
#[cfg(doctest)]
#[doc = include_str!("../../core/docs/guide.md")]
mod guide {}
