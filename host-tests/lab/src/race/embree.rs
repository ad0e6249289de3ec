//! Embree: Intel's trees for ray casts, as Debian has them, in a child process of C++.
//!
//! Scenes are robust, so that no segment passes between two triangles, and of high quality, which
//! takes longer to build.

use std::sync::LazyLock;

use meshsweep_host_tests::workload::Subject;
use meshsweep_xtask::toolbox::Wanted;

use super::child::{Program, Source};
use super::child_engine::ChildEngine;
use super::engine::Engine;
use super::workload::Workload;

const SOURCE: Source = Source {
    wanted: Wanted {
        name: "embree",
        alternatives: &[&["libembree-dev"]],
        ignore_installed: &["libembree", "libtbb", "libhwloc"],
    },
    checkout: None,
    text: include_str!("embree.cpp"),
    headers: &[],
    options: &["-march=native", "-lembree3"],
};

/// Compiled once in a run.
static PROGRAM: LazyLock<Result<Program, String>> = LazyLock::new(|| Program::compile(&SOURCE));

/// Why Embree cannot take part on this machine, if it cannot.
pub fn missing() -> Option<String> {
    PROGRAM.as_ref().err().cloned()
}

/// On every mesh.
///
/// # Errors
/// The child's end.
pub fn build<'a>(subject: &Subject, _: &'a mut Vec<u8>) -> Result<Box<dyn Engine + 'a>, String> {
    ChildEngine::start(&PROGRAM, subject, &Workload::ALL)
}
