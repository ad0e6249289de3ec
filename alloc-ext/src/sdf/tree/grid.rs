//! Samples of the whole domain, and those of a dyadic box.

use super::partition::{Box3, LEVELS};
use crate::error::BuildError;
use crate::progress::Watch;
use crate::sdf::domain::{Domain, ROOT};
use crate::sdf::samples::{Sample, of_boxes};
use crate::sdf::truth::{Side, Truth};
use crate::sdf::widths::weight;
use meshsweep_core::SdfKind;

/// Steps of the grid along a side of a root cell: two along that of the smallest box.
const STEPS_OF_ROOT: usize = 2 << LEVELS;

/// Steps along a side of what is sampled at once.
const AT_ONCE: usize = 8;

/// Most steps along a side of a box that is fitted.
const MOST_STEPS_OF_BOX: usize = 16;

/// What samples in a box allow.
#[derive(Debug, Default)]
pub(super) struct Batch {
    /// Steps along each side.
    pub steps: [usize; 3],
    /// The distance that a function is fitted to, units.
    pub value: Vec<f32>,
    /// The interval must go down to this.
    pub least: Vec<f32>,
    /// The interval must go up to this; −∞ where no upper end is asked for.
    pub most: Vec<f32>,
    /// How much each sample counts.
    pub weight: Vec<f32>,
}

impl Batch {
    fn clear(&mut self, steps: [usize; 3]) {
        self.steps = steps;
        for all in [&mut self.value, &mut self.least, &mut self.most, &mut self.weight] {
            all.clear();
        }
    }

    fn push(&mut self, sample: Sample, kind: SdfKind, near: f64) {
        let [least, most] = sample.limits(kind);
        self.value.push(match (sample.side, kind) {
            (Side::Inside, SdfKind::Solid) => -sample.distance,
            _ => 0.5 * (least + most),
        });
        self.least.push(least);
        self.most.push(most);
        self.weight.push(weight(sample, kind, near) as f32);
    }

    /// Of samples of a box, as many steps along each side.
    pub fn fill(&mut self, samples: &[Sample], steps: usize, kind: SdfKind, near: f64) {
        self.clear([steps; 3]);
        for &sample in samples {
            self.push(sample, kind, near);
        }
    }
}

/// Samples at the places of a grid over the whole domain.
#[derive(Debug)]
pub(super) struct Grid {
    /// Places along each axis.
    places: [usize; 3],
    /// As of a box, x fastest.
    all: Batch,
}

impl Grid {
    /// # Errors
    /// [`BuildError::Cancelled`].
    pub fn of(
        truth: &Truth<'_>,
        domain: &Domain,
        near: f64,
        watch: Watch<'_>,
    ) -> Result<Self, BuildError> {
        let blocks = domain.cells.map(|cells| cells * STEPS_OF_ROOT / AT_ONCE);
        let side = ROOT * AT_ONCE as f64 / STEPS_OF_ROOT as f64;
        let samples = of_boxes(truth, blocks, side, AT_ONCE, watch)?;
        let places = blocks.map(|blocks| blocks * AT_ONCE + 1);
        let mut all = Batch::default();
        all.clear(places.map(|places| places - 1));
        for sample in samples {
            all.push(sample, truth.kind, near);
        }
        Ok(Self { places, all })
    }

    /// The distances, units.
    pub fn values(&self) -> impl Iterator<Item = f64> + Clone {
        self.all.value.iter().map(|&value| f64::from(value))
    }

    /// The samples of a box: all, or some at even steps.
    pub fn fill(&self, of: &Box3, batch: &mut Batch) {
        let (start, size) = (of.start(STEPS_OF_ROOT), of.size(STEPS_OF_ROOT));
        let steps = size.map(|size| size.min(MOST_STEPS_OF_BOX));
        let stride = [0, 1, 2].map(|axis| size[axis] / steps[axis]);
        batch.clear(steps);
        let [x, y, _] = self.places;
        for k in 0..=steps[2] {
            for j in 0..=steps[1] {
                let row =
                    start[0] + x * (start[1] + j * stride[1] + y * (start[2] + k * stride[2]));
                let copy = |to: &mut Vec<f32>, from: &[f32]| match stride[0] {
                    1 => to.extend_from_slice(&from[row..=row + size[0]]),
                    stride => to.extend(from[row..=row + size[0]].iter().step_by(stride)),
                };
                copy(&mut batch.value, &self.all.value);
                copy(&mut batch.least, &self.all.least);
                copy(&mut batch.most, &self.all.most);
                copy(&mut batch.weight, &self.all.weight);
            }
        }
    }
}
