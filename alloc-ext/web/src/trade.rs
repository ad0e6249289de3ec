//! What settings of a mesh promise and cost: the rows of `meshsweep trade`.

use crate::build::{name, refusal};
use crate::{say, tell};
use meshsweep::builder::Recipe;
use meshsweep::load::Source;
use meshsweep::trade::{Points, Row, diagonal, measure, pareto, points, standard};
use serde_json::{Value, json};

pub fn run(options: &Value, file: Vec<u8>) -> Result<(), String> {
    let name = name(options);
    let count = options["points"].as_u64().unwrap_or(0) as usize;
    let refused = |error| refusal(name, &error);
    let source = Source::of_bytes(name.as_ref(), file, None).map_err(refused)?;
    let repaired = source.repaired().map_err(refused)?;
    let mesh = &repaired.mesh;
    let asked = points(mesh, Points::Near, count);
    let mut settings = standard(diagonal(mesh), mesh.triangles.len(), Some(Points::Near));
    if !options["all"].as_bool().unwrap_or(false) {
        settings.retain(|setting| !is_slow(setting.recipe));
    }
    let progress = |done, of| tell("measuring", f64::from(done as u32) / f64::from(of as u32));
    let trade = measure(&source, &repaired, &asked, &settings, &progress)
        .map_err(|error| error.to_string())?;
    let best = pareto(&trade.rows);
    let rows = trade.rows.iter().enumerate().map(|(i, row)| as_json(row, best.contains(&i)));
    let missing = trade.missing.iter().map(|missing| {
        json!({ "structure": missing.recipe.name(), "reason": missing.reason.to_string() })
    });
    say(&json!({
        "points": asked.len(),
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
