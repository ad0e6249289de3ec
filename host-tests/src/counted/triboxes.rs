//! Questions to the tribox hierarchy of a fixture.

use std::hint::black_box;
use std::path::Path;

use meshsweep_core::Triboxes;
use meshsweep_core::query::tribox::{
    BoundEntry, NodePair, apart, candidates, clip, distance, stack_entries,
};
use meshsweep_core::tribox::Pose;

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
    let mut stack = vec![BoundEntry::EMPTY; triboxes.depth() as usize + 2];
    let mut pairs = vec![NodePair::EMPTY; stack_entries(&triboxes, &triboxes)];
    let mut found = vec![NodePair::EMPTY; 4096];
    let all: Vec<Pose> = poses(&sphere(&subject), PLACED).map(|(_, core)| core).collect();
    match question {
        "distance" => {
            for point in points(&subject, Points::Far, PLACED).into_iter().take(queries) {
                black_box(distance(&triboxes, point, &mut stack).map_err(failed)?);
            }
        }
        "clip" => {
            for [a, b] in segments(&subject, PLACED).into_iter().take(queries) {
                black_box(clip(&triboxes, a, b, &mut stack).map_err(failed)?);
            }
        }
        _ => {
            for pose in all.iter().take(queries) {
                match question {
                    "apart" => {
                        black_box(apart(&triboxes, &triboxes, pose, &mut pairs).map_err(failed)?);
                    }
                    "candidates" => {
                        let answer = candidates(&triboxes, &triboxes, pose, &mut found, &mut pairs);
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
