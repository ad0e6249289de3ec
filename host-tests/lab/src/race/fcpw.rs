//! FCPW: the fastest closest points in the West (Sawhney 2021), with its vectors, in a child
//! process of C++.
//!
//! No package has its vectorised code. `MESHSWEEP_FCPW` names a folder with FCPW's sources:
//!
//! ```text
//! git clone --recursive https://github.com/rohan-sawhney/fcpw
//! MESHSWEEP_FCPW=$PWD/fcpw cargo xtask race MESH
//! ```
//!
//! The numbers of a race with it are not those of this repository's tables, for no machine of the
//! project has it.

use std::sync::LazyLock;

use meshsweep_host_tests::workload::Subject;
use meshsweep_xtask::toolbox::Wanted;

use super::child::{Checkout, Program, Source};
use super::child_engine::ChildEngine;
use super::engine::Engine;
use super::workload::Workload;

const SOURCE: Source = Source {
    wanted: Wanted {
        name: "fcpw",
        alternatives: &[&["libeigen3-dev"]],
        ignore_installed: &["libeigen3"],
    },
    checkout: Some(Checkout {
        variable: "MESHSWEEP_FCPW",
        headers: &["include", "deps/enoki/include"],
    }),
    text: include_str!("fcpw.cpp"),
    headers: &["eigen3"],
    options: &["-march=native", "-pthread", "-DFCPW_USE_ENOKI", "-DFCPW_SIMD_WIDTH=8"],
};

/// Compiled once in a run.
static PROGRAM: LazyLock<Result<Program, String>> = LazyLock::new(|| Program::compile(&SOURCE));

/// Why FCPW cannot take part on this machine, if it cannot.
pub fn missing() -> Option<String> {
    PROGRAM.as_ref().err().cloned()
}

/// On every mesh.
///
/// # Errors
/// The child's end.
pub fn build<'a>(subject: &Subject, _: &'a mut Vec<u8>) -> Result<Box<dyn Engine + 'a>, String> {
    use Workload::{Far, Field, Near, Orbit, Path};
    ChildEngine::start(&PROGRAM, subject, &[Far, Near, Path, Orbit, Field])
}
