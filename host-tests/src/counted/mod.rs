//! Questions to fixtures and blobs that a simulator counts: the first so many of a seeded list.

mod deform;
mod placed;
mod tree;
mod triboxes;

use std::hint::black_box;
use std::path::Path;

use meshsweep_core::{Budget, Hit, Hull, QueryError, RefinedHull, ScratchEntry, Search};

use crate::workload::pose::{poses, sphere};
use crate::workload::{Points, Subject, points, segments};

/// Queries that are placed, whether they are asked or not, so that placing them is no part of a
/// difference between two runs.
const PLACED: usize = 2500;

/// Splits of the refined hull.
const SPLITS: usize = 1024;

/// Asks the first `queries` of a question; `NODES TRIANGLES A_LEAF`: the nodes and triangles looked
/// at, and the triangles of a leaf, where the question counts them.
///
/// # Errors
/// An unknown question, or a fixture that is missing or refused.
pub fn ask(fixtures: &Path, question: &str, queries: usize) -> Result<String, String> {
    if let Some(question) = question.strip_prefix("tree ") {
        let (work, triangles) = tree::ask(fixtures, question, queries)?;
        return Ok(format!("{} {} {triangles}", work.splits, work.triangles));
    }
    if let Some(laid) = placed::lay(fixtures, question, PLACED) {
        return Ok(format!("0 0 1 {}", placed::ask(&laid?, queries)?));
    }
    match question.split_once(' ') {
        Some(("deform", question)) => deform::ask(fixtures, question, queries),
        Some(("triboxes", question)) => triboxes::ask(fixtures, question, queries),
        _ => hull(fixtures, question, queries),
    }
    .map(|()| "0 0 1".to_owned())
}

/// Writes a question at places for a board; the line of [`ask`], and what the board prints for the
/// first `queries`, but for its costs.
///
/// # Errors
/// A question that is not at places, or a blob that is missing or refused.
pub fn lay(fixtures: &Path, question: &str, queries: usize, file: &Path) -> Result<String, String> {
    let laid = placed::lay(fixtures, question, queries)
        .ok_or_else(|| format!("`{question}` is not: bvh, sweep or refine BLOB ..."))??;
    std::fs::write(file, &laid).map_err(|error| format!("{}: {error}", file.display()))?;
    Ok(format!("{}\n{}", placed::ask(&laid, queries)?, placed::expected(&laid, queries)?))
}

/// Questions to the hull hierarchy.
fn hull(fixtures: &Path, question: &str, queries: usize) -> Result<(), String> {
    let subject = Subject::load(&fixtures.join("bracket.stl"))?;
    let blob = std::fs::read(fixtures.join("bracket.msw"))
        .map_err(|error| format!("fixtures/bracket.msw: {error}"))?;
    let model = Hull::open(&blob).map_err(|error| error.to_string())?;
    let mut queue = vec![ScratchEntry::EMPTY; model.scratch_entries()];
    let failed = |error: QueryError| error.to_string();
    if let Some(kind) = Points::ALL.into_iter().find(|kind| kind.name() == question) {
        for point in points(&subject, kind, PLACED).into_iter().take(queries) {
            black_box(model.closest_point(point, Budget::EXACT, &mut queue).map_err(failed)?);
        }
        return Ok(());
    }
    if question == "overlap" {
        let mut stack = vec![ScratchEntry::EMPTY; model.overlap_entries(&model)];
        let all: Vec<_> = poses(&sphere(&subject), PLACED).map(|(_, core)| core).collect();
        for pose in all.into_iter().take(queries) {
            black_box(model.overlap(&model, pose, Budget::EXACT, &mut stack).map_err(failed)?);
        }
        return Ok(());
    }
    let mut refined = Box::new(RefinedHull::<SPLITS>::new());
    let search = match question {
        "first_hit" => None,
        "outer_first" => Some(Search::First),
        "outer_all" => Some(Search::Outer),
        _ => return Err(format!("no question `{question}`")),
    };
    let mut hits = [Hit::EMPTY; 16];
    for [a, b] in segments(&subject, PLACED).into_iter().take(queries) {
        if let Some(search) = search {
            refined.reset();
            let answer =
                model.outer_hits(a, b, search, &mut refined, &mut hits, Budget::EXACT, &mut queue);
            black_box(answer.map_err(failed)?);
        } else {
            black_box(model.first_hit(a, b, Budget::EXACT, &mut queue).map_err(failed)?);
        }
    }
    Ok(())
}
