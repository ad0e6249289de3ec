//! FCL, as Debian has it, in a child process of C++: it stands for its successor coal, which this
//! release of Debian lacks.

use std::sync::LazyLock;

use meshsweep_host_tests::workload::Subject;
use meshsweep_xtask::toolbox::Wanted;

use super::motions::Case;
use super::question::{Answer, Question, Run};
use crate::race::child::{Child, Program, Source};

/// Not for this processor alone: Eigen's types in the library have the alignment of plain x86-64.
const SOURCE: Source = Source {
    wanted: Wanted {
        name: "fcl",
        alternatives: &[&["libfcl-dev"]],
        ignore_installed: &["libfcl", "libccd", "liboctomap", "libeigen3"],
    },
    text: include_str!("fcl.cpp"),
    headers: &["eigen3"],
    options: &["-lfcl", "-lccd", "-loctomap", "-loctomath"],
};

/// The first number of a list, as `fcl.cpp` names them.
const DISTANCE: u32 = 0;
const MEETS: u32 = 1;

/// Compiled once in a run.
static PROGRAM: LazyLock<Result<Program, String>> = LazyLock::new(|| Program::compile(&SOURCE));

/// FCL with a mesh.
pub struct Fcl(Child);

impl Fcl {
    /// Takes over the mesh.
    ///
    /// # Errors
    /// No compiler or no package, or the child ended.
    pub fn new(subject: &Subject) -> Result<Self, String> {
        let mut child = PROGRAM.as_ref().map_err(Clone::clone)?.start()?;
        child.send_mesh(&subject.mesh)?;
        Ok(Self(child))
    }

    /// As [`Engine::ask`](super::engine::Engine::ask), but for a limit.
    ///
    /// # Errors
    /// The child ended.
    pub fn ask(&mut self, question: Question, cases: &[Case]) -> Result<Run, String> {
        let is_meeting = question == Question::Meets;
        self.0.send_question(if is_meeting { MEETS } else { DISTANCE }, cases.len())?;
        let numbers = cases.iter().flat_map(|case| {
            let rotation = glam::DMat3::from_quat(case.near.turn);
            [0, 1, 2].map(|k| {
                let [x, y, z] = rotation.row(k).to_array();
                [x, y, z, case.near.shift[k]]
            })
        });
        self.0.send(numbers.flatten().flat_map(f64::to_ne_bytes))?;
        let seconds = self.0.double()?;
        let one = |_| {
            let value = self.0.double()?;
            Ok(if is_meeting { Answer::Is(value > 0.0) } else { Answer::About(value) })
        };
        let answers = cases.iter().map(one).collect::<Result<_, String>>()?;
        Ok(Run { answers, work: None, seconds })
    }
}
