//! Questions to stored triboxes, which prove that something is clear and never the opposite, and
//! their geometry.

use crate::error::missing;
use crate::model::{Model, budget, scratch};
use crate::pairs::pose;
use crate::rows::{Records, Rows, ask};
use meshsweep_core::Triboxes;
use numpy::PyArray1;
use pyo3::prelude::*;

/// A union of triboxes, as flat arrays.
#[derive(IntoPyObject)]
pub struct Geometry<'py> {
    nodes: Bound<'py, PyArray1<u32>>,
    low: Bound<'py, PyArray1<f32>>,
    high: Bound<'py, PyArray1<f32>>,
    corners: Bound<'py, PyArray1<f32>>,
    frame: [[f32; 3]; 3],
    is_solid: bool,
    distance: Option<f32>,
}

impl Model {
    fn stored_triboxes(&self) -> PyResult<Triboxes<'_>> {
        self.blob().triboxes().map_err(|_| missing("triboxes", "triboxes"))
    }
}

#[pymethods]
impl Model {
    /// The union of at most `count` triboxes; of all without.
    fn triboxes<'py>(&self, py: Python<'py>, count: Option<u32>) -> PyResult<Geometry<'py>> {
        let all = self.stored_triboxes()?;
        let triboxes = count.map_or(all, |count| all.coarser(count));
        let leaves: Vec<_> = triboxes.leaves().collect();
        let floats = |floats: Vec<f32>| PyArray1::from_vec(py, floats);
        let mut levels = all.levels();
        Ok(Geometry {
            nodes: PyArray1::from_iter(py, leaves.iter().map(|(node, _)| *node)),
            low: floats(leaves.iter().flat_map(|(_, tribox)| tribox.low).collect()),
            high: floats(leaves.iter().flat_map(|(_, tribox)| tribox.high).collect()),
            corners: floats(
                leaves.iter().flat_map(|(_, tribox)| tribox.corners()).flatten().collect(),
            ),
            frame: triboxes.orientation(),
            is_solid: triboxes.is_solid(),
            distance: levels
                .find(|level| level.triboxes == triboxes.leaf_count())
                .map(|level| level.distance),
        })
    }

    /// A lower bound of each point's distance.
    fn tribox_distance<'py>(
        &self,
        py: Python<'py>,
        points: Rows<'py>,
        steps: Option<u32>,
        size: usize,
    ) -> PyResult<Records<'py>> {
        let (triboxes, budget) = (self.stored_triboxes()?, budget(0.0, 0.0, steps));
        ask::<3, _>(py, &points, size, || {
            let mut scratch = scratch(triboxes.scratch_entries());
            move |point, mut put| {
                let found = triboxes.distance(point, budget, &mut scratch)?;
                put.floats(&[found.lower]).number(found.node);
                put.ended(found.ended).count(found.work.total());
                Ok(())
            }
        })
    }

    /// The parameter before which each segment is clear. Rows have both ends.
    fn tribox_hit<'py>(
        &self,
        py: Python<'py>,
        rows: Rows<'py>,
        steps: Option<u32>,
        size: usize,
    ) -> PyResult<Records<'py>> {
        let (triboxes, budget) = (self.stored_triboxes()?, budget(0.0, 0.0, steps));
        ask(py, &rows, size, || {
            let mut scratch = scratch(triboxes.scratch_entries());
            move |[ax, ay, az, bx, by, bz], mut put| {
                let found = triboxes.clip([ax, ay, az], [bx, by, bz], budget, &mut scratch)?;
                put.is_clear(found.lower == f32::INFINITY).floats(&[found.lower]);
                put.number(found.node).ended(found.ended).count(found.work.total());
                Ok(())
            }
        })
    }

    /// Whether both are farther than a distance from each other, at each pose of the second.
    fn tribox_separation<'py>(
        &self,
        py: Python<'py>,
        other: &Model,
        poses: Rows<'py>,
        distance: f32,
        size: usize,
    ) -> PyResult<Records<'py>> {
        let (first, second) = (self.stored_triboxes()?, other.stored_triboxes()?);
        let budget = budget(0.0, 0.0, None);
        ask::<12, _>(py, &poses, size, || {
            let mut scratch = scratch(first.separation_entries(&second));
            move |row, mut put| {
                let found = first.within_of(&second, pose(&row), distance, budget, &mut scratch)?;
                put.is_clear(found.is_apart());
                put.number(found.may_meet.map(|pair| pair.a.into()));
                put.number(found.may_meet.map(|pair| pair.b.into()));
                put.ended(found.ended).count(found.work.total());
                Ok(())
            }
        })
    }
}
