//! Which triangles may face an eye.

use crate::error::missing;
use crate::model::Model;
use crate::record::Triangle;
use crate::rows::{Found, Lists, QueryRows};
use meshsweep_core::{Bvh, Eye};
use pyo3::prelude::*;

#[pymethods]
impl Model {
    /// Rows have a viewpoint, or with `is_along` the direction of parallel lines of sight.
    fn front_facing<'py>(&self, rows: QueryRows<'py>, is_along: bool) -> PyResult<Lists<'py>> {
        let tree = self.blob().bvh().ok().filter(Bvh::serves_culling);
        let tree = tree.ok_or_else(|| missing("box tree with normal cones", "cull"))?;
        rows.lists(0, Triangle(0), |row, answers, _| {
            let eye = if is_along { Eye::Along(row) } else { Eye::At(row) };
            let mut numbers = vec![0; answers.len()];
            let found = tree.front_facing(eye, &mut numbers)?;
            let stored = &mut numbers[..found.stored];
            stored.sort_unstable();
            answers.iter_mut().zip(stored).for_each(|(place, number)| *place = Triangle(*number));
            Ok(Found { stored: found.stored, dropped: found.dropped, is_complete: true })
        })
    }
}
