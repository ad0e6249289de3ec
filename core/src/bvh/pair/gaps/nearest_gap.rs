//! The nearest pair of triangles of two models.

use super::leaf_gaps::{GapVisitor, TriangleGap};
use super::nearest_first::Missed;
use crate::bvh::pair::from_afar::from_afar;
use crate::bvh::pair::models::numbers;
use crate::bvh::pair::stored_pair::StoredPair;
use crate::num::tolerance::U32;
use crate::num::{greater, lesser};
use crate::query::{Budget, Ended, Interval, PairDistance, QueryError, Work};

/// The visitor that wants the nearest pair. Common units.
pub(crate) struct Nearest {
    pub(crate) best: Option<TriangleGap>,
    /// The least lower end of all pairs that were measured.
    lower: f64,
    upper: f64,
    /// Pairs that are farther cannot matter, for the tolerance or at all.
    limit: f64,
    /// Sum of the surface errors.
    errors: f64,
    relative: f64,
    absolute: f64,
}

impl Nearest {
    pub(crate) fn new(pair: &StoredPair<'_>, budget: &Budget) -> Nearest {
        Nearest {
            best: None,
            lower: f64::INFINITY,
            upper: f64::INFINITY,
            limit: f64::INFINITY,
            errors: pair.lengths.error,
            relative: f64::from(budget.relative),
            absolute: pair.lengths.inward(budget.absolute),
        }
    }

    /// The least lower end that meets the tolerance: upper ≤ lower · (1 + relative), or upper −
    /// lower ≤ absolute, where the answer's ends have the surface errors and are rounded to f32.
    fn tolerated(&self) -> f64 {
        let (upper, rounded) = (self.upper + self.errors, 4.0 * f64::from(U32));
        let relative = upper / (1.0 + self.relative) * (1.0 + rounded);
        let absolute = upper - greater(0.0, self.absolute - upper * rounded);
        let least = lesser(relative, absolute) + self.errors;
        greater(0.0, lesser(self.upper, least))
    }

    /// The answer after a search.
    pub(crate) fn answer(
        &self,
        pair: &StoredPair<'_>,
        missed: Option<Missed>,
        work: Work,
    ) -> Result<PairDistance, QueryError> {
        let (gap, lower, ended) = match self.best {
            Some(gap) => {
                let (lower, ended) = self.lower(missed);
                (gap, lower, ended)
            }
            // Nothing was measured, so both numbers bound all pairs.
            None => {
                let gap = from_afar(pair).ok_or(QueryError::Unchecked)?;
                let (bound, ended) = missed.map_or((0.0, Ended::Exact), |m| (m.lower, m.why));
                (gap, greater(gap.lower, if pair.is_in_range { bound } else { 0.0 }), ended)
            }
        };
        let distance = if gap.meets {
            Interval::new(0.0, 0.0)
        } else {
            pair.lengths.interval(lower, gap.upper)
        };
        let [a, b] = pair.trees;
        Ok(PairDistance {
            distance,
            points: gap.points.map(|point| pair.to_input(point)),
            triangles: numbers(a, b, gap.place).ok_or(QueryError::Unchecked)?,
            work,
            ended,
        })
    }

    /// The lower end of all pairs, and why the search ended.
    fn lower(&self, missed: Option<Missed>) -> (f64, Ended) {
        if self.best.is_some_and(|gap| gap.meets) {
            return (0.0, Ended::Exact);
        }
        let lower = lesser(self.lower, self.limit);
        match missed {
            Some(Missed { why, lower: bound }) => (lesser(lower, bound), why),
            None if self.limit < self.lower => (lower, Ended::Tolerance),
            None => (lower, Ended::Exact),
        }
    }
}

impl GapVisitor for Nearest {
    #[inline(always)]
    fn limit(&self) -> f64 {
        self.limit
    }

    #[inline(always)]
    fn take(&mut self, gap: &TriangleGap) -> bool {
        self.lower = lesser(self.lower, gap.lower);
        if gap.meets || gap.upper < self.upper {
            self.best = Some(*gap);
            self.upper = gap.upper;
            self.limit = self.tolerated();
        }
        !gap.meets
    }
}
