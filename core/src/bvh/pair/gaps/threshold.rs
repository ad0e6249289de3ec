//! Whether a pair of triangles of two models is within a distance.

use super::leaf_gaps::{GapVisitor, TriangleGap};
use super::nearest_first::Missed;
use crate::bvh::pair::from_afar::from_afar;
use crate::bvh::pair::models::numbers;
use crate::bvh::pair::stored_pair::StoredPair;
use crate::num::tolerance::U64;
use crate::query::{Decided, QueryError, Verdict, Witness, Work};

/// The visitor that wants a pair within a distance.
pub(crate) struct Threshold<'a> {
    pair: &'a StoredPair<'a>,
    /// Input units.
    distance: f32,
    /// Common units.
    limit: f64,
    /// A pair that is certainly within, one that may be.
    pub(crate) found: Witness<TriangleGap>,
}

impl<'a> Threshold<'a> {
    pub(crate) fn new(pair: &'a StoredPair<'a>, distance: f32) -> Self {
        let limit = (pair.lengths.inward(distance) + pair.lengths.error) * (1.0 + 8.0 * U64);
        Threshold { pair, distance, limit, found: Witness::NONE }
    }

    /// The answer after a search.
    pub(crate) fn answer(
        &self,
        missed: Option<Missed>,
        work: Work,
    ) -> Result<Decided<[u32; 2]>, QueryError> {
        let &Threshold { pair, distance, .. } = self;
        let (mut verdict, gap) = self.found.answer(missed.map(|missed| missed.why));
        if missed.is_some() && self.found.met.is_none() {
            let far = from_afar(pair).ok_or(QueryError::Unchecked)?;
            if pair.lengths.lower(far.lower) > distance {
                verdict = Verdict::No;
            }
        }
        let [a, b] = pair.trees;
        let numbers = |gap: TriangleGap| numbers(a, b, gap.place).ok_or(QueryError::Unchecked);
        Ok(Decided { verdict, witness: gap.map(numbers).transpose()?, work })
    }
}

impl GapVisitor for Threshold<'_> {
    #[inline(always)]
    fn limit(&self) -> f64 {
        self.limit
    }

    #[inline(always)]
    fn take(&mut self, gap: &TriangleGap) -> bool {
        if gap.meets || self.pair.lengths.upper(gap.upper) <= self.distance {
            self.found.met = Some(*gap);
            return false;
        }
        if self.found.may.is_none() && self.pair.lengths.lower(gap.lower) <= self.distance {
            self.found.may = Some(*gap);
        }
        true
    }
}
