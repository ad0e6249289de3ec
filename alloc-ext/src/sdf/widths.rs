//! Where most questions are, and how wide intervals are there.

use super::samples::Sample;
use super::truth::Side;
use meshsweep_core::SdfKind;

/// Part of the diagonal within which most questions are.
pub(super) const NEAR: f64 = 0.1;

/// Weight of questions farther out.
const FAR_WEIGHT: f64 = 0.05;

/// Weight of a cell without questions.
pub(super) const LEAST_WEIGHT: f64 = 1e-3;

/// How much a sample counts.
pub(super) fn weight(sample: Sample, kind: SdfKind, near: f64) -> f64 {
    match (sample.side, kind) {
        (Side::Inside, SdfKind::Solid) => 0.0,
        (Side::Inside, SdfKind::Signed) => 1.0,
        _ if f64::from(sample.distance) <= near => 1.0,
        _ => FAR_WEIGHT,
    }
}

/// Widths of intervals at samples of full weight, units.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Widths {
    sum: f64,
    count: f64,
    most: f64,
}

impl Widths {
    /// Adds a sample with the ends of its interval; `part` is the volume that it stands for.
    pub fn add(
        &mut self,
        sample: Sample,
        kind: SdfKind,
        near: f64,
        [lower, upper]: [f64; 2],
        part: f64,
    ) {
        if weight(sample, kind, near) == 1.0 {
            let lower = if kind == SdfKind::Signed { lower } else { lower.max(0.0) };
            let width = upper - lower;
            self.sum += width * part;
            self.most = self.most.max(width);
            self.count += part;
        }
    }

    /// Adds those of another.
    pub fn join(&mut self, other: Self) {
        self.sum += other.sum;
        self.most = self.most.max(other.most);
        self.count += other.count;
    }

    /// The mean, and the largest.
    pub fn found(&self) -> [f64; 2] {
        [self.sum / if self.count > 0.0 { self.count } else { 1.0 }, self.most]
    }
}
