//! The rows of `meshsweep trade`: the widest interval measured of each setting, and its costs.

use crate::border::leave_json;
use crate::build::{name, refusal};
use crate::report_progress;
use meshsweep::builder::Recipe;
use meshsweep::load::Source;
use meshsweep::trade::{Points, Row, diagonal, measure, pareto, points, standard};
use serde_json::{Value, json};
use std::ops::RangeInclusive;

/// Numbers of points that the page takes.
const POINTS: RangeInclusive<u64> = 1..=100_000;

pub fn run(options: &Value, file: Vec<u8>) -> Result<(), String> {
    let name = name(options);
    let count =
        options["points"].as_u64().filter(|count| POINTS.contains(count)).ok_or_else(|| {
            format!("points: a whole number from {} to {} is wanted", POINTS.start(), POINTS.end())
        })?;
    let refused = |error| refusal(name, &error);
    let source = Source::of_bytes(name.as_ref(), file, None).map_err(refused)?;
    let repaired = source.repaired().map_err(refused)?;
    let mesh = &repaired.mesh;
    let places = points(mesh, Points::Near, count as usize);
    let mut settings = standard(diagonal(mesh), mesh.triangles.len(), Some(Points::Near));
    if !options["all"].as_bool().unwrap_or(false) {
        settings.retain(|setting| !is_slow(setting.recipe));
    }
    let progress = |done, of| report_progress("measuring", done as f64 / of as f64);
    let trade = measure(&source, &repaired, &places, &settings, &progress)
        .map_err(|error| error.to_string())?;
    let best = pareto(&trade.rows);
    let rows = trade.rows.iter().enumerate().map(|(i, row)| as_json(row, best.contains(&i)));
    let missing = trade.missing.iter().map(|missing| {
        json!({ "structure": missing.recipe.name(), "reason": missing.reason.to_string() })
    });
    leave_json(&json!({
        "rows": rows.collect::<Vec<_>>(),
        "not_built": missing.collect::<Vec<_>>(),
    }));
    Ok(())
}

/// Whether the structure takes minutes to build on the one thread of a page.
fn is_slow(recipe: Recipe) -> bool {
    matches!(recipe, Recipe::Sdf(_) | Recipe::TreeWithSdf(_) | Recipe::Triboxes(_))
}

fn as_json(row: &Row, is_best: bool) -> Value {
    let [m4f, m0] = row.boards.map(|board| board.map(|board| board.mean));
    json!({
        "structure": row.setting.recipe.name(),
        "dials": row.setting.dials(),
        "build": row.build(),
        "is_best": is_best,
        "error": row.guaranteed.map(|spread| spread.most),
        "median": row.guaranteed.map(|spread| spread.median),
        "m4f": m4f,
        "m0": m0,
        "flash": row.flash,
        "scratch": row.scratch,
    })
}
