//! CGAL's Hausdorff distance with a bounded error, as Debian has it, in a child process of C++.
//!
//! Its search is that of Tang, Lee and Kim, *Interactive Hausdorff distance computation for general
//! polygonal models* (2009).

use std::sync::LazyLock;

use meshsweep_host_tests::workload::Subject;
use meshsweep_xtask::toolbox::Wanted;

use super::side::Side;
use crate::race::child::{Child, Program, Source};

const SOURCE: Source = Source {
    wanted: Wanted {
        name: "cgal",
        alternatives: &[&["libcgal-dev"]],
        ignore_installed: &["libcgal", "libboost", "libgmp", "libmpfr"],
    },
    text: include_str!("cgal.cpp"),
    headers: &[],
    options: &["-march=native", "-lgmp", "-lmpfr"],
};

/// Compiled once in a run.
static PROGRAM: LazyLock<Result<Program, String>> = LazyLock::new(|| Program::compile(&SOURCE));

/// CGAL with two meshes.
pub struct Cgal(Child);

impl Cgal {
    /// Takes over the meshes.
    ///
    /// # Errors
    /// No compiler, no package, or a mesh that is no manifold.
    pub fn new(meshes: &[Subject; 2]) -> Result<Self, String> {
        let mut child = PROGRAM.as_ref().map_err(Clone::clone)?.start()?;
        let mut taken = meshes.iter().try_for_each(|subject| child.send_mesh(&subject.mesh));
        taken = taken.and_then(|()| child.whole().map(drop));
        taken.map_err(|reason| format!("it takes manifolds only: {reason}"))?;
        Ok(Self(child))
    }

    /// The distance, off by at most `error`, and the seconds that it took.
    ///
    /// # Errors
    /// The child ended.
    pub fn distance(&mut self, side: Side, error: f64) -> Result<(f64, f64), String> {
        self.0.send_question(side as u32, 1)?;
        self.0.send(error.to_ne_bytes().into_iter())?;
        let seconds = self.0.double()?;
        Ok((self.0.double()?, seconds))
    }
}
