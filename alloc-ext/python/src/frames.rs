//! Questions about a mesh that deforms, each row at a key frame or between two. The frame is the
//! last number of a row.

use crate::error::missing;
use crate::model::{BESIDE_HULL, Model, budget};
use crate::pairs::pose;
use crate::rounding::{Way, moved};
use crate::rows::{Found, Lists, QueryRows, Records};
use crate::segments::ends;
use meshsweep::distances::Closest;
use meshsweep_core::{AllHits, Budget, DeformableHull, QueryError, TriangleHit};
use pyo3::prelude::*;

impl Model {
    pub fn deformable(&self) -> PyResult<DeformableHull<'_>> {
        self.blob().deformable_hull().map_err(|_| missing("hull that deforms", "deform"))
    }
}

#[pymethods]
impl Model {
    /// Rows have a point.
    fn closest_point_at<'py>(
        &self,
        rows: QueryRows<'py>,
        limits: (f32, f32, Option<u32>),
    ) -> PyResult<Records<'py>> {
        let (hull, budget) = (self.deformable()?, budget(limits));
        rows.each(hull.scratch_entries() + BESIDE_HULL, |[x, y, z, frame], scratch| {
            let hull = hull.at_frame(frame)?;
            hull.closest_point([x, y, z], budget, scratch).map(Closest::from)
        })
    }

    /// The closest triangles of each point, one after another by a sweep.
    fn nearest_at<'py>(&self, rows: QueryRows<'py>, count: usize) -> PyResult<Records<'py>> {
        let hull = self.deformable()?;
        let count = count.min(hull.rest().triangle_count() as usize);
        let rows = rows.with_each(count);
        rows.each(hull.rest().sweep_entries(), |[x, y, z, frame], scratch| {
            let mut sweep = hull.at_frame(frame)?.sweep([x, y, z], scratch)?;
            let next = |_| sweep.next_triangle(Budget::EXACT)?.ok_or(QueryError::Unchecked);
            (0..count).map(next).collect::<Result<Vec<_>, _>>()
        })
    }

    /// Rows have both ends of a segment, and how far rounding moved each.
    fn first_hit_at<'py>(
        &self,
        rows: QueryRows<'py>,
        steps: Option<u32>,
    ) -> PyResult<Records<'py>> {
        let (hull, budget) = (self.deformable()?, budget((0.0, 0.0, steps)));
        rows.each(hull.scratch_entries() + BESIDE_HULL, |row: [f32; 9], scratch| {
            let ([a, b], hull) = (ends(&row), hull.at_frame(row[8])?);
            let found = hull.first_hit(a, b, budget, scratch)?;
            if !found.is_clear() || moved(&row) <= 0.0 {
                return Ok(found);
            }
            Way::of_segment([a, b], moved(&row)).by_balls(found, |centre| {
                let near = hull.closest_point(centre, budget, scratch)?;
                Ok((near.distance.lower, near.work))
            })
        })
    }

    fn all_hits_at<'py>(&self, rows: QueryRows<'py>) -> PyResult<Lists<'py>> {
        let hull = self.deformable()?;
        let entries = hull.scratch_entries() + BESIDE_HULL;
        rows.lists(entries, TriangleHit::EMPTY, |row: [f32; 9], answers, scratch| {
            let ([a, b], hull) = (ends(&row), hull.at_frame(row[8])?);
            let AllHits { stored, dropped, is_complete, .. } =
                hull.all_hits(a, b, answers, Budget::EXACT, scratch)?;
            Ok(Found { stored, dropped, is_complete })
        })
    }

    /// Whether the surfaces meet. Rows have a pose of the second, which is at rest.
    fn overlap_at<'py>(&self, rows: QueryRows<'py>, other: &Model) -> PyResult<Records<'py>> {
        let hull = self.deformable()?;
        let other = other.blob().hull().map_err(|_| missing("hull hierarchy", "hull"))?;
        rows.each(hull.rest().overlap_entries(&other), |row: [f32; 13], scratch| {
            hull.at_frame(row[12])?.overlap(&other, pose(&row), Budget::EXACT, scratch)
        })
    }
}
