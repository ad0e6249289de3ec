//! Questions to a hull hierarchy.

use std::hint::black_box;

use meshsweep_core::{Budget, Hit, Hull, OuterSearch, QueryError, RefinedHull, ScratchEntry};

use crate::Counted;

/// Splits of the refined hull.
const SPLITS: usize = 1024;

pub fn ask(counted: &Counted<'_>, question: &str, queries: usize) -> Result<(), String> {
    let model = Hull::open(counted.blob).map_err(|error| error.to_string())?;
    let mut queue = vec![ScratchEntry::EMPTY; model.scratch_entries()];
    let failed = |error: QueryError| error.to_string();
    let search = match question {
        "closest" => {
            for point in counted.points(queries) {
                black_box(model.closest_point(point, Budget::EXACT, &mut queue).map_err(failed)?);
            }
            return Ok(());
        }
        "overlap" => {
            let mut stack = vec![ScratchEntry::EMPTY; model.overlap_entries(&model)];
            for pose in counted.poses(queries) {
                let answer = model.overlap(&model, pose, Budget::EXACT, &mut stack);
                black_box(answer.map_err(failed)?);
            }
            return Ok(());
        }
        "first_hit" => {
            for [a, b] in counted.segments(queries) {
                black_box(model.first_hit(a, b, Budget::EXACT, &mut queue).map_err(failed)?);
            }
            return Ok(());
        }
        "outer_first" => OuterSearch::First,
        "outer_all" => OuterSearch::Outer,
        _ => return Err(format!("no question `{question}` to a hull hierarchy")),
    };
    let mut refined = Box::new(RefinedHull::<SPLITS>::new());
    let mut hits = [Hit::EMPTY; 16];
    for [a, b] in counted.segments(queries) {
        refined.reset();
        let answer =
            model.outer_hits(a, b, search, &mut refined, &mut hits, Budget::EXACT, &mut queue);
        black_box(answer.map_err(failed)?);
    }
    Ok(())
}
