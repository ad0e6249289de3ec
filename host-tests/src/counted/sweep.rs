//! Closest points by sweeps on the split tables, of any blob.

use std::hint::black_box;
use std::path::Path;

use glam::Vec3;
use meshsweep::mesh::Mesh;
use meshsweep_core::{Budget, Hull, ScratchEntry};

use super::PLACED;
use crate::workload::{Points, Subject, points};

/// Entries of a kept sweep.
const ENTRIES: usize = 512;

/// Asks the first `queries` points of a blob's hull hierarchy. `question`: the blob; the way from
/// one point to the next as a part of the diagonal; the relative tolerance. With a way of 0 each
/// query is a fresh one, about the points that [`Points::Far`] gives for the mesh. Else one kept
/// sweep moves from each of these points to the next.
///
/// # Errors
/// A blob that is missing or refused, or numbers that are none.
pub fn ask(fixtures: &Path, question: &str, queries: usize) -> Result<(), String> {
    let words: Vec<&str> = question.split(' ').collect();
    let &[blob, step, relative] = words.as_slice() else {
        return Err(format!("`{question}` is not: sweep BLOB STEP RELATIVE"));
    };
    let number = |word: &str| word.parse::<f32>().map_err(|_| format!("`{word}` is not a number"));
    let bytes = std::fs::read(fixtures.join(blob)).map_err(|error| format!("{blob}: {error}"))?;
    let hull = Hull::open(&bytes).map_err(|error| error.to_string())?;
    let [least, greatest] = hull.bounds().map(Vec3::from_array);
    let step = number(step)? * least.distance(greatest);
    let budget = Budget::EXACT.with_relative(number(relative)?);
    let corners = Subject::of(blob, Mesh::new(hull.bounds().to_vec(), Vec::new()));
    let places = points(&corners, Points::Far, PLACED);
    let failed = |error: meshsweep_core::QueryError| error.to_string();
    if step == 0.0 {
        let mut queue = vec![ScratchEntry::EMPTY; ENTRIES];
        for place in places.into_iter().take(queries) {
            black_box(hull.closest_point(place, budget, &mut queue).map_err(failed)?);
        }
        return Ok(());
    }
    let mut queue = vec![ScratchEntry::EMPTY; ENTRIES];
    let mut sweep = hull.sweep(places[0], &mut queue).map_err(failed)?;
    let ways = places.windows(2).flat_map(|ends| {
        let [from, to] = [ends[0], ends[1]].map(Vec3::from_array);
        let steps = ((to - from).length() / step).ceil().max(1.0);
        (0..steps as u32).map(move |i| from + (to - from) * (i as f32 / steps))
    });
    for place in ways.take(queries) {
        sweep.move_to(place.to_array()).map_err(failed)?;
        black_box(sweep.closest_point(budget).map_err(failed)?);
    }
    Ok(())
}
