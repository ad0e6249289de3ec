//! The flux of many triangles, with a bound of its error.

use crate::num::tolerance::U32;
use crate::num::{greater, lesser, sum_down, sum_up};
use crate::query::Interval;

/// A sum of solid angles, whatever they were computed from.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Flux {
    sum: f32,
    error: f32,
    terms: u32,
}

/// With more terms the rounding of the error's own sum would not be small.
const MOST_TERMS: u32 = 1 << 22;

impl Flux {
    /// Bound of the sum's error.
    pub(super) fn error(&self) -> f32 {
        self.error * (1.0 + 2.0 * U32 * self.terms as f32)
    }

    /// Adds a solid angle that is known up to `error`.
    pub(super) fn add(&mut self, angle: f32, error: f32) {
        self.sum += angle;
        self.error += error + self.sum.abs() * U32;
        self.terms = self.terms.saturating_add(1);
    }

    /// Adds a sum of so many terms.
    pub(super) fn add_sum(&mut self, sum: f32, error: f32, terms: u32) {
        self.add(sum, error);
        self.terms = self.terms.saturating_add(terms);
    }

    /// The winding number. It is within `±most` in any case.
    pub(super) fn winding(self, most: f32) -> Interval {
        let error = self.error() * PER_SPHERE;
        let turns = self.sum * PER_SPHERE;
        let error = (error + turns.abs() * (4.0 * U32)) * (1.0 + 4.0 * U32) + f32::MIN_POSITIVE;
        let (lower, upper) = (sum_down(turns, -error), sum_up(turns, error));
        if self.terms > MOST_TERMS || error.is_nan() || error > most {
            return Interval::new(-most, most);
        }
        Interval::new(greater(lower, -most), lesser(upper, most))
    }
}

/// 1/(4π): winding numbers of a solid angle.
const PER_SPHERE: f32 = 0.079_577_47;
