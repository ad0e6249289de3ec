//! From distances of stored surfaces to those of the input.
//!
//! A search for a distance compares stored surfaces. Their errors are added to the answer, once.

use super::format::Bvh;
use crate::num::tolerance::{GAP_SLACK, LEAST_GAP_SQ, U32};
use crate::num::{down_to_f32, exp2, greater, up_to_f32};
use crate::query::Interval;

/// The limit of squared bounds in f32 for a distance.
#[inline(always)]
pub(crate) fn square_limit(distance: f64) -> f32 {
    let limit = up_to_f32(distance);
    limit * limit * GAP_SLACK + LEAST_GAP_SQ
}

/// A lower bound of a distance, from a squared bound in f32.
pub(crate) fn root_of_bound(bound_sq: f32) -> f64 {
    if bound_sq < LEAST_GAP_SQ {
        return 0.0;
    }
    libm::sqrt(f64::from(bound_sq)) * (1.0 - 16.0 * f64::from(U32))
}

/// The surface errors, and the unit of stored lengths.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StoredLengths {
    /// Sum of the surface errors, stored units, rounded up.
    pub(crate) error: f64,
    /// Input units of a stored unit.
    pub(crate) unit: f64,
}

impl StoredLengths {
    /// Those of a tree.
    pub(crate) fn of(tree: &Bvh<'_>) -> StoredLengths {
        let exponent = tree.scale_exponent().wrapping_add(tree.header().grid_exponent);
        StoredLengths { error: f64::from(tree.units().surface_error), unit: exp2(exponent) }
    }

    /// A length or a coordinate in stored units.
    pub(crate) fn inward(&self, length: f32) -> f64 {
        f64::from(length) / self.unit
    }

    /// The distance of the inputs, from that of the stored surfaces.
    pub(crate) fn interval(&self, lower: f64, upper: f64) -> Interval {
        Interval::new(self.lower(lower), self.upper(upper))
    }

    /// A lower end in input units.
    pub(crate) fn lower(&self, lower: f64) -> f32 {
        let lower = greater(0.0, (lower - self.error).next_down());
        down_to_f32(lower * self.unit)
    }

    /// An upper end in input units, about a solid whose corners have a radius.
    pub(crate) fn upper_about(&self, upper: f64, radius: f64) -> f32 {
        let rest = upper - radius;
        if rest > -self.error { self.upper(rest) } else { 0.0 }
    }

    /// An upper end in input units.
    pub(crate) fn upper(&self, upper: f64) -> f32 {
        let sum = upper + self.error;
        up_to_f32(if sum > 0.0 { sum.next_up() } else { sum } * self.unit)
    }
}
