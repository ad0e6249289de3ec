//! The engines that answer about two models.

use std::hint::black_box;

use meshsweep_core::{Budget, Bvh, Ended, ScratchEntry, Verdict, Work};
use meshsweep_host_tests::workload::Subject;
use parry3d::math::Pose as ParryPose;
use parry3d::query::{ClosestPoints, closest_points, distance, intersection_test};

use super::fcl::Fcl;
use super::motions::Case;
use super::question::{Answer, Question, Run};
use crate::measure::rival::Rival;
use crate::measure::stopwatch::Stopwatch;

/// The engine that all others are compared with.
pub const REFERENCE: &str = "parry3d";

/// An engine with its index of the mesh.
pub enum Engine<'a> {
    /// The library's box tree, its name and its memory.
    Tree(&'static str, Bvh<'a>, Vec<ScratchEntry>),
    /// parry3d.
    Parry(Rival),
    /// FCL.
    Fcl(Fcl),
}

impl<'a> Engine<'a> {
    /// The library's tree.
    ///
    /// # Errors
    /// None but a fault of the builder.
    pub fn tree(name: &'static str, blob: &'a [u8]) -> Result<Self, String> {
        let tree = Bvh::open(blob).map_err(|error| error.to_string())?;
        Ok(Self::Tree(name, tree, vec![ScratchEntry::EMPTY; Bvh::DISTANCE_ENTRIES]))
    }

    /// parry3d's.
    ///
    /// # Errors
    /// parry3d's refusal.
    pub fn parry(subject: &Subject) -> Result<Self, String> {
        Ok(Self::Parry(Rival::new(subject)?))
    }

    /// In tables.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Tree(name, ..) => name,
            Self::Parry(_) => REFERENCE,
            Self::Fcl(_) => "FCL",
        }
    }

    /// FCL is not asked about a limit: its distances have none.
    pub const fn answers(&self, question: Question) -> bool {
        !matches!((self, question), (Self::Fcl(_), Question::Within(_)))
    }

    /// Answers about all cases.
    ///
    /// # Errors
    /// The engine's refusal.
    pub fn ask(&mut self, question: Question, cases: &[Case]) -> Result<Run, String> {
        let mut answers = Vec::with_capacity(cases.len());
        let watch = Stopwatch::start();
        let work = match self {
            Self::Fcl(fcl) => return fcl.ask(question, cases),
            Self::Tree(_, tree, stack) => {
                let mut sum = [0; 2];
                for case in cases {
                    let (answer, work) = black_box(by_tree(question, tree, case, stack)?);
                    sum[0] += u64::from(work.bounds);
                    sum[1] += u64::from(work.exact);
                    answers.push(answer);
                }
                Some(sum)
            }
            Self::Parry(rival) => {
                for case in cases {
                    answers.push(black_box(by_parry(question, rival, case)?));
                }
                None
            }
        };
        Ok(Run { answers, work, seconds: watch.seconds() })
    }
}

fn by_tree(
    question: Question,
    tree: &Bvh<'_>,
    case: &Case,
    stack: &mut [ScratchEntry],
) -> Result<(Answer, Work), String> {
    let (pose, exact) = (case.pose, Budget::EXACT);
    let said = |verdict| match verdict {
        Verdict::Yes => Answer::Is(true),
        Verdict::No => Answer::Is(false),
        _ => Answer::Open,
    };
    let answer = match question {
        Question::Distance => tree.distance_to(tree, pose, exact, stack).map(|found| {
            let bounds =
                Answer::Bounds(f64::from(found.distance.lower), f64::from(found.distance.upper));
            (if found.ended == Ended::Exact { bounds } else { Answer::Open }, found.work)
        }),
        Question::Within(_) => tree
            .within_of(tree, pose, question.limit(case), exact, stack)
            .map(|found| (said(found.verdict), found.work)),
        Question::Meets => {
            tree.overlap(tree, pose, exact, stack).map(|found| (said(found.verdict), found.work))
        }
    };
    answer.map_err(|error| error.to_string())
}

fn by_parry(question: Question, rival: &Rival, case: &Case) -> Result<Answer, String> {
    let (here, there, shape) = (&ParryPose::IDENTITY, &case.parry, rival.shape());
    let answer = match question {
        Question::Distance => distance(here, shape, there, shape)
            .map(|found| Answer::About(f64::from(found.distance))),
        Question::Within(_) => closest_points(here, shape, there, shape, question.limit(case))
            .map(|found| Answer::Is(!matches!(found, ClosestPoints::Disjoint))),
        Question::Meets => {
            intersection_test(here, shape, there, shape).map(|found| Answer::Is(found.intersecting))
        }
    };
    answer.map_err(|error| error.to_string())
}
