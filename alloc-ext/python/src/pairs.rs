//! Questions about two models, the second at many poses or on its way between two.

use crate::model::{Model, budget};
use crate::rows::{Found, Lists, QueryRows, Records};
use meshsweep::bvh::FastBvh;
use meshsweep_core::{AllOverlaps, Budget, Bvh, Motion, Pose, TrianglePair};
use pyo3::prelude::*;

/// A pose of a row: three rows of a matrix, each with its part of the translation.
pub fn pose(row: &[f32]) -> Pose {
    let entry = |at: usize| row.get(at).copied().unwrap_or_default();
    let rotation = core::array::from_fn(|r| core::array::from_fn(|c| entry(4 * r + c)));
    Pose::rigid(rotation, [3, 7, 11].map(entry))
}

/// With these entries no question about two models ends for lack of memory.
fn entries(pair: &[FastBvh<'_>; 2]) -> usize {
    let most = pair.iter().map(|tree| tree.scratch_entries()).fold(0, usize::max);
    most.max(Bvh::DISTANCE_ENTRIES).max(Bvh::OVERLAP_ENTRIES)
}

impl Model {
    /// Both box trees, built for this word.
    pub fn pair<'a>(&'a self, other: &'a Model, word: &'static str) -> PyResult<[FastBvh<'a>; 2]> {
        Ok([self.tree(word)?, other.tree(word)?])
    }
}

#[pymethods]
impl Model {
    /// The distance of both surfaces at each pose of the second.
    fn distance_to<'py>(
        &self,
        rows: QueryRows<'py>,
        other: &Model,
        rel: f32,
        abs: f32,
    ) -> PyResult<Records<'py>> {
        let (pair, budget) = (self.pair(other, "segment")?, budget((rel, abs, None)));
        rows.each(entries(&pair), |row: [f32; 12], scratch| {
            pair[0].distance_to(&pair[1], pose(&row), budget, scratch)
        })
    }

    /// Whether the surfaces are within a distance.
    fn within_of<'py>(
        &self,
        rows: QueryRows<'py>,
        other: &Model,
        distance: f32,
    ) -> PyResult<Records<'py>> {
        let pair = self.pair(other, "segment")?;
        rows.each(entries(&pair), |row: [f32; 12], scratch| {
            pair[0].within_of(&pair[1], pose(&row), distance, Budget::EXACT, scratch)
        })
    }

    /// Whether the surfaces meet.
    fn overlap<'py>(&self, rows: QueryRows<'py>, other: &Model) -> PyResult<Records<'py>> {
        let both = self.both(other)?;
        rows.each(both.entries(), |row: [f32; 12], scratch| both.overlap(pose(&row), scratch))
    }

    /// The pairs of triangles that meet or may meet.
    fn all_overlaps<'py>(&self, rows: QueryRows<'py>, other: &Model) -> PyResult<Lists<'py>> {
        let both = self.both(other)?.knows_triangles()?;
        rows.lists(both.entries(), TrianglePair::EMPTY, |row: [f32; 12], answers, scratch| {
            let AllOverlaps { stored, dropped, .. } =
                both.all_overlaps(pose(&row), answers, scratch)?;
            Ok(Found { stored, dropped, is_complete: true })
        })
    }

    /// How both solids lie to each other, and how deep they are in each other.
    fn penetration<'py>(
        &self,
        rows: QueryRows<'py>,
        other: &Model,
        limits: (f32, f32, Option<u32>),
    ) -> PyResult<Records<'py>> {
        for word in ["closest", "segment"] {
            self.pair(other, word)?;
        }
        let (pair, budget) = (self.pair(other, "winding")?, budget(limits));
        rows.each(entries(&pair), |row: [f32; 12], scratch| {
            pair[0].penetration(&pair[1], pose(&row), budget, scratch)
        })
    }

    /// How far each move of the second keeps the distance. Rows have two poses.
    fn first_contact_of<'py>(
        &self,
        rows: QueryRows<'py>,
        other: &Model,
        is_straight: bool,
        clearance: f32,
    ) -> PyResult<Records<'py>> {
        let pair = self.pair(other, "segment")?;
        rows.each(entries(&pair), |row: [f32; 24], scratch| {
            let (from, to) = (pose(&row[..12]), pose(&row[12..]));
            let motion = match is_straight {
                true => Motion::straight(from, to),
                false => Motion::screw(from, to)?,
            };
            pair[0].first_contact_of(&pair[1], &motion, clearance, Budget::EXACT, scratch)
        })
    }
}
