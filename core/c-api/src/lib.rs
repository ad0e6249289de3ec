//! The C interface of `meshsweep-core`: `include/meshsweep.h`, which documents each function.
//!
//! | file | owns |
//! | --- | --- |
//! | `memory` | the caller's pointers, and every `unsafe` block |
//! | `error` | negative numbers and their texts |
//! | `question`, `answer` | structures of the header |
//! | `ask` | the questions' common part, and the macro of their rows |
//! | `tree`, `pair`, `scene`, `triboxes`, `tight`, `curve`, `sdf`, `both`, `pose` | the functions |
//! | `hull`, `sweep`, `deform` | those of hull hierarchies, of sweeps, of meshes that deform |
//!
//! This crate has no panic handler, so that the workspace builds and tests it like the others.
//! `host-tests/firmware/c-library` makes the static libraries of it, with the boards' profiles.

#![no_std]

pub mod answer;
mod ask;
pub mod both;
pub mod curve;
pub mod deform;
pub mod error;
pub mod hull;
pub mod memory;
pub mod pair;
pub mod pose;
pub mod question;
pub mod scene;
pub mod sdf;
pub mod sweep;
pub mod tight;
pub mod tree;
pub mod triboxes;

use core::ffi::c_char;

use meshsweep_core::SectionKind;
use meshsweep_core::internal::format::layout::VERSION_MAJOR;

use crate::error::Error;

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_strerror(code: i32) -> *const c_char {
    Error::text(code).as_ptr()
}

/// A number of a version.
const fn number(text: &str) -> u32 {
    match u32::from_str_radix(text, 10) {
        Ok(number) => number,
        Err(_) => panic!("a version in digits"),
    }
}

/// `MSW_VERSION`.
pub const VERSION: u32 = number(env!("CARGO_PKG_VERSION_MAJOR")) << 16
    | number(env!("CARGO_PKG_VERSION_MINOR")) << 8
    | number(env!("CARGO_PKG_VERSION_PATCH"));

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_version() -> u32 {
    VERSION
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_format_version() -> u32 {
    u32::from(VERSION_MAJOR) << 16 | u32::from(SectionKind::newest_minor())
}
