//! Distances at the places of a lattice in each cell. They choose codes and the errors to prove;
//! nothing relies on them.

use super::domain::{CELL, Domain};
use super::region::{Near, TIE, parts};
use super::truth::{Place, Truth};
use crate::error::BuildError;
use crate::progress::Watch;
use glam::DVec3;
use meshsweep_core::SdfKind;

/// A place of a cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sample {
    /// Units.
    pub distance: f32,
    pub place: Place,
}

impl Sample {
    /// What the field may say least and most of it, units. Nothing limits what lies below 0 of a
    /// solid field.
    pub fn limits(self, kind: SdfKind) -> [f32; 2] {
        let d = self.distance;
        match (self.place, kind) {
            (Place::Outside, _) | (_, SdfKind::Surface) => [d, d],
            (Place::Inside, SdfKind::Solid) => [0.0, f32::NEG_INFINITY],
            (Place::Undecided, SdfKind::Solid) => [0.0, d],
            (Place::Inside, _) => [-d, -d],
            (Place::Undecided, _) => [-d, d],
        }
    }
}

/// Samples of all cells.
#[derive(Debug)]
pub(super) struct Samples {
    /// Steps along each side of a cell.
    pub steps: usize,
    /// Per cell its samples, x fastest.
    pub cells: Vec<Vec<Sample>>,
}

/// Cells of a field with the most samples.
const FEW_CELLS: usize = 20_000;

impl Samples {
    /// Of all cells.
    ///
    /// # Errors
    /// [`BuildError::Cancelled`].
    pub fn of(truth: &Truth<'_>, domain: &Domain, watch: Watch<'_>) -> Result<Self, BuildError> {
        let steps = if domain.cell_count() <= FEW_CELLS { 6 } else { 4 };
        let cells = watch.map(domain.cell_count(), |cell| {
            let corner = DVec3::from(domain.cell(cell).map(|at| at as f64)) * CELL;
            of_cell(truth, corner, steps)
        })?;
        Ok(Self { steps, cells })
    }

    /// The sample at a corner of a cell, by its bits x, y, z.
    pub fn corner(&self, cell: usize, corner: usize) -> Sample {
        let (steps, side) = (self.steps, self.steps + 1);
        let at = |bit: usize| steps * (corner >> bit & 1);
        self.cells[cell][at(0) + side * (at(1) + side * at(2))]
    }
}

fn of_cell(truth: &Truth<'_>, corner: DVec3, steps: usize) -> Vec<Sample> {
    let side = steps + 1;
    let mut samples = vec![Sample { distance: 0.0, place: Place::Outside }; side * side * side];
    let mut nears: Vec<Near> = Vec::new();
    let half = DVec3::splat(0.5 * CELL);
    let whole = truth.facets.gather(corner + half, half, &mut nears);
    let count = nears.len();
    for (part, centre) in parts(corner + half, half).into_iter().enumerate() {
        let boxed = [centre, 0.5 * half];
        let region = truth.facets.narrow(&whole, 0..count, boxed, &mut nears);
        let end = nears.len();
        let place_of = |region_nears: &[Near], p: DVec3, distance: f64| {
            let ties = region_nears.iter().filter(|near| near.distance <= distance + TIE);
            truth.side(p, ties.copied())
        };
        let place = (region.least > region.radius)
            .then(|| place_of(&nears[count..end], centre, region.distance));
        let range = |bit: usize| {
            if part >> bit & 1 == 0 { 0..steps / 2 } else { steps / 2..steps + 1 }
        };
        for k in range(2) {
            for j in range(1) {
                for i in range(0) {
                    let at = [i, j, k].map(|at| at as f64 * CELL / steps as f64);
                    let p = corner + DVec3::from(at);
                    let point =
                        truth.facets.narrow(&region, count..end, [p, DVec3::ZERO], &mut nears);
                    let place = place.unwrap_or_else(|| place_of(&nears[end..], p, point.distance));
                    nears.truncate(end);
                    samples[i + side * (j + side * k)] =
                        Sample { distance: point.distance as f32, place };
                }
            }
        }
        nears.truncate(count);
    }
    samples
}
