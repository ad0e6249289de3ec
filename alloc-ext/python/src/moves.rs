//! Questions about moves: of a convex tool, and of another model.

use crate::error::of_query;
use crate::model::{Model, budget, scratch};
use crate::pairs::pose;
use crate::rows::{Records, Rows, ask, rows};
use meshsweep_core::{Bvh, Ended, FirstHit, Motion, ScratchEntry, Solid};
use pyo3::prelude::*;

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

#[pymethods]
impl Model {
    /// The first contact of a convex tool that is carried along each segment. Rows of `tool` are
    /// its corners, others have both ends of a move.
    fn first_contact<'py>(
        &self,
        py: Python<'py>,
        moves: Rows<'py>,
        tool: Rows<'py>,
        radius: f64,
        steps: Option<u32>,
        size: usize,
    ) -> PyResult<Records<'py>> {
        let (tree, budget) = (self.tree("segment")?, budget(0.0, 0.0, steps));
        let tool = rows::<3>(&tool)?;
        Solid::new(tool, radius as f32).map_err(|error| of_query(None, error))?;
        ask(py, &moves, size, || {
            let mut scratch = scratch(tree.scratch_entries());
            move |[ax, ay, az, bx, by, bz], mut put| {
                let (from, off) = placed(tool, [ax, ay, az]);
                let (to, off_there) = placed(tool, [bx, by, bz]);
                let mut ask = |radius| {
                    let (from, to) = (Solid::new(&from, radius)?, Solid::new(&to, radius)?);
                    tree.solid_first_contact(&from, &to, budget, &mut scratch)
                };
                let moved = off.max(off_there);
                if moved <= 0.0 && f64::from(radius as f32) == radius {
                    put.first_hit(&ask(radius as f32)?);
                    return Ok(());
                }
                // The tool is within the larger one, and holds the smaller one, at every instant.
                let mut found = ask(((radius + moved) as f32).next_up())?;
                if !found.is_clear() {
                    let less = ((radius - moved) as f32).next_down();
                    let inner = if less >= 0.0 { Some(ask(less)?) } else { None };
                    let is_met =
                        |inner: &FirstHit| inner.hit.is_some() && inner.ended == Ended::Exact;
                    let inner = inner.filter(is_met);
                    found.t.upper = inner.map_or(1.0, |inner| inner.t.upper);
                    found.ended = match (found.ended, inner) {
                        (Ended::Exact, None) => Ended::Resolution,
                        (Ended::Resolution, Some(_)) => Ended::Exact,
                        (ended, _) => ended,
                    };
                }
                put.first_hit(&found);
                Ok(())
            }
        })
    }

    /// How far each move of the second keeps the distance. Rows have two poses.
    fn first_contact_of<'py>(
        &self,
        py: Python<'py>,
        other: &Model,
        moves: Rows<'py>,
        is_straight: bool,
        keep: f32,
        size: usize,
    ) -> PyResult<Records<'py>> {
        let trees = [self.tree("segment")?, other.tree("segment")?];
        let budget = budget(0.0, 0.0, None);
        ask::<24, _>(py, &moves, size, || {
            let mut scratch = [ScratchEntry::EMPTY; Bvh::DISTANCE_ENTRIES];
            move |row, mut put| {
                let (from, to) = (pose(&row[..12]), pose(&row[12..]));
                let motion = match is_straight {
                    true => Motion::straight(from, to),
                    false => Motion::screw(from, to)?,
                };
                let [first, second] = &trees;
                let found = first.first_contact_of(second, &motion, keep, budget, &mut scratch)?;
                put.is_clear(found.is_clear()).floats(&[found.clear_until]);
                put.floats(found.points.as_flattened());
                let [a, b] = found.triangles;
                put.number(Some(a)).number(Some(b)).ended(found.ended);
                put.count(found.work.total());
                Ok(())
            }
        })
    }
}
