//! Distances at the places of a lattice in each cell. They choose codes and the errors to prove;
//! nothing relies on them.

use super::domain::{CELL, Domain, index_of, number_of};
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

/// Samples of all cells. Neighbours share those of their common face.
#[derive(Debug)]
pub(super) struct Samples {
    /// Steps along each side of a cell.
    pub steps: usize,
    /// Places along each axis.
    places: [usize; 3],
    /// Of each place, x fastest.
    all: Vec<Sample>,
}

/// Up to so many cells have 6 steps along each side, more have 4.
const FEW_CELLS: usize = 20_000;

impl Samples {
    /// Of all cells.
    ///
    /// # Errors
    /// [`BuildError::Cancelled`].
    pub fn of(truth: &Truth<'_>, domain: &Domain, watch: Watch<'_>) -> Result<Self, BuildError> {
        let steps = if domain.cell_count() <= FEW_CELLS { 6 } else { 4 };
        let all = of_boxes(truth, domain.cells, CELL, steps, watch)?;
        Ok(Self { steps, places: domain.cells.map(|cells| steps * cells + 1), all })
    }

    /// Where a place of a cell stands.
    fn at(&self, cell: [usize; 3], place: [usize; 3]) -> usize {
        let place = [0, 1, 2].map(|axis| self.steps * cell[axis] + place[axis]);
        number_of(place, self.places)
    }

    /// The samples of a cell, x fastest.
    pub fn cell(&self, cell: [usize; 3]) -> impl Iterator<Item = Sample> + '_ {
        let side = side_of(self.steps);
        let row = move |row: usize| {
            let start = self.at(cell, [0, row % side, row / side]);
            self.all[start..start + side].iter().copied()
        };
        (0..side * side).flat_map(row)
    }

    /// The sample at a corner of a cell, by its bits x, y, z.
    pub fn corner(&self, cell: [usize; 3], corner: usize) -> Sample {
        let at = |bit: usize| self.steps * (corner >> bit & 1);
        self.all[self.at(cell, [at(0), at(1), at(2)])]
    }
}

/// The samples of a field of so many cubes with this side, each of `steps` steps: each place once,
/// x fastest.
///
/// # Errors
/// [`BuildError::Cancelled`].
pub(super) fn of_boxes(
    truth: &Truth<'_>,
    cubes: [usize; 3],
    side: f64,
    steps: usize,
    watch: Watch<'_>,
) -> Result<Vec<Sample>, BuildError> {
    // The upper faces of a cube are the next one's.
    let places =
        |cube: [usize; 3]| [0, 1, 2].map(|axis| steps + usize::from(cube[axis] + 1 == cubes[axis]));
    let found = watch.map(cubes.iter().product(), |number| {
        let cube = index_of(number, cubes);
        let corner = DVec3::from(cube.map(|at| at as f64)) * side;
        of_places(truth, [corner, DVec3::splat(side)], steps, places(cube))
    })?;
    let all = cubes.map(|cubes| cubes * steps + 1);
    let sample = |number: usize| {
        let at = index_of(number, all);
        let cube = [0, 1, 2].map(|axis| (at[axis] / steps).min(cubes[axis] - 1));
        let within = [0, 1, 2].map(|axis| at[axis] - steps * cube[axis]);
        found[number_of(cube, cubes)][number_of(within, places(cube))]
    };
    Ok((0..all.iter().product()).map(sample).collect())
}

/// The samples of a box with this least corner and these sides, x fastest: an even number of steps
/// along each side.
pub(super) fn of_box(truth: &Truth<'_>, boxed: [DVec3; 2], steps: usize) -> Vec<Sample> {
    of_places(truth, boxed, steps, [side_of(steps); 3])
}

/// The same of so many places along each side: one for each step, and maybe the last.
fn of_places(
    truth: &Truth<'_>,
    [corner, sides]: [DVec3; 2],
    steps: usize,
    places: [usize; 3],
) -> Vec<Sample> {
    debug_assert!(steps.is_multiple_of(2), "{steps} steps");
    let none = Sample { distance: 0.0, side: Side::Outside };
    let mut samples = vec![none; places.iter().product()];
    let mut nears: Vec<Near> = Vec::new();
    let half = 0.5 * sides;
    let whole = truth.facets.gather([corner + half, half], false, &mut nears);
    let count = nears.len();
    // Blocks of two steps along each axis: their lists are short.
    let blocks = steps / 2;
    let step = sides / steps as f64;
    for block in 0..blocks * blocks * blocks {
        let block = index_of(block, [blocks; 3]);
        let middle = DVec3::from(block.map(|at| (2 * at + 1) as f64)) * step;
        let boxed = [corner + middle, step];
        let region = truth.facets.narrow(&whole, 0..count, boxed, &mut nears);
        let end = nears.len();
        let side = |nears: &[Near], p: DVec3, distance: f64| {
            let ties = nears.iter().filter(|near| near.height <= distance + TIE);
            truth.side(p, ties.copied())
        };
        let side_of_all = (region.least > region.radius)
            .then(|| side(&nears[count..], region.centre, region.distance));
        let [x, y, z] = [0, 1, 2].map(|axis| {
            let at = block[axis];
            2 * at..if at + 1 == blocks { places[axis] } else { 2 * at + 2 }
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
                    samples[number_of([i, j, k], places)] = sample;
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
