//! Two models, of which one moves: their distance, whether it is below a limit, whether they meet.
//!
//! ```text
//! motions (poses, exact answers) ─ question ─ fcl (a child process)
//!   ─ engine (all, the library, parry3d)
//! ```
//! Each answer is held to an oracle: distances in 106 bits, meetings by exact predicates.

mod engine;
mod fcl;
mod motions;
mod question;

use std::path::Path;

use meshsweep_host_tests::workload::Subject;
use meshsweep_xtask::table::{Cell, Table, fixed, row, scientific};

use engine::{Engine, REFERENCE};
use fcl::Fcl;
use motions::{Case, Group, blob, groups};
use question::{Answer, Question};

use crate::measure::stopwatch::rounds;

/// Motions of each kind.
const MOTIONS: usize = 1_000;
/// For a look.
const FEW_MOTIONS: usize = 60;

/// A distance without bounds is wrong if it is off by more than this part of the mesh's size.
const FAR_OFF: f64 = 1e-5;

/// How the answers to a question compare with the truth.
#[derive(Default)]
struct Score {
    wrong: usize,
    open: usize,
    widest: Option<f64>,
}

fn score(question: Question, cases: &[Case], answers: &[Answer], size: f64) -> Score {
    let mut score = Score::default();
    for (case, answer) in cases.iter().zip(answers) {
        let truth = case.truth;
        let is_wrong = match *answer {
            Answer::Bounds(lower, upper) => {
                let width = (upper - lower) / size;
                score.widest = Some(score.widest.map_or(width, |widest| widest.max(width)));
                !(lower <= truth.upper && truth.lower <= upper)
            }
            // Some engines give a negative distance where surfaces meet.
            Answer::About(value) => (value.max(0.0) - truth.lower).abs() > FAR_OFF * size,
            Answer::Is(said) => {
                let is_true = match question {
                    Question::Meets => truth.upper == 0.0,
                    _ => truth.upper <= f64::from(question.limit(case)),
                };
                said != is_true
            }
            Answer::Open => {
                score.open += 1;
                false
            }
        };
        score.wrong += usize::from(is_wrong);
    }
    score
}

/// Races all engines on a mesh file and its moved copy.
///
/// # Errors
/// The file is no mesh, or an engine refused it.
pub fn race(file: &Path, is_quick: bool) -> Result<Table, String> {
    let subject = Subject::load_any(file)?;
    let groups = groups(&subject, if is_quick { FEW_MOTIONS } else { MOTIONS })?;
    let blobs = [blob(&subject, false), blob(&subject, true)];
    let mut engines = vec![
        Engine::tree("ours, 16-bit grid", &blobs[0])?,
        Engine::tree("ours, f32 vertices", &blobs[1])?,
        Engine::parry(&subject)?,
    ];
    let missing = Fcl::new(&subject).map(|fcl| engines.push(Engine::Fcl(fcl))).err();
    let mut table = Table::new(
        "pairs",
        format!(
            "== {}, {} triangles, and itself, moved ==",
            subject.name,
            subject.mesh.triangles.len()
        ),
        &[
            "motions",
            "question",
            "engine",
            "asked",
            "wrong",
            "open",
            "us",
            "x parry3d",
            "widest / size",
            "pairs of boxes",
            "pairs in f64",
        ],
    );
    for group in groups.iter().filter(|group| !group.cases.is_empty()) {
        let is_asked = |question: &Question| !group.is_meeting || *question == Question::Meets;
        for question in Question::ALL.into_iter().filter(is_asked) {
            rows(&mut table, group, question, &mut engines, subject.diagonal())?;
        }
    }
    table.note(
        "wrong: bounds without the truth, a wrong verdict, or, without bounds, a distance that is \
         off by more than 1e-5 of the size",
    );
    table.note(
        "truth: distances in 106 bits, meetings by exact predicates; motions: seeded; near \
         contact: the same after 99 hundredths of the way",
    );
    if let Some(reason) = missing {
        table.note(format!("without FCL: {reason}"));
    }
    Ok(table)
}

/// Races the engines at one question, and adds their rows.
fn rows(
    table: &mut Table,
    group: &Group,
    question: Question,
    engines: &mut [Engine<'_>],
    size: f64,
) -> Result<(), String> {
    let mut engines: Vec<_> =
        engines.iter_mut().filter(|engine| engine.answers(question)).collect();
    let ask = |engine: &mut &mut Engine<'_>| engine.ask(question, &group.cases);
    let runs = rounds(&mut engines, ask, |run| run.seconds)?;
    let all = engines.iter().zip(&runs);
    let reference = all.clone().find(|(engine, _)| engine.name() == REFERENCE);
    let theirs = reference.map_or(f64::NAN, |(_, run)| run.seconds);
    for (engine, run) in all {
        let count = run.answers.len();
        let score = score(question, &group.cases, &run.answers, size);
        let each = |which: usize| {
            run.work.map_or(Cell::Empty, |work| fixed(work[which] as f64 / count as f64, 1))
        };
        table.push(row![
            group.name,
            question.name(),
            engine.name(),
            count,
            score.wrong,
            score.open,
            fixed(run.seconds * 1e6 / count as f64, 1),
            fixed(theirs / run.seconds, 1),
            score.widest.map_or(Cell::Empty, scientific),
            each(0),
            each(1),
        ]);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::motions::groups;
    use super::{Engine, Question, blob, score};
    use meshsweep::mesh::Mesh;
    use meshsweep_host_tests::generate::torus;
    use meshsweep_host_tests::workload::Subject;

    #[test]
    fn our_trees_are_never_wrong_about_two_tori() {
        let (positions, triangles) = torus(2.0, 0.5, 12, 7);
        let subject = Subject::of("torus", Mesh::new(positions, triangles));
        let blobs = [blob(&subject, false), blob(&subject, true)];
        for group in groups(&subject, 20).expect("motions") {
            assert_eq!(group.cases.len(), 20, "{}", group.name);
            for question in Question::ALL {
                if group.is_meeting && question != Question::Meets {
                    continue;
                }
                for blob in &blobs {
                    let mut engine = Engine::tree("tree", blob).expect("opens");
                    let run = engine.ask(question, &group.cases).expect("answers");
                    let score = score(question, &group.cases, &run.answers, subject.diagonal());
                    assert_eq!(score.wrong, 0, "{} {}", group.name, question.name());
                }
            }
        }
    }
}
