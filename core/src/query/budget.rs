//! When a query may stop.

use super::error::QueryError;
use super::scratch::ScratchEntry;

/// When a query may stop before its answer is exact.
///
/// Every question refuses a tolerance that is negative, NaN or infinite. A question that does not
/// use a part of the budget ignores this part, and says so.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct Budget {
    /// Stop when `upper ≤ lower · (1 + relative)`. 0 for exact.
    pub relative: f32,
    /// Stop when `upper − lower ≤ absolute`, input units. 0 for exact.
    pub absolute: f32,
    /// Stop after this many nodes were opened. A box tree then opens the nodes of the least lower
    /// bounds first, while its scratch has room for this order: always with 8 entries a step,
    /// mostly with twice its `scratch_entries`. So the answer depends on the number of entries too.
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

    /// Refuses a tolerance that no interval can meet.
    #[inline(always)]
    pub(crate) fn check(&self) -> Result<(), QueryError> {
        if is_length(self.relative) && is_length(self.absolute) {
            Ok(())
        } else {
            Err(QueryError::Tolerance)
        }
    }

    /// [`check`](Self::check), and refuses scratch memory without entries.
    #[inline(always)]
    pub(crate) fn check_with(&self, scratch: &[ScratchEntry]) -> Result<(), QueryError> {
        self.check()?;
        if scratch.is_empty() { Err(QueryError::NoScratch) } else { Ok(()) }
    }

    /// [`check_with`](Self::check_with), and refuses a distance asked about that is negative, NaN
    /// or infinite.
    #[inline(always)]
    pub(crate) fn check_about(
        &self,
        distance: f32,
        scratch: &[ScratchEntry],
    ) -> Result<(), QueryError> {
        if !is_length(distance) {
            return Err(QueryError::Tolerance);
        }
        self.check_with(scratch)
    }
}

/// Whether a number is finite and not negative. As integers: a comparison of f32 is a call where
/// there is no float unit.
#[inline(always)]
fn is_length(x: f32) -> bool {
    let bits = x.to_bits();
    bits < f32::INFINITY.to_bits() || bits == (-0.0f32).to_bits()
}

impl Default for Budget {
    fn default() -> Self {
        Budget::EXACT
    }
}
