//! The recipes of the guide, run unchanged. They name blobs as the `src/main.rs` of a crate beside
//! the clone does: two folders up, then `meshsweep/core/fixtures`. So this module is a folder, and
//! `host-tests/meshsweep/core/fixtures` is a link.

#![doc = include_str!("../../../core/docs/guide.md")]

/// Fewer scratch entries than a blob needs do not compile.
///
/// ```compile_fail,E0080
/// mod part {
///     include!("../../meshsweep/core/fixtures/groove.rs");
/// }
/// part::scratch::<{ part::SCRATCH_ENTRIES - 1 }>();
/// ```
mod too_little_scratch {}

/// The Rust of `README.md`, run unchanged too.
#[doc = include_str!("../../../README.md")]
mod readme {}
