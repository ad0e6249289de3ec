//! Questions about two models, the second at many poses.

use crate::model::{Model, budget};
use crate::record::ended;
use crate::rows::{Records, Rows, ask};
use meshsweep_core::{Bvh, Pose, ScratchEntry};
use pyo3::prelude::*;

/// A pose of a row: three rows of a matrix, each with its part of the translation.
pub fn pose(row: &[f32]) -> Pose {
    let entry = |at: usize| row.get(at).copied().unwrap_or_default();
    let rotation = core::array::from_fn(|r| core::array::from_fn(|c| entry(4 * r + c)));
    Pose::rigid(rotation, [3, 7, 11].map(entry))
}

#[pymethods]
impl Model {
    /// The distance of both surfaces at each pose of the second.
    fn distance_to<'py>(
        &self,
        py: Python<'py>,
        other: &Model,
        poses: Rows<'py>,
        rel: f32,
        abs: f32,
        size: usize,
    ) -> PyResult<Records<'py>> {
        let trees = [self.tree("segment")?, other.tree("segment")?];
        let budget = budget(rel, abs, None);
        ask::<12, _>(py, &poses, size, || {
            let mut scratch = [ScratchEntry::EMPTY; Bvh::DISTANCE_ENTRIES];
            move |row, mut put| {
                let [first, second] = &trees;
                let found = first.distance_to(second, pose(&row), budget, &mut scratch)?;
                put.interval(found.distance).floats(found.points.as_flattened());
                let [a, b] = found.triangles;
                put.number(Some(a)).number(Some(b)).ended(found.ended);
                put.count(found.work.total());
                Ok(())
            }
        })
    }

    /// Whether the surfaces are within a distance, or meet if there is none.
    fn meets<'py>(
        &self,
        py: Python<'py>,
        other: &Model,
        poses: Rows<'py>,
        distance: Option<f32>,
        size: usize,
    ) -> PyResult<Records<'py>> {
        let trees = [self.tree("segment")?, other.tree("segment")?];
        let budget = budget(0.0, 0.0, None);
        ask::<12, _>(py, &poses, size, || {
            let mut scratch = [ScratchEntry::EMPTY; Bvh::DISTANCE_ENTRIES];
            move |row, mut put| {
                let ([first, second], pose) = (&trees, pose(&row));
                let found = match distance {
                    Some(d) => first.within_of(second, pose, d, budget, &mut scratch),
                    None => first.overlap(second, pose, budget, &mut scratch),
                }?;
                let [a, b] = found.witness.map_or([None; 2], |pair| pair.map(Some));
                put.verdict(found.verdict).number(a).number(b).ended(ended(found.verdict));
                put.count(found.work.total());
                Ok(())
            }
        })
    }
}
