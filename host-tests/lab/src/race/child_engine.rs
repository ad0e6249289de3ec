//! An engine in C++: its index is in a child process.

use meshsweep_host_tests::workload::Subject;

use super::child::{Child, Program};
use super::engine::{Answer, Engine};
use super::workload::{HitKind, Workload};

/// The first number of a list, as the programs name them.
const CLOSEST_POINT: u32 = 0;
const FIRST_HIT: u32 = 1;
const ANY_HIT: u32 = 2;

/// An engine in a child process.
pub struct ChildEngine {
    child: Child,
    bytes: usize,
    build_seconds: f64,
    seconds: f64,
    workloads: &'static [Workload],
}

impl ChildEngine {
    /// Starts the program, and lets it build its index.
    ///
    /// # Errors
    /// The child's end.
    pub fn start<'a>(
        program: &Result<Program, String>,
        subject: &Subject,
        workloads: &'static [Workload],
    ) -> Result<Box<dyn Engine + 'a>, String> {
        let mut child = program.as_ref().map_err(Clone::clone)?.start()?;
        child.send_mesh(&subject.mesh)?;
        let bytes = child.whole()? as usize;
        let build_seconds = child.double()?;
        Ok(Box::new(ChildEngine { child, bytes, build_seconds, seconds: 0.0, workloads }))
    }

    /// Sends a list; its answers follow.
    fn ask(&mut self, question: u32, count: usize, numbers: &[f32]) -> Result<(), String> {
        self.child.send_question(question, count)?;
        self.child.send(numbers.iter().flat_map(|x| x.to_ne_bytes()))?;
        self.seconds = self.child.double()?;
        Ok(())
    }
}

impl Engine for ChildEngine {
    fn bytes(&self) -> usize {
        self.bytes
    }

    fn answers(&self, workload: Workload) -> bool {
        self.workloads.contains(&workload)
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
