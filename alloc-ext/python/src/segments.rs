//! Questions about segments and rays. Rows have both ends; of rays the origin and the direction.

use crate::error::QueryError;
use crate::model::{Model, budget};
use crate::rows::{Asked, Found, Lists, Records};
use crate::solids::Asks;
use meshsweep_core::{
    AllHits, Budget, Bvh, Ended, Facing, FirstHit, Interval, ScratchEntry, TriangleHit,
};
use pyo3::prelude::*;

/// Both points of a row.
pub fn ends(row: &[f32]) -> [[f32; 3]; 2] {
    core::array::from_fn(|end| {
        core::array::from_fn(|k| row.get(3 * end + k).copied().unwrap_or_default())
    })
}

/// How far rounding moved a point of the row's segment at most.
pub fn moved(row: &[f32; 8]) -> f64 {
    row[6].max(row[7]).into()
}

/// The length of a vector.
pub fn norm(x: [f64; 3]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Where a ray is behind the model, also if rounding moved its origin and its direction by so much:
/// the parameter, the place, and how far rounding moved a point before it at most. `None` if the
/// direction may be any.
fn behind(
    tree: &Bvh<'_>,
    [a, way]: [[f32; 3]; 2],
    [off, off_way]: [f64; 2],
) -> Option<(f64, [f32; 3], f64)> {
    let [low, high] = tree.bounds().map(|corner| corner.map(f64::from));
    let of_axes = |at: fn([f64; 2], f64) -> f64| {
        norm(core::array::from_fn(|k| at([low[k], high[k]], a[k].into())))
    };
    let radius = of_axes(|[low, high], _| 0.5 * (high - low)) + f64::from(tree.surface_error());
    let from_centre = of_axes(|[low, high], a| 0.5 * (low + high) - a);
    let pace = norm(way.map(f64::from)) - off_way;
    if pace <= 0.0 {
        return None;
    }
    // The part of a billion more is for the rounding of these sums.
    let until = (radius + from_centre + off) / pace * (1.0 + 1e-9);
    let end: [f64; 3] = core::array::from_fn(|k| f64::from(a[k]) + until * f64::from(way[k]));
    let rounded = end.map(|x| x as f32);
    let rounding = norm(core::array::from_fn(|k| end[k] - f64::from(rounded[k])));
    let of_sums = 1e-15 * (norm(a.map(f64::from)) + norm(end));
    Some((until, rounded, off + until * off_way + rounding + of_sums))
}

/// A first hit that is clear, as it is of the segment or ray before it was rounded. Rows have both
/// points, and how far rounding moved each. Clear is what a ball of the rounding's radius passes:
/// that looks at no facing.
fn as_given(
    tree: &Bvh<'_>,
    row: &[f32; 8],
    is_ray: bool,
    clear: FirstHit,
    budget: Budget,
    scratch: &mut [ScratchEntry],
) -> FirstHit {
    let [a, b] = ends(row);
    let way = match is_ray {
        true => behind(tree, [a, b], [row[6].into(), row[7].into()]),
        false => Some((1.0, b, moved(row))),
    };
    let passed = way.and_then(|(until, end, moved)| {
        let found = Asks::Tree(*tree).first_contact([&[a], &[end]], 0.0, moved, budget, scratch);
        // Solids have a smaller domain. Beyond it nothing is known.
        found.ok().map(|found| (found, until))
    });
    let mut found = clear;
    found.t = Interval::new(0.0, if is_ray { f32::INFINITY } else { 1.0 });
    found.ended = Ended::Resolution;
    if let Some((passed, until)) = passed {
        (found.hit, found.ended) = (passed.hit, passed.ended);
        found.work = found.work.and(passed.work);
        match passed.is_clear() {
            true => found.t = passed.t,
            false => found.t.lower = ((f64::from(passed.t.lower) * until) as f32).next_down(),
        }
        found.t.lower = found.t.lower.max(0.0);
    }
    found
}

fn facing_of(code: u8) -> PyResult<Facing> {
    match code {
        0 => Ok(Facing::Both),
        1 => Ok(Facing::Front),
        2 => Ok(Facing::Back),
        _ => Err(QueryError::new_err(format!("facing: {code} is none of 0, 1 and 2"))),
    }
}

#[pymethods]
impl Model {
    /// Rows have both points, and how far rounding moved each.
    fn first_hit<'py>(
        &self,
        asked: Asked<'py>,
        is_ray: bool,
        facing: u8,
        steps: Option<u32>,
    ) -> PyResult<Records<'py>> {
        let (facing, budget) = (facing_of(facing)?, budget((0.0, 0.0, steps)));
        let tree = self.tree("segment")?;
        asked.each(tree.scratch_entries(), |row: [f32; 8], scratch| {
            let [a, b] = ends(&row);
            let found = match is_ray {
                true => tree.first_hit_of_ray(a, b, facing, budget, scratch),
                false => tree.first_hit(a, b, facing, budget, scratch),
            }?;
            Ok(match found.is_clear() && moved(&row) > 0.0 {
                true => as_given(&tree, &row, is_ray, found, budget, scratch),
                false => found,
            })
        })
    }

    fn all_hits<'py>(&self, asked: Asked<'py>, is_ray: bool, facing: u8) -> PyResult<Lists<'py>> {
        let (facing, tree, budget) = (facing_of(facing)?, self.tree("segment")?, Budget::EXACT);
        asked.lists(tree.scratch_entries(), TriangleHit::EMPTY, |row: [f32; 6], room, scratch| {
            let [a, b] = ends(&row);
            let AllHits { stored, dropped, is_complete, .. } = match is_ray {
                true => tree.all_hits_of_ray(a, b, facing, room, budget, scratch),
                false => tree.all_hits(a, b, facing, room, budget, scratch),
            }?;
            Ok(Found { stored, dropped, is_complete })
        })
    }
}
