//! When a query may stop.

use super::error::QueryError;

/// When a query may stop before its answer is exact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Budget {
    /// Stop when `upper ≤ lower · (1 + relative)`. 0 for exact.
    pub relative: f32,
    /// Stop when `upper − lower ≤ absolute`, input units. 0 for exact.
    pub absolute: f32,
    /// Stop after opening so many nodes.
    pub steps: u32,
}

impl Budget {
    /// Go on until the interval is as narrow as arithmetic allows.
    pub const EXACT: Budget = Budget { relative: 0.0, absolute: 0.0, steps: u32::MAX };

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
