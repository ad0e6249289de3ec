//! FCPW: the fastest closest points in the West (Sawhney 2021), as PyPI has it, in a child process
//! of Python.
//!
//! Version 1.1.4 is the last whose wheel for Linux has FCPW's vectorised tree: `fcpw::Mbvh` of
//! eight lanes, compiled for AVX2 and FMA (`objdump -d` shows `ymm` registers and `vfmadd`). The
//! wheels of 1.1.5, 1.1.7, 1.1.9 and 1.2.0 hold the binary tree alone, in scalar SSE2: `build`
//! ignores `vectorize`, and closest points take two and a half times as long.

use std::sync::LazyLock;

use super::child::Program;

/// Fetched once, and set up once in a run.
pub static PROGRAM: LazyLock<Result<Program, String>> = LazyLock::new(|| {
    Program::python("fcpw", &["fcpw==1.1.4", "numpy==2.2.6"], include_str!("fcpw.py"))
});
