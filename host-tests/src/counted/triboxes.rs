//! Questions to the tribox hierarchy of a fixture.

use meshsweep_core::{Budget, NodePair, Pose, ScratchEntry, Triboxes};
use std::hint::black_box;
use std::path::Path;

use super::PLACED;
use crate::workload::pose::{by_vertices, poses, sphere};
use crate::workload::{Points, Subject, points, segments};

/// Asks the first `queries` of a question.
pub fn ask(fixtures: &Path, question: &str, queries: usize) -> Result<(), String> {
    let subject = Subject::load(&fixtures.join("torus.ply"))?;
    let bytes = std::fs::read(fixtures.join("torus.msw"))
        .map_err(|error| format!("fixtures/torus.msw: {error}"))?;
    let triboxes = Triboxes::open(&bytes).map_err(|error| error.to_string())?;
    let failed = |error: meshsweep_core::QueryError| error.to_string();
    let mut stack = vec![ScratchEntry::EMPTY; triboxes.scratch_entries()];
    let mut pairs = vec![ScratchEntry::EMPTY; triboxes.separation_entries(&triboxes)];
    let mut found = vec![NodePair::EMPTY; 4096];
    let all: Vec<Pose> = poses(&sphere(&subject), PLACED).map(|(_, core)| core).collect();
    match question {
        "distance" => {
            for point in points(&subject, Points::Far, PLACED).into_iter().take(queries) {
                black_box(triboxes.distance(point, Budget::EXACT, &mut stack).map_err(failed)?);
            }
        }
        "clip" => {
            for [a, b] in segments(&subject, PLACED).into_iter().take(queries) {
                black_box(triboxes.clip(a, b, Budget::EXACT, &mut stack).map_err(failed)?);
            }
        }
        _ => {
            for pose in all.iter().take(queries) {
                match question {
                    "apart" => {
                        black_box(
                            triboxes
                                .separation(&triboxes, *pose, Budget::EXACT, &mut pairs)
                                .map_err(failed)?,
                        );
                    }
                    "candidates" => {
                        let answer = triboxes.candidates(
                            &triboxes,
                            *pose,
                            &mut found,
                            Budget::EXACT,
                            &mut pairs,
                        );
                        black_box(answer.map_err(failed)?);
                    }
                    _ => {
                        black_box(by_vertices(&triboxes, &triboxes, pose));
                    }
                }
            }
        }
    }
    Ok(())
}
