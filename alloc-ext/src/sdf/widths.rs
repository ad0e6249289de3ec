//! How wide intervals are where most questions are.

use super::codes::weight;
use super::samples::Sample;
use meshsweep_core::SdfKind;

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
