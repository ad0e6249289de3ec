//! Questions about convex solids, at rest and on their way.

use crate::error::of_query;
use crate::model::{Model, budget};
use crate::rows::{QueryRows, Records};
use crate::segments::ends;
use meshsweep_core::{
    Budget, Bvh, BvhWithSdf, Decided, Ended, FirstHit, QueryError, ScratchEntry, Solid,
};
use numpy::PyReadonlyArray2;
use pyo3::prelude::*;

/// The corners of a row, and the number after them.
fn corners(row: &[f32]) -> (&[[f32; 3]], f32) {
    let (corners, rest) = row.as_chunks::<3>();
    (corners, rest.first().copied().unwrap_or_default())
}

/// A box tree, perhaps with a distance field, which is asked first.
pub struct SolidQueries<'a> {
    pub tree: Bvh<'a>,
    pub with_field: Option<BvhWithSdf<'a>>,
}

impl SolidQueries<'_> {
    fn within(
        &self,
        solid: &Solid<'_>,
        distance: f32,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<Decided<u32>, QueryError> {
        match &self.with_field {
            None => self.tree.solid_within(solid, distance, budget, scratch),
            Some(both) => both.solid_within(solid, distance, budget, scratch),
        }
    }

    /// The first contact of a solid that moves from one pair of corners to the other. No corner is
    /// farther than `moved` from where the caller wants it, at any instant.
    ///
    /// # Errors
    /// Those of the question.
    pub fn first_contact(
        &self,
        [from, to]: [&[[f32; 3]]; 2],
        radius: f64,
        moved: f64,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<FirstHit, QueryError> {
        let mut with_radius = |radius| {
            let (from, to) = (Solid::new(from, radius)?, Solid::new(to, radius)?);
            match &self.with_field {
                None => self.tree.solid_first_contact(&from, &to, budget, scratch),
                Some(both) => both.solid_first_contact(&from, &to, budget, scratch),
            }
        };
        if moved <= 0.0 && f64::from(radius as f32) == radius {
            return with_radius(radius as f32);
        }
        // The solid is within the larger one, and holds the smaller one, at every instant.
        let mut found = with_radius(((radius + moved) as f32).next_up())?;
        if !found.is_clear() {
            let less = ((radius - moved) as f32).next_down();
            let inner = if less >= 0.0 { Some(with_radius(less)?) } else { None };
            let is_met = |inner: &FirstHit| inner.hit.is_some() && inner.ended == Ended::Exact;
            let inner = inner.filter(is_met);
            found.t.upper = inner.map_or(1.0, |inner| inner.t.upper);
            found.ended = match (found.ended, inner) {
                (Ended::Exact, None) => Ended::Resolution,
                (Ended::Resolution, Some(_)) => Ended::Exact,
                (ended, _) => ended,
            };
        }
        Ok(found)
    }
}

/// The corners of a tool at a place, rounded, and no less than how far rounding moved one.
fn placed(tool: &[[f32; 3]], place: [f32; 3]) -> (Vec<[f32; 3]>, f64) {
    let at = |corner: &[f32; 3]| core::array::from_fn(|k| corner[k] + place[k]);
    let corners: Vec<[f32; 3]> = tool.iter().map(at).collect();
    let off = |(corner, at): (&[f32; 3], &[f32; 3])| {
        let axis = |k: usize| {
            // The error of a sum is a number of the same precision (Knuth's two-sum).
            let (a, b, sum) = (corner[k], place[k], at[k]);
            let part = sum - a;
            f64::from((a - (sum - part)) + (b - part)).abs()
        };
        (0..3).map(axis).sum()
    };
    let moved = tool.iter().zip(&corners).map(off).fold(0.0, f64::max);
    (corners, moved)
}

impl Model {
    fn solid_queries(&self, field_first: bool) -> PyResult<SolidQueries<'_>> {
        let with_field = field_first.then(|| self.tree_with_field("segment")).transpose()?;
        Ok(SolidQueries { tree: *self.tree("segment")?, with_field })
    }
}

#[pymethods]
impl Model {
    /// Rows have the corners.
    fn solid_distance<'py>(
        &self,
        rows: QueryRows<'py>,
        radius: f32,
        limits: (f32, f32, Option<u32>),
    ) -> PyResult<Records<'py>> {
        let (tree, budget) = (self.tree("segment")?, budget(limits));
        rows.each_wide(tree.scratch_entries(), |row, scratch| {
            tree.solid_distance(&Solid::new(corners(row).0, radius)?, budget, scratch)
        })
    }

    /// Rows have the corners and a distance.
    fn solid_within<'py>(
        &self,
        rows: QueryRows<'py>,
        radius: f32,
        steps: Option<u32>,
        field_first: bool,
    ) -> PyResult<Records<'py>> {
        let (queries, budget) = (self.solid_queries(field_first)?, budget((0.0, 0.0, steps)));
        rows.each_wide(queries.tree.scratch_entries(), |row, scratch| {
            let (corners, distance) = corners(row);
            queries.within(&Solid::new(corners, radius)?, distance, budget, scratch)
        })
    }

    /// The first contact of each solid on its way. Rows have the corners at the start, those at the
    /// end, and how far rounding moved one of them at most.
    fn solid_first_contact<'py>(
        &self,
        rows: QueryRows<'py>,
        radius: f64,
        steps: Option<u32>,
        field_first: bool,
    ) -> PyResult<Records<'py>> {
        let (queries, budget) = (self.solid_queries(field_first)?, budget((0.0, 0.0, steps)));
        rows.each_wide(queries.tree.scratch_entries(), |row, scratch| {
            let (corners, moved) = corners(row);
            let (from, to) = corners.split_at(corners.len() / 2);
            queries.first_contact([from, to], radius, moved.into(), budget, scratch)
        })
    }

    /// The first contact of one tool that is carried along each segment. Rows of `tool` are its
    /// corners, others have both ends of a move, and how far rounding moved them and the corners.
    fn first_contact<'py>(
        &self,
        rows: QueryRows<'py>,
        tool: PyReadonlyArray2<'py, f32>,
        radius: f64,
        steps: Option<u32>,
    ) -> PyResult<Records<'py>> {
        let (queries, budget) = (self.solid_queries(false)?, budget((0.0, 0.0, steps)));
        let tool = tool.as_slice()?.as_chunks::<3>().0;
        Solid::new(tool, radius as f32).map_err(|error| of_query(None, error))?;
        rows.each(queries.tree.scratch_entries(), |row: [f32; 7], scratch| {
            let [(from, off), (to, off_there)] = ends(&row).map(|place| placed(tool, place));
            let moved = off.max(off_there) + f64::from(row[6]);
            queries.first_contact([&from, &to], radius, moved, budget, scratch)
        })
    }
}
