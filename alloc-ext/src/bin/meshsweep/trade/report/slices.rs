//! Slices of the finest distance field of the table: what it answers, and how wide.

use super::super::measured::Measured;
use super::floats;
use meshsweep::builder::Recipe;
use meshsweep_core::{Blob, QueryError};
use serde_json::{Value, json};

/// Slices across each axis.
const SLICES: usize = 24;
/// Points along each side of a slice.
const SIDE: usize = 32;

/// The slices, or null if no field was built.
pub fn as_json(measured: &Measured) -> Result<Value, QueryError> {
    let is_field = |recipe: &Recipe| matches!(recipe, Recipe::Sdf(_));
    let found = measured.trade.blobs.iter().rfind(|(recipe, _)| is_field(recipe));
    let Some((recipe, built)) = found else { return Ok(Value::Null) };
    let field = Blob::open(built.bytes()).map_err(|_| QueryError::Unchecked)?.sdf()?;
    let [low, high] = field.bounds();
    let at = |axis: usize, step: usize, of: usize| {
        let part = (step as f32 + 0.5) / of as f32;
        low[axis] + part * (high[axis] - low[axis])
    };
    let (mut middles, mut widths) = (Vec::new(), Vec::new());
    for across in 0..3 {
        for slice in 0..SLICES {
            for row in 0..SIDE {
                for column in 0..SIDE {
                    let mut point = [0.0; 3];
                    point[across] = at(across, slice, SLICES);
                    point[(across + 1) % 3] = at((across + 1) % 3, row, SIDE);
                    point[(across + 2) % 3] = at((across + 2) % 3, column, SIDE);
                    let distance = field.distance(point)?.distance;
                    middles.push(0.5 * distance.lower + 0.5 * distance.upper);
                    widths.push(distance.upper - distance.lower);
                }
            }
        }
    }
    Ok(json!({
        "name": recipe.to_string(),
        "low": low,
        "high": high,
        "slices": SLICES,
        "side": SIDE,
        "middles": floats(middles),
        "widths": floats(widths),
    }))
}
