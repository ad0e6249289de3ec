//! Questions about points: of surfaces, and of curves and fences.

use crate::model::{BESIDE_HULL, BEST_FIRST, Model, budget};
use crate::record::write;
use crate::rows::{Failed, Found, Lists, QueryRows, Records, in_blocks};
use meshsweep::bvh::{BATCH, closest_points_until_refused};
use meshsweep::distances::{Closest, Distances, signed_distance};
use meshsweep_core::{AllWithin, Budget, CurveNeighbor, Neighbor};
use numpy::PyArray1;
use pyo3::prelude::*;
use rayon::prelude::*;

/// Tolerances and steps.
type Limits = (f32, f32, Option<u32>);

/// A list without a limit of steps. It is complete: the memory grows until no answer is dropped.
fn complete(AllWithin { stored, dropped, .. }: AllWithin) -> Found {
    Found { stored, dropped, is_complete: true }
}

/// Scratch entries for the questions to a structure.
fn entries(structure: &Distances<'_>) -> usize {
    let more = match structure {
        Distances::Curve(_) => BEST_FIRST,
        Distances::Hull(_) => BESIDE_HULL,
        _ => 0,
    };
    structure.scratch_entries() + more
}

#[pymethods]
impl Model {
    /// With `is_precise` by the box tree alone, its candidates measured in f64.
    fn closest_point<'py>(
        &self,
        rows: QueryRows<'py>,
        limits: Limits,
        is_precise: bool,
    ) -> PyResult<Records<'py>> {
        let budget = budget(limits);
        if is_precise {
            let tree = self.tree("closest")?;
            return rows.each(tree.scratch_entries(), |point, scratch| {
                tree.closest_point_precise(point, budget, scratch).map(Closest::from)
            });
        }
        let structure = self.distances(false)?;
        let Distances::Tree(tree) = structure else {
            return rows.each(entries(&structure), |point, scratch| {
                structure.closest_point(point, budget, scratch)
            });
        };
        let (py, size, mut records) = (rows.py(), rows.size(), rows.zeroed()?);
        let rows = rows.of_width::<3>()?;
        // A search starts from the answers to earlier points of its batch. Blocks are whole
        // batches, so that `work` does not depend on the size of blocks, which depends on time.
        in_blocks(py, rows.len(), BATCH, |block, stop| {
            let (begin, end) = (block.start, block.end);
            let batches = rows[block].par_chunks(BATCH);
            let batches =
                batches.zip(records[begin * size..end * size].par_chunks_mut(BATCH * size));
            let failed = batches.enumerate().find_map_first(|(batch, (rows, records))| {
                if let Err(stopped) = Failed::if_stopped(stop) {
                    return Some(stopped);
                }
                let (found, refused) = closest_points_until_refused(&tree, rows, &budget);
                for (found, record) in found.into_iter().zip(records.chunks_mut(size)) {
                    write(&Closest::from(found), record);
                }
                refused.map(|of| Failed::Row(begin + batch * BATCH + of.index, of.error))
            });
            failed.map_or(Ok(()), Err)
        })?;
        Ok(PyArray1::from_vec(py, records))
    }

    /// Points of a fence have two numbers. The side of a mesh is that of the nearest triangle;
    /// where that is undecided, the side by the winding number, unless `by_nearest_alone`.
    fn signed_distance<'py>(
        &self,
        rows: QueryRows<'py>,
        steps: Option<u32>,
        by_nearest_alone: bool,
    ) -> PyResult<Records<'py>> {
        let budget = budget((0.0, 0.0, steps));
        if let Ok(fence) = self.blob().curve() {
            return rows.each(fence.scratch_entries() + BEST_FIRST, |point: [f32; 2], scratch| {
                fence.signed_distance(point, budget, scratch)
            });
        }
        let tree = self.tree("closest")?;
        rows.each(tree.scratch_entries(), |point, scratch| match by_nearest_alone {
            true => tree.signed_distance(point, budget, scratch),
            false => signed_distance(&tree, point, budget, scratch),
        })
    }

    /// By the field first, without a closest point.
    fn distance_bounds<'py>(&self, rows: QueryRows<'py>, limits: Limits) -> PyResult<Records<'py>> {
        let (both, budget) = (self.tree_with_field("closest")?, budget(limits));
        rows.each(both.tree().scratch_entries(), |point, scratch| {
            both.distance_bounds(point, budget, scratch)
        })
    }

    /// By the field first, with a side.
    fn signed_bounds<'py>(&self, rows: QueryRows<'py>, limits: Limits) -> PyResult<Records<'py>> {
        let (both, budget) = (self.tree_with_field("closest")?, budget(limits));
        rows.each(both.tree().scratch_entries(), |point, scratch| {
            both.signed_bounds(point, budget, scratch)
        })
    }

    /// Rows have a point and a distance.
    fn within<'py>(
        &self,
        rows: QueryRows<'py>,
        steps: Option<u32>,
        field_first: bool,
    ) -> PyResult<Records<'py>> {
        let (structure, budget) = (self.distances(field_first)?, budget((0.0, 0.0, steps)));
        let is_curve = matches!(structure, Distances::Curve(_));
        rows.each(entries(&structure), |[x, y, z, distance], scratch| {
            Ok((structure.any_within([x, y, z], distance, budget, scratch)?, is_curve))
        })
    }

    fn nearest<'py>(&self, rows: QueryRows<'py>, count: usize) -> PyResult<Records<'py>> {
        if let Ok(curve) = self.blob().curve() {
            let count = count.min(curve.segment_count() as usize);
            let entries = curve.scratch_entries() + BEST_FIRST;
            return rows.with_each(count).each(entries, |point, scratch| {
                let mut answers = vec![CurveNeighbor::EMPTY; count];
                curve.nearest(point, &mut answers, Budget::EXACT, scratch).map(|_| answers)
            });
        }
        let tree = self.tree("closest")?;
        let count = count.min(tree.triangle_count() as usize);
        rows.with_each(count).each(tree.scratch_entries(), |point, scratch| {
            let mut answers = vec![Neighbor::EMPTY; count];
            tree.nearest(point, &mut answers, Budget::EXACT, scratch).map(|_| answers)
        })
    }

    fn all_within<'py>(&self, rows: QueryRows<'py>, distance: f32) -> PyResult<Lists<'py>> {
        if let Ok(curve) = self.blob().curve() {
            let entries = curve.scratch_entries() + BEST_FIRST;
            return rows.lists(entries, CurveNeighbor::EMPTY, |point, answers, scratch| {
                curve.all_within(point, distance, answers, Budget::EXACT, scratch).map(complete)
            });
        }
        let tree = self.tree("closest")?;
        rows.lists(tree.scratch_entries(), Neighbor::EMPTY, |point, answers, scratch| {
            tree.all_within(point, distance, answers, Budget::EXACT, scratch).map(complete)
        })
    }

    fn winding_number<'py>(&self, rows: QueryRows<'py>) -> PyResult<Records<'py>> {
        let tree = self.tree("winding")?;
        rows.each(tree.scratch_entries(), |point, scratch| {
            tree.winding_number(point, Budget::EXACT, scratch)
        })
    }

    /// Distance, side and gradient by the distance field.
    fn field_distance<'py>(&self, rows: QueryRows<'py>) -> PyResult<Records<'py>> {
        let field = self.field_alone()?;
        rows.each(0, |point, _| field.distance_and_gradient(point))
    }

    /// A verdict by the distance field alone. Rows have a point and a distance.
    fn field_within<'py>(&self, rows: QueryRows<'py>) -> PyResult<Records<'py>> {
        let field = self.field_alone()?;
        rows.each(0, |[x, y, z, distance], _| field.within([x, y, z], distance))
    }
}
