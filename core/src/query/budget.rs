//! When a query may stop.

use super::error::QueryError;

/// When a query may stop before its answer is exact.
///
/// A question that does not use a part of the budget says so.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Budget {
    /// Stop when `upper ≤ lower · (1 + relative)`. 0 for exact.
    pub relative: f32,
    /// Stop when `upper − lower ≤ absolute`, input units. 0 for exact.
    pub absolute: f32,
    /// Stop after this many nodes were opened.
    pub steps: u32,
}

impl Budget {
    /// Search until the interval is as narrow as the stored surface and rounding allow.
    pub const EXACT: Budget = Budget { relative: 0.0, absolute: 0.0, steps: u32::MAX };

    /// The same budget with another relative tolerance.
    #[must_use]
    pub const fn with_relative(self, relative: f32) -> Budget {
        Budget { relative, ..self }
    }

    /// The same budget with another absolute tolerance, input units.
    #[must_use]
    pub const fn with_absolute(self, absolute: f32) -> Budget {
        Budget { absolute, ..self }
    }

    /// The same budget with another number of nodes to open.
    #[must_use]
    pub const fn with_steps(self, steps: u32) -> Budget {
        Budget { steps, ..self }
    }

    pub(crate) fn check(&self) -> Result<(), QueryError> {
        let fine = |x: f32| x >= 0.0 && x.is_finite();
        if fine(self.relative) && fine(self.absolute) { Ok(()) } else { Err(QueryError::Tolerance) }
    }
}

impl Default for Budget {
    fn default() -> Self {
        Budget::EXACT
    }
}
