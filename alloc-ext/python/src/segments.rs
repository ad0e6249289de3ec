//! Questions about segments and rays. Rows have both ends; of rays the origin and the direction.

use crate::error::QueryError;
use crate::model::{Model, budget};
use crate::rounding::moved;
use crate::rows::{Found, Lists, QueryRows, Records};
use meshsweep_core::{AllHits, Facing, TriangleHit};
use pyo3::prelude::*;

/// Both points of a row.
pub fn ends(row: &[f32]) -> [[f32; 3]; 2] {
    core::array::from_fn(|end| {
        core::array::from_fn(|k| row.get(3 * end + k).copied().unwrap_or_default())
    })
}

fn facing_of(code: u8) -> PyResult<Facing> {
    match code {
        0 => Ok(Facing::Both),
        1 => Ok(Facing::Front),
        2 => Ok(Facing::Back),
        _ => Err(QueryError::new_err(format!("facing: {code} is none of 0, 1 and 2"))),
    }
}

#[pymethods]
impl Model {
    /// Rows have both points, and how far rounding moved each.
    fn first_hit<'py>(
        &self,
        rows: QueryRows<'py>,
        is_ray: bool,
        facing: u8,
        steps: Option<u32>,
    ) -> PyResult<Records<'py>> {
        let (facing, budget) = (facing_of(facing)?, budget((0.0, 0.0, steps)));
        let engine = self.engine(facing)?;
        rows.each(engine.entries(), |row: [f32; 8], scratch| {
            let found = engine.first_hit(ends(&row), is_ray, facing, budget, scratch)?;
            match found.is_clear() && moved(&row) > 0.0 {
                true => engine.as_given(&row, is_ray, found, budget, scratch),
                false => Ok(found),
            }
        })
    }

    fn all_hits<'py>(
        &self,
        rows: QueryRows<'py>,
        is_ray: bool,
        facing: u8,
    ) -> PyResult<Lists<'py>> {
        let facing = facing_of(facing)?;
        let engine = self.engine(facing)?;
        rows.lists(engine.entries(), TriangleHit::EMPTY, |row: [f32; 6], answers, scratch| {
            let AllHits { stored, dropped, is_complete, .. } =
                engine.all_hits(ends(&row), is_ray, facing, answers, scratch)?;
            Ok(Found { stored, dropped, is_complete })
        })
    }
}
