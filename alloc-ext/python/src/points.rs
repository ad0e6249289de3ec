//! Questions about points: of surfaces, and of curves and fences.

use crate::model::{BESIDE_HULL, BEST_FIRST, Model, budget};
use crate::record::{Answer, Put};
use crate::rows::{Asked, Found, Lists, Records, in_blocks};
use meshsweep::bvh::{BATCH, closest_points_until_refused};
use meshsweep::distances::{Closest, Distances, signed_distance};
use meshsweep_core::{AllWithin, Budget, CurveNeighbor, Neighbor};
use numpy::PyArray1;
use pyo3::prelude::*;

/// Tolerances and steps.
type Limits = (f32, f32, Option<u32>);

/// With memory for all and without a limit of steps none is missing.
fn all(AllWithin { stored, dropped, .. }: AllWithin) -> Found {
    Found { stored, dropped, is_complete: true }
}

/// Scratch memory that a structure is asked with.
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
        asked: Asked<'py>,
        limits: Limits,
        is_precise: bool,
    ) -> PyResult<Records<'py>> {
        let budget = budget(limits);
        if is_precise {
            let tree = self.tree("closest")?;
            return asked.each(tree.scratch_entries(), |point, scratch| {
                tree.closest_point_precise(point, budget, scratch).map(Closest::from)
            });
        }
        let structure = self.distances(false)?;
        let Distances::Tree(tree) = structure else {
            return asked.each(entries(&structure), |point, scratch| {
                structure.closest_point(point, budget, scratch)
            });
        };
        let (py, size, rows) = (asked.py(), asked.size(), asked.rows::<3>()?);
        let mut records = asked.zeroed()?;
        // Blocks of whole batches: then the work depends on no time.
        in_blocks(py, rows.len(), BATCH, |block| {
            let records = &mut records[block.start * size..];
            let begin = block.start;
            let (found, refused) = closest_points_until_refused(&tree, &rows[block], &budget);
            for (found, record) in found.into_iter().zip(records.chunks_mut(size)) {
                Closest::from(found).put(&mut Put::new(record));
            }
            refused.map_or(Ok(()), |refused| Err((begin + refused.index, refused.error).into()))
        })?;
        Ok(PyArray1::from_vec(py, records))
    }

    /// Of a fence, whose points have two numbers; else with the side of the nearest triangle, else
    /// that of the winding number. `by_nearest_alone` leaves that out.
    fn signed_distance<'py>(
        &self,
        asked: Asked<'py>,
        steps: Option<u32>,
        by_nearest_alone: bool,
    ) -> PyResult<Records<'py>> {
        let budget = budget((0.0, 0.0, steps));
        if let Ok(fence) = self.blob().curve() {
            return asked.each(fence.scratch_entries() + BEST_FIRST, |point: [f32; 2], scratch| {
                fence.signed_distance(point, budget, scratch)
            });
        }
        let tree = self.tree("closest")?;
        asked.each(tree.scratch_entries(), |point, scratch| match by_nearest_alone {
            true => tree.signed_distance(point, budget, scratch),
            false => signed_distance(&tree, point, budget, scratch),
        })
    }

    /// By the field first, without a closest point.
    fn distance_bounds<'py>(&self, asked: Asked<'py>, limits: Limits) -> PyResult<Records<'py>> {
        let (both, budget) = (self.tree_with_field("closest")?, budget(limits));
        asked.each(both.tree().scratch_entries(), |point, scratch| {
            both.distance_bounds(point, budget, scratch)
        })
    }

    /// By the field first, with a side.
    fn signed_bounds<'py>(&self, asked: Asked<'py>, limits: Limits) -> PyResult<Records<'py>> {
        let (both, budget) = (self.tree_with_field("closest")?, budget(limits));
        asked.each(both.tree().scratch_entries(), |point, scratch| {
            both.signed_bounds(point, budget, scratch)
        })
    }

    /// Rows have a point and a distance.
    fn within<'py>(
        &self,
        asked: Asked<'py>,
        steps: Option<u32>,
        field_first: bool,
    ) -> PyResult<Records<'py>> {
        let (structure, budget) = (self.distances(field_first)?, budget((0.0, 0.0, steps)));
        let is_curve = matches!(structure, Distances::Curve(_));
        asked.each(entries(&structure), |[x, y, z, distance], scratch| {
            Ok((structure.any_within([x, y, z], distance, budget, scratch)?, is_curve))
        })
    }

    fn nearest<'py>(&self, asked: Asked<'py>, count: usize) -> PyResult<Records<'py>> {
        if let Ok(curve) = self.blob().curve() {
            let count = count.min(curve.segment_count() as usize);
            let entries = curve.scratch_entries() + BEST_FIRST;
            return asked.with_each(count).each(entries, |point, scratch| {
                let mut room = vec![CurveNeighbor::EMPTY; count];
                curve.nearest(point, &mut room, Budget::EXACT, scratch).map(|_| room)
            });
        }
        let tree = self.tree("closest")?;
        let count = count.min(tree.triangle_count() as usize);
        asked.with_each(count).each(tree.scratch_entries(), |point, scratch| {
            let mut room = vec![Neighbor::EMPTY; count];
            tree.nearest(point, &mut room, Budget::EXACT, scratch).map(|_| room)
        })
    }

    fn all_within<'py>(&self, asked: Asked<'py>, distance: f32) -> PyResult<Lists<'py>> {
        if let Ok(curve) = self.blob().curve() {
            let entries = curve.scratch_entries() + BEST_FIRST;
            return asked.lists(entries, CurveNeighbor::EMPTY, |point, room, scratch| {
                curve.all_within(point, distance, room, Budget::EXACT, scratch).map(all)
            });
        }
        let tree = self.tree("closest")?;
        asked.lists(tree.scratch_entries(), Neighbor::EMPTY, |point, room, scratch| {
            tree.all_within(point, distance, room, Budget::EXACT, scratch).map(all)
        })
    }

    fn winding_number<'py>(&self, asked: Asked<'py>) -> PyResult<Records<'py>> {
        let tree = self.tree("winding")?;
        asked.each(tree.scratch_entries(), |point, scratch| {
            tree.winding_number(point, Budget::EXACT, scratch)
        })
    }

    /// Distance, side and gradient by the distance field.
    fn field<'py>(&self, asked: Asked<'py>) -> PyResult<Records<'py>> {
        let field = self.field_alone()?;
        asked.each(0, |point, _| field.distance_and_gradient(point))
    }

    /// A verdict by the distance field alone. Rows have a point and a distance.
    fn field_within<'py>(&self, asked: Asked<'py>) -> PyResult<Records<'py>> {
        let field = self.field_alone()?;
        asked.each(0, |[x, y, z, distance], _| field.within([x, y, z], distance))
    }
}
