//! Questions to the tribox hierarchy of a fixture.

use std::hint::black_box;

use meshsweep_core::Triboxes;
use meshsweep_core::query::tribox::{
    BoundEntry, NodePair, apart, candidates, clip, distance, stack_entries,
};
use meshsweep_core::tribox::Pose;
use meshsweep_host_tests::measure::Subject;
use meshsweep_host_tests::measure::triboxes::{by_vertices, poses, sphere};
use meshsweep_host_tests::measure::workload::{Points, points, segments};

use super::QUERIES;
use crate::workspace;

/// Questions by their words on the command line.
pub const QUESTIONS: [&str; 5] = [
    "triboxes apart",
    "triboxes by vertices",
    "triboxes candidates",
    "triboxes distance",
    "triboxes clip",
];

/// Asks the first `queries` of a question; `None` if it is not one to triboxes.
pub fn ask(question: &str, queries: usize) -> Option<Result<(), String>> {
    Some(asked(question.strip_prefix("triboxes ")?, queries))
}

fn asked(question: &str, queries: usize) -> Result<(), String> {
    let folder = workspace::root().join("fixtures");
    let subject = Subject::load(&folder.join("torus.ply"))?;
    let bytes = std::fs::read(folder.join("torus.msw"))
        .map_err(|error| format!("fixtures/torus.msw: {error}"))?;
    let triboxes = Triboxes::open(&bytes).map_err(|error| error.to_string())?;
    let failed = |error: meshsweep_core::QueryError| error.to_string();
    let mut stack = vec![BoundEntry::EMPTY; triboxes.depth() as usize + 2];
    let mut pairs = vec![NodePair::EMPTY; stack_entries(&triboxes, &triboxes)];
    let mut found = vec![NodePair::EMPTY; 4096];
    let all: Vec<Pose> = poses(&sphere(&subject), QUERIES[1]).map(|(_, core)| core).collect();
    match question {
        "distance" => {
            for point in points(&subject, Points::Far, QUERIES[1]).into_iter().take(queries) {
                black_box(distance(&triboxes, point, &mut stack).map_err(failed)?);
            }
        }
        "clip" => {
            for [a, b] in segments(&subject, QUERIES[1]).into_iter().take(queries) {
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
