//! Embree: Intel's trees for ray casts, as Debian has them, in a child process of C++.
//!
//! Scenes are robust, so that no segment passes between two triangles, and of high quality, which
//! takes longer to build.

use std::sync::LazyLock;

use meshsweep_xtask::toolbox::Wanted;

use super::child::{Program, Source};

const SOURCE: Source = Source {
    wanted: Wanted {
        name: "embree",
        alternatives: &[&["libembree-dev"]],
        ignore_installed: &["libembree", "libtbb", "libhwloc"],
    },
    text: include_str!("embree.cpp"),
    headers: &[],
    options: &["-march=native", "-lembree3"],
};

/// Compiled once in a run.
pub static PROGRAM: LazyLock<Result<Program, String>> = LazyLock::new(|| Program::compile(&SOURCE));
