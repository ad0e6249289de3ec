//! Questions to fixtures and blobs that a simulator counts, as bytes: each with its seeded list of
//! queries. `meshsweep-counted` asks them.

mod fit;
mod fit_curves;
mod placed;

use meshsweep::progress::Watch;
use std::path::Path;

pub use fit::fit;

use meshsweep::bvh::{TreeOptions, build};
use meshsweep::mesh::{Input, Mesh};
use meshsweep_core::{Budget, Bvh, DeformableHull, QueryError, ScratchEntry};
use meshsweep_counted::{Counted, numbers_of};

use crate::workload::pose::{poses, sphere};
use crate::workload::{Points, Subject, points, segments};

/// Queries that are placed, whether they are asked or not, so that reading them is no part of a
/// difference between two runs.
const PLACED: usize = 2500;

/// Writes questions, each to `NUMBER.bin` of a folder, the first of number 0.
///
/// # Errors
/// An unknown question, or a fixture that is missing or refused.
pub fn place(fixtures: &Path, folder: &Path, questions: &[&str]) -> Result<(), String> {
    let failed = |error: std::io::Error| format!("{}: {error}", folder.display());
    std::fs::create_dir_all(folder).map_err(failed)?;
    for (number, question) in questions.iter().enumerate() {
        let bytes = placed_question(fixtures, question)?;
        std::fs::write(folder.join(format!("{number}.bin")), bytes).map_err(failed)?;
    }
    Ok(())
}

/// Writes a question at places for a board; means of the answers, and what the board prints for the
/// first `queries`, but for its costs.
///
/// # Errors
/// A question that is not at places, or a blob that is missing or refused.
pub fn lay(fixtures: &Path, question: &str, queries: usize, file: &Path) -> Result<String, String> {
    use meshsweep_counted::placed::{ask, expected};
    let laid = placed::lay(fixtures, question, queries).ok_or_else(|| {
        format!("`{question}` is not: bvh, sweep, refine, field, beyond, units, within, near or bounds-both BLOB ...")
    })??;
    std::fs::write(file, &laid).map_err(|error| format!("{}: {error}", file.display()))?;
    Ok(format!("{}\n{}", ask(&laid, queries)?, expected(&laid, queries)?))
}

fn placed_question(fixtures: &Path, question: &str) -> Result<Vec<u8>, String> {
    if let Some(laid) = placed::lay(fixtures, question, PLACED) {
        return Ok(bytes("placed", &laid?, Vec::new()));
    }
    let words: Vec<&str> = question.split(' ').collect();
    let read =
        |name: &str| std::fs::read(fixtures.join(name)).map_err(|error| format!("{name}: {error}"));
    match *words.as_slice() {
        ["tree", fixture, kind] => tree(fixtures, fixture, kind),
        ["deform", what, name] => {
            let blob = read(name)?;
            let hull = DeformableHull::open(&blob).map_err(|error| error.to_string())?;
            let bounds = hull.rest().bounds();
            let corners = Subject::of(name, Mesh::new(bounds.to_vec(), Vec::new()));
            let (_, numbers) = queries(&corners, "far");
            Ok(bytes(&format!("deform {what}"), &blob, numbers))
        }
        ["triboxes", ref kind @ ..] => {
            let subject = Subject::load(&fixtures.join("torus.ply"))?;
            let queried = match *kind {
                ["distance"] => "far",
                ["clip"] => "segments",
                _ => "poses",
            };
            let (_, numbers) = queries(&subject, queried);
            Ok(bytes(question, &read("torus.msw")?, numbers))
        }
        [kind] => {
            let subject = Subject::load(&fixtures.join("bracket.stl"))?;
            let (asked, numbers) = queries(&subject, kind);
            Ok(bytes(&format!("hull {asked}"), &read("bracket.msw")?, numbers))
        }
        _ => Err(format!("no question `{question}`")),
    }
}

/// A question to the box tree of a fixture.
fn tree(fixtures: &Path, fixture: &str, kind: &str) -> Result<Vec<u8>, String> {
    let subject = Subject::load(&fixtures.join(fixture))?;
    let input = Input { input_triangles: subject.triangles_read, ..subject.mesh.as_input() };
    let (tables, _) =
        build(input, &TreeOptions::default(), Watch::NONE).map_err(|error| error.to_string())?;
    let blob = tables.to_bytes();
    if let Some(kind) = kind.strip_prefix("avx2_") {
        let (asked, numbers) = queries(&subject, kind);
        return Ok(bytes(&format!("tree {asked}_avx2"), &blob, numbers));
    }
    if kind != "clear" {
        let (asked, numbers) = queries(&subject, kind);
        return Ok(bytes(&format!("tree {asked}"), &blob, numbers));
    }
    let tree = Bvh::open(&blob).map_err(|error| error.to_string())?;
    let mut stack = vec![ScratchEntry::EMPTY; tree.header().stack_entries as usize];
    let mut numbers = Vec::new();
    for point in points(&subject, Points::Far, PLACED) {
        let near = tree.closest_point(point, Budget::EXACT, &mut stack);
        let distance = near.map_err(|error: QueryError| error.to_string())?.distance;
        numbers.extend(point);
        numbers.push(0.9 * distance.lower);
    }
    Ok(bytes("tree within", &blob, numbers))
}

/// The question that a kind of queries asks, and the numbers of all of them.
fn queries<'k>(subject: &Subject, kind: &'k str) -> (&'k str, Vec<f32>) {
    if let Some(points_kind) = Points::ALL.into_iter().find(|points| points.name() == kind) {
        return ("closest", points(subject, points_kind, PLACED).into_flattened());
    }
    if matches!(kind, "overlap" | "poses") {
        let sphere = sphere(subject);
        let all = poses(&sphere, PLACED);
        return (kind, all.flat_map(|(_, core)| numbers_of(&core)).collect());
    }
    (kind, segments(subject, PLACED).into_flattened().into_flattened())
}

fn bytes(kind: &str, blob: &[u8], numbers: Vec<f32>) -> Vec<u8> {
    Counted { kind, blob, numbers }.to_bytes()
}
