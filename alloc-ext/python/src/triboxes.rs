//! Questions to stored triboxes, which prove that something is clear and never the opposite, and
//! their geometry.

use crate::error::missing;
use crate::model::{Model, budget};
use crate::pairs::pose;
use crate::record::Clipped;
use crate::rounding::{Way, moved};
use crate::rows::{Found, Lists, QueryRows, Records};
use crate::segments::ends;
use meshsweep_core::{Budget, Ended, NodePair, TriboxCandidates, Triboxes};
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
        rows: QueryRows<'py>,
        steps: Option<u32>,
    ) -> PyResult<Records<'py>> {
        let (triboxes, budget) = (self.stored_triboxes()?, budget((0.0, 0.0, steps)));
        rows.each(triboxes.scratch_entries(), |point, scratch| {
            triboxes.distance(point, budget, scratch)
        })
    }

    /// The parameter before which each segment is clear. Rows have both ends, and how far rounding
    /// moved each.
    fn tribox_first_hit<'py>(
        &self,
        rows: QueryRows<'py>,
        steps: Option<u32>,
    ) -> PyResult<Records<'py>> {
        let (triboxes, budget) = (self.stored_triboxes()?, budget((0.0, 0.0, steps)));
        rows.each(triboxes.scratch_entries(), |row: [f32; 8], scratch| {
            let [a, b] = ends(&row);
            let mut found = triboxes.clip(a, b, budget, scratch)?;
            if found.lower == f32::INFINITY && moved(&row) > 0.0 {
                let mut last = None;
                let (fraction, work) = Way::of_segment([a, b], moved(&row)).cleared(|centre| {
                    let near = triboxes.distance(centre, budget, scratch)?;
                    last = near.node;
                    Ok((near.lower, near.work))
                })?;
                found.work = found.work.and(work);
                if fraction < 1.0 {
                    (found.node, found.ended) = (last, Ended::Resolution);
                    found.lower = (fraction as f32).next_down().max(0.0);
                }
            }
            Ok(Clipped(found))
        })
    }

    /// Whether both are farther than a distance from each other, at each pose of the second.
    fn tribox_within_of<'py>(
        &self,
        rows: QueryRows<'py>,
        other: &Model,
        distance: f32,
    ) -> PyResult<Records<'py>> {
        let (first, second) = (self.stored_triboxes()?, other.stored_triboxes()?);
        rows.each(first.separation_entries(&second), |row: [f32; 12], scratch| {
            first.within_of(&second, pose(&row), distance, Budget::EXACT, scratch)
        })
    }

    /// The pairs of triboxes that may meet.
    fn tribox_candidates<'py>(&self, rows: QueryRows<'py>, other: &Model) -> PyResult<Lists<'py>> {
        let (first, second) = (self.stored_triboxes()?, other.stored_triboxes()?);
        let entries = first.separation_entries(&second);
        rows.lists(entries, NodePair::EMPTY, |row: [f32; 12], answers, scratch| {
            let TriboxCandidates { stored, dropped, .. } =
                first.candidates(&second, pose(&row), answers, Budget::EXACT, scratch)?;
            Ok(Found { stored, dropped, is_complete: true })
        })
    }
}
