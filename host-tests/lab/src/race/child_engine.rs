//! An engine whose index is in a child process.

use meshsweep_host_tests::workload::Subject;

use super::child::{Child, Program};
use super::engine::{Answer, Answers, Engine};
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
}

impl ChildEngine {
    /// Starts the program, and lets it build its index.
    ///
    /// # Errors
    /// Why there is no program, or the child ended.
    pub fn start<'a>(
        program: &Result<Program, String>,
        subject: &Subject,
    ) -> Result<Box<dyn Engine + 'a>, String> {
        let mut child = program.as_ref().map_err(Clone::clone)?.start()?;
        child.send_mesh(&subject.mesh)?;
        let bytes = child.whole()? as usize;
        let build_seconds = child.double()?;
        Ok(Box::new(Self { child, bytes, build_seconds }))
    }

    /// Sends a list; receives each answer with `one`.
    fn ask(
        &mut self,
        question: u32,
        count: usize,
        numbers: &[f32],
        one: impl Fn(&mut Child) -> Result<Answer, String>,
    ) -> Result<Answers, String> {
        let child = &mut self.child;
        child.send_question(question, count)?;
        child.send(numbers.iter().flat_map(|x| x.to_ne_bytes()))?;
        let seconds = child.double()?;
        let all = (0..count).map(|_| one(child)).collect::<Result<_, _>>()?;
        Ok(Answers { all, seconds })
    }
}

impl Engine for ChildEngine {
    fn bytes(&self) -> usize {
        self.bytes
    }

    fn answers(&self, _: Workload) -> bool {
        true
    }

    fn own_build_seconds(&self) -> Option<f64> {
        Some(self.build_seconds)
    }

    fn closest(&mut self, points: &[[f32; 3]]) -> Result<Answers, String> {
        self.ask(CLOSEST_POINT, points.len(), points.as_flattened(), |child| {
            Ok(Answer::Point([child.float()?, child.float()?, child.float()?]))
        })
    }

    fn hits(&mut self, segments: &[[[f32; 3]; 2]], kind: HitKind) -> Result<Answers, String> {
        let (question, hit): (_, fn(f32) -> Answer) = match kind {
            HitKind::First => (FIRST_HIT, Answer::Hit),
            HitKind::Any => (ANY_HIT, |_| Answer::Meets),
        };
        self.ask(question, segments.len(), segments.as_flattened().as_flattened(), |child| {
            let parameter = child.float()?;
            Ok(if parameter < 0.0 { Answer::Miss } else { hit(parameter) })
        })
    }
}
