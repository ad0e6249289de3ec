//! Embree: Intel's trees for ray casts, as Debian has them, in a child process of C++.
//!
//! Scenes are robust, so that no segment passes between two triangles, and of high quality, which
//! takes longer to build.

use std::sync::LazyLock;

use meshsweep_host_tests::workload::Subject;
use meshsweep_xtask::toolbox::Wanted;

use super::child::{Child, Program, Source};
use super::engine::{Answer, Engine};
use super::workload::{HitKind, Workload};

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

/// The first number of a list, as `embree.cpp` names them.
const CLOSEST_POINT: u32 = 0;
const FIRST_HIT: u32 = 1;
const ANY_HIT: u32 = 2;

/// Compiled once in a run.
static PROGRAM: LazyLock<Result<Program, String>> = LazyLock::new(|| Program::compile(&SOURCE));

struct Embree {
    child: Child,
    bytes: usize,
    build_seconds: f64,
    seconds: f64,
}

/// Why Embree cannot take part on this machine, if it cannot.
pub fn missing() -> Option<String> {
    PROGRAM.as_ref().err().cloned()
}

/// On every mesh.
///
/// # Errors
/// The child's end.
pub fn build<'a>(subject: &Subject, _: &'a mut Vec<u8>) -> Result<Box<dyn Engine + 'a>, String> {
    let mut child = PROGRAM.as_ref().map_err(Clone::clone)?.start()?;
    child.send_mesh(&subject.mesh)?;
    let bytes = child.whole()? as usize;
    let build_seconds = child.double()?;
    Ok(Box::new(Embree { child, bytes, build_seconds, seconds: 0.0 }))
}

impl Embree {
    /// Sends a list; its answers follow.
    fn ask(&mut self, question: u32, count: usize, numbers: &[f32]) -> Result<(), String> {
        self.child.send_question(question, count)?;
        self.child.send(numbers.iter().flat_map(|x| x.to_ne_bytes()))?;
        self.seconds = self.child.double()?;
        Ok(())
    }
}

impl Engine for Embree {
    fn bytes(&self) -> usize {
        self.bytes
    }

    fn answers(&self, _: Workload) -> bool {
        true
    }

    fn own_build_seconds(&self) -> Option<f64> {
        Some(self.build_seconds)
    }

    fn own_seconds(&self) -> Option<f64> {
        Some(self.seconds)
    }

    fn closest(&mut self, points: &[[f32; 3]], answers: &mut Vec<Answer>) -> Result<(), String> {
        answers.clear();
        self.ask(CLOSEST_POINT, points.len(), points.as_flattened())?;
        for _ in points {
            let child = &mut self.child;
            answers.push(Answer::Point([child.float()?, child.float()?, child.float()?]));
        }
        Ok(())
    }

    fn hits(
        &mut self,
        segments: &[[[f32; 3]; 2]],
        kind: HitKind,
        answers: &mut Vec<Answer>,
    ) -> Result<(), String> {
        answers.clear();
        let question = match kind {
            HitKind::First => FIRST_HIT,
            HitKind::Any => ANY_HIT,
        };
        self.ask(question, segments.len(), segments.as_flattened().as_flattened())?;
        for _ in segments {
            let parameter = self.child.float()?;
            answers.push(match kind {
                _ if parameter < 0.0 => Answer::Miss,
                HitKind::First => Answer::Hit(parameter),
                HitKind::Any => Answer::Meets,
            });
        }
        Ok(())
    }
}
