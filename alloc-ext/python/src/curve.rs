//! Questions to curves alone: their nearest segments, and the sides of a fence.

use crate::error::missing;
use crate::model::{Model, ROOM, budget, scratch};
use crate::record::Put;
use crate::rows::{Lists, Records, Rows, ask, ask_many};
use meshsweep_core::{Budget, Curve, CurveNeighbor};
use pyo3::prelude::*;

/// More scratch entries than a curve needs: with these, searches go best first.
pub const BEST_FIRST: usize = 256;

fn put_neighbor(put: &mut Put<'_>, near: &CurveNeighbor) {
    put.interval(near.distance()).floats(&near.point());
    put.segment(Some(near.segment()));
}

impl Model {
    fn curve(&self) -> PyResult<Curve<'_>> {
        self.blob().curve().map_err(|_| missing("curves", "curve"))
    }
}

#[pymethods]
impl Model {
    /// The sides and distances of points of the plane.
    fn signed_distance_of_fence<'py>(
        &self,
        py: Python<'py>,
        points: Rows<'py>,
        steps: Option<u32>,
        size: usize,
    ) -> PyResult<Records<'py>> {
        let (fence, budget) = (self.curve()?, budget(0.0, 0.0, steps));
        ask::<2, _>(py, &points, size, || {
            let mut scratch = scratch(fence.scratch_entries() + BEST_FIRST);
            move |point, mut put| {
                let found = fence.signed_distance(point, budget, &mut scratch)?;
                let near = found.closest;
                put.interval(found.distance).side(found.side).floats(&near.point);
                put.segment(Some(near.segment))
                    .floats(&[near.safe_motion])
                    .ended(near.ended)
                    .count(near.work.total());
                Ok(())
            }
        })
    }

    fn nearest_on_curve<'py>(
        &self,
        py: Python<'py>,
        points: Rows<'py>,
        count: usize,
        size: usize,
    ) -> PyResult<Records<'py>> {
        let curve = self.curve()?;
        let count = count.min(curve.segment_count() as usize);
        ask(py, &points, size * count, || {
            let mut scratch = scratch(curve.scratch_entries() + BEST_FIRST);
            let mut room = vec![CurveNeighbor::EMPTY; count];
            move |point, mut put| {
                curve.nearest(point, &mut room, Budget::EXACT, &mut scratch)?;
                room.iter().for_each(|near| put_neighbor(&mut put, near));
                Ok(())
            }
        })
    }

    fn all_within_on_curve<'py>(
        &self,
        py: Python<'py>,
        points: Rows<'py>,
        distance: f32,
        size: usize,
    ) -> PyResult<Lists<'py>> {
        let curve = self.curve()?;
        ask_many(py, &points, size, || {
            let mut scratch = scratch(curve.scratch_entries() + BEST_FIRST);
            let mut room = vec![CurveNeighbor::EMPTY; ROOM];
            move |point, records| {
                let mut ask = |room: &mut Vec<_>| {
                    curve.all_within(point, distance, room, Budget::EXACT, &mut scratch)
                };
                let mut all = ask(&mut room)?;
                if all.dropped > 0 {
                    room.resize(all.stored + all.dropped as usize, CurveNeighbor::EMPTY);
                    all = ask(&mut room)?;
                }
                for (index, near) in room.iter().take(all.stored).enumerate() {
                    let begin = records.len();
                    records.resize(begin + size, 0);
                    let mut put = Put::new(&mut records[begin..]);
                    put_neighbor(&mut put, near);
                    put.byte(u8::from(index < all.certain));
                }
                // With memory for all and without a limit of steps none is missing.
                Ok(true)
            }
        })
    }
}
