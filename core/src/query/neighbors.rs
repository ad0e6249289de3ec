//! How searches for several near elements went.

use super::answer::Ended;
use super::work::Work;

/// How a search for the nearest triangles, or segments of a curve, went. They are in the caller's
/// slice.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct KNearest {
    /// Triangles or segments in the slice.
    pub stored: usize,
    /// No other one of the input is nearer than this, input units. Infinite if there is
    /// no other.
    pub rest_lower: f32,
    /// The work of the search.
    pub work: Work,
    /// [`Ended::Exact`] if everything that can change the answer was visited. Else those stored may
    /// not be the nearest; `rest_lower` still holds.
    pub ended: Ended,
}

/// How a search for all triangles, or segments of a curve, within a distance went. They are in the
/// caller's slice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct AllWithin {
    /// Triangles or segments in the slice.
    pub stored: usize,
    /// Those that are certainly within the distance (`upper ≤ distance`). They come first in
    /// the slice. The others are undecided (`lower ≤ distance < upper`).
    pub certain: usize,
    /// Those, certain or not, that did not fit. The slice keeps the nearest.
    pub dropped: u32,
    /// The work of the search.
    pub work: Work,
    /// [`Ended::Exact`]: everything that is neither stored nor counted as dropped is certainly
    /// farther. Else some may be missing.
    pub ended: Ended,
}
