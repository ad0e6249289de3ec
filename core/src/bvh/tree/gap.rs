//! Gaps: distances that a search has measured, and what a question wants of them. `P` names the
//! place: a triangle beside a solid, or a pair of triangles.

use super::stored_lengths::StoredLengths;
use super::triangle_at::TriangleAt;
use crate::num::tolerance::{U32, U64};
use crate::num::{greater, lesser};
use crate::query::{Budget, Ended, Witness};

/// A measured distance of stored surfaces, or of one and the hull of a solid's corners. Stored
/// units.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Gap<P> {
    pub(crate) place: P,
    pub(crate) lower: f64,
    pub(crate) upper: f64,
    /// It is proved that the two meet, as input.
    pub(crate) meets: bool,
    /// A point of each.
    pub(crate) points: [[f64; 3]; 2],
}

/// The distance of two stored triangles, common units. Points are from the first model's origin.
pub(crate) type TriangleGap = Gap<[TriangleAt; 2]>;

/// A question's visitor for gaps.
pub(crate) trait GapVisitor<P> {
    /// What is farther than this needs no visit, stored units.
    fn limit(&self) -> f64;
    /// Whether to go on.
    fn take(&mut self, gap: &Gap<P>) -> bool;
}

/// The visitor that wants the nearest gap.
pub(crate) struct NearestGap<P> {
    pub(crate) best: Option<Gap<P>>,
    /// The least lower end of all that were measured.
    lower: f64,
    /// Gaps that are wider cannot matter, for the tolerance or at all.
    limit: f64,
    /// Sum of the surface errors.
    error: f64,
    /// Of the solid; 0 of two surfaces.
    radius: f64,
    is_exact: bool,
    relative: f64,
    absolute: f64,
}

impl<P: Copy> NearestGap<P> {
    pub(crate) fn new(lengths: &StoredLengths, radius: f64, budget: &Budget) -> Self {
        NearestGap {
            best: None,
            lower: f64::INFINITY,
            limit: f64::INFINITY,
            error: lengths.error,
            radius,
            // Then the limit below is the upper end.
            is_exact: budget.relative == 0.0 && budget.absolute == 0.0,
            relative: f64::from(budget.relative),
            absolute: lengths.inward(budget.absolute),
        }
    }

    /// The least lower end that meets the tolerance: upper ≤ lower · (1 + relative), or upper −
    /// lower ≤ absolute, where the answer's ends lack the radius, have the surface errors and are
    /// rounded to f32.
    fn tolerated(&self, upper: f64) -> f64 {
        if self.is_exact {
            return upper;
        }
        let told = greater(0.0, upper - self.radius + self.error);
        let rounded = 4.0 * f64::from(U32);
        let relative = told / (1.0 + self.relative) * (1.0 + rounded);
        let absolute = told - greater(0.0, self.absolute - told * rounded);
        let least = lesser(relative, absolute) + self.error + self.radius;
        greater(0.0, lesser(upper, least))
    }

    /// The lower end of all gaps, and why the search ended. `missed`: why it missed some, and what
    /// bounds them from below.
    pub(crate) fn lower(&self, missed: Option<(Ended, f64)>) -> (f64, Ended) {
        let lower = lesser(self.lower, self.limit);
        match missed {
            Some((why, bound)) => (lesser(lower, bound), why),
            None if self.limit < self.lower => (lower, Ended::Tolerance),
            None => (lower, Ended::Exact),
        }
    }
}

impl<P: Copy> GapVisitor<P> for NearestGap<P> {
    #[inline(always)]
    fn limit(&self) -> f64 {
        self.limit
    }

    #[inline(always)]
    fn take(&mut self, gap: &Gap<P>) -> bool {
        self.lower = lesser(self.lower, gap.lower);
        if gap.meets || self.best.as_ref().is_none_or(|best| gap.upper < best.upper) {
            self.best = Some(*gap);
            self.limit = self.tolerated(gap.upper);
        }
        !gap.meets
    }
}

/// The visitor that wants a gap within a distance.
pub(crate) struct GapThreshold<P> {
    lengths: StoredLengths,
    radius: f64,
    /// Input units.
    pub(crate) distance: f32,
    /// The limit of what matters for the distance alone.
    least_limit: f64,
    limit: f64,
    /// The least lower end of all that were measured.
    lower: f64,
    /// A place that is certainly within, one that may be.
    pub(crate) found: Witness<P>,
}

impl<P: Copy> GapThreshold<P> {
    pub(crate) fn new(lengths: &StoredLengths, radius: f64, distance: f32) -> Self {
        let kept_distance = lengths.inward(distance) + radius + lengths.error;
        let limit = kept_distance * (1.0 + 8.0 * U64);
        GapThreshold {
            lengths: *lengths,
            radius,
            distance,
            least_limit: limit,
            limit,
            lower: f64::INFINITY,
            found: Witness::NONE,
        }
    }

    /// The visitor looks farther by `more`, input units, until it meets a gap. If it meets none,
    /// [`lower`](Self::lower) tells that everything is so much farther.
    pub(crate) fn and_beyond(mut self, more: f32) -> Self {
        self.limit += self.lengths.inward(more);
        self
    }

    /// A lower end of all gaps, input units, after a search that missed none.
    pub(crate) fn lower(&self) -> f32 {
        self.lengths.lower(lesser(self.limit, self.lower) - self.radius)
    }
}

impl<P: Copy> GapVisitor<P> for GapThreshold<P> {
    #[inline(always)]
    fn limit(&self) -> f64 {
        self.limit
    }

    #[inline(always)]
    fn take(&mut self, gap: &Gap<P>) -> bool {
        let GapThreshold { lengths, radius, distance, .. } = self;
        if gap.meets || lengths.upper_about(gap.upper, *radius) <= *distance {
            self.found.met = Some(gap.place);
            return false;
        }
        if self.found.may.is_none() && lengths.lower(gap.lower - *radius) <= *distance {
            self.found.may = Some(gap.place);
        }
        self.lower = lesser(self.lower, gap.lower);
        // Farther than asked about, it looks no longer: that would be a search for the distance.
        self.limit = self.least_limit;
        true
    }
}
