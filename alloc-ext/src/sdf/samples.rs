//! Distances at the places of a lattice in each cell. They choose codes and the errors to prove;
//! nothing relies on them.

use super::domain::{CELL, Domain};
use super::region::{Near, TIE};
use super::truth::{Side, Truth};
use crate::error::BuildError;
use crate::progress::Watch;
use glam::DVec3;
use meshsweep_core::SdfKind;

/// A place of a cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sample {
    /// Units.
    pub distance: f32,
    pub side: Side,
}

impl Sample {
    /// The interval that the field's must contain at the sample, units. Inside of a solid one it
    /// must go down to 0, and no upper end is asked for.
    pub fn limits(self, kind: SdfKind) -> [f32; 2] {
        let d = self.distance;
        match (self.side, kind) {
            (Side::Outside, _) | (_, SdfKind::Surface) => [d, d],
            (Side::Inside, SdfKind::Solid) => [0.0, f32::NEG_INFINITY],
            (Side::Undecided, SdfKind::Solid) => [0.0, d],
            (Side::Inside, _) => [-d, -d],
            (Side::Undecided, _) => [-d, d],
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
            of_box(truth, corner, DVec3::splat(CELL), steps)
        })?;
        Ok(Self { steps, cells })
    }

    /// The sample at a corner of a cell, by its bits x, y, z.
    pub fn corner(&self, cell: usize, corner: usize) -> Sample {
        let (steps, side) = (self.steps, side_of(self.steps));
        let at = |bit: usize| steps * (corner >> bit & 1);
        self.cells[cell][at(0) + side * (at(1) + side * at(2))]
    }
}

/// The samples of a box with this least corner and these sides, x fastest: an even number of steps
/// along each side.
pub(super) fn of_box(truth: &Truth<'_>, corner: DVec3, sides: DVec3, steps: usize) -> Vec<Sample> {
    let none = Sample { distance: 0.0, side: Side::Outside };
    let mut samples = vec![none; side_of(steps).pow(3)];
    let mut nears: Vec<Near> = Vec::new();
    let half = 0.5 * sides;
    let whole = truth.facets.gather([corner + half, half], false, &mut nears);
    let count = nears.len();
    // Blocks of two steps along each axis: their lists are short.
    let blocks = steps / 2;
    let step = sides / steps as f64;
    for block in 0..blocks * blocks * blocks {
        let block = [block % blocks, block / blocks % blocks, block / (blocks * blocks)];
        let middle = DVec3::from(block.map(|at| (2 * at + 1) as f64)) * step;
        let boxed = [corner + middle, step];
        let region = truth.facets.narrow(&whole, 0..count, boxed, &mut nears);
        let end = nears.len();
        let side = |nears: &[Near], p: DVec3, distance: f64| {
            let ties = nears.iter().filter(|near| near.distance <= distance + TIE);
            truth.side(p, ties.copied())
        };
        let side_of_all = (region.least > region.radius)
            .then(|| side(&nears[count..], region.centre, region.distance));
        let [x, y, z] = block.map(|at| {
            let last = usize::from(at + 1 == blocks);
            2 * at..2 * at + 2 + last
        });
        for k in z {
            for j in y.clone() {
                for i in x.clone() {
                    let p = corner + DVec3::from([i, j, k].map(|at| at as f64)) * step;
                    let sample = match side_of_all {
                        Some(side) => {
                            let (_, point) = truth.facets.nearest(&region, &nears[count..end], p);
                            Sample { distance: (p - point).length() as f32, side }
                        }
                        None => {
                            let boxed = [p, DVec3::ZERO];
                            let at = truth.facets.narrow(&region, count..end, boxed, &mut nears);
                            let side = side(&nears[end..], p, at.distance);
                            nears.truncate(end);
                            Sample { distance: at.distance as f32, side }
                        }
                    };
                    samples[i + side_of(steps) * (j + side_of(steps) * k)] = sample;
                }
            }
        }
        nears.truncate(count);
    }
    samples
}

/// Samples along a side of a cell.
fn side_of(steps: usize) -> usize {
    steps + 1
}
