//! parry3d: a binary tree of boxes in f32.

use std::convert::Infallible;

use meshsweep_host_tests::workload::Subject;

use super::engine::{Answer, Answers, Engine};
use super::workload::{HitKind, Workload};
use crate::measure::rival::Rival;

struct Parry(Rival);

/// Builds the index of any mesh.
///
/// # Errors
/// parry3d's refusal.
pub fn build<'a>(subject: &Subject, _: &'a mut Vec<u8>) -> Result<Box<dyn Engine + 'a>, String> {
    Ok(Box::new(Parry(Rival::new(subject)?)))
}

impl Engine for Parry {
    fn bytes(&self) -> usize {
        self.0.bytes()
    }

    fn answers(&self, _: Workload) -> bool {
        true
    }

    fn closest(&mut self, points: &[[f32; 3]]) -> Result<Answers, String> {
        Answers::each(points, |point| Ok::<_, Infallible>(Answer::Point(self.0.closest(point))))
    }

    fn hits(&mut self, segments: &[[[f32; 3]; 2]], kind: HitKind) -> Result<Answers, String> {
        Answers::each(segments, |segment| {
            Ok::<_, Infallible>(match kind {
                HitKind::First => self.0.first_hit(segment).map_or(Answer::Miss, Answer::Hit),
                HitKind::Any if self.0.meets(segment) => Answer::Meets,
                HitKind::Any => Answer::Miss,
            })
        })
    }
}
