//! Questions about segments and rays. Rows have both ends; of rays the origin and the direction.

use crate::error::QueryError;
use crate::model::{Model, budget};
use crate::rows::{Asked, Found, Lists, Records};
use meshsweep_core::{AllHits, Budget, Facing, TriangleHit};
use pyo3::prelude::*;

/// Both points of a row.
pub fn ends([ax, ay, az, bx, by, bz]: [f32; 6]) -> [[f32; 3]; 2] {
    [[ax, ay, az], [bx, by, bz]]
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
    fn first_hit<'py>(
        &self,
        asked: Asked<'py>,
        is_ray: bool,
        facing: u8,
        steps: Option<u32>,
    ) -> PyResult<Records<'py>> {
        let (facing, budget) = (facing_of(facing)?, budget((0.0, 0.0, steps)));
        let tree = self.tree("segment")?;
        asked.each(tree.scratch_entries(), |row, scratch| {
            let [a, b] = ends(row);
            match is_ray {
                true => tree.first_hit_of_ray(a, b, facing, budget, scratch),
                false => tree.first_hit(a, b, facing, budget, scratch),
            }
        })
    }

    fn all_hits<'py>(&self, asked: Asked<'py>, is_ray: bool, facing: u8) -> PyResult<Lists<'py>> {
        let (facing, tree, budget) = (facing_of(facing)?, self.tree("segment")?, Budget::EXACT);
        asked.lists(tree.scratch_entries(), TriangleHit::EMPTY, |row, room, scratch| {
            let [a, b] = ends(row);
            let AllHits { stored, dropped, is_complete, .. } = match is_ray {
                true => tree.all_hits_of_ray(a, b, facing, room, budget, scratch),
                false => tree.all_hits(a, b, facing, room, budget, scratch),
            }?;
            Ok(Found { stored, dropped, is_complete })
        })
    }
}
