//! Whether a pair of triangles of two models is within a distance.

use super::leaf_gaps::{GapVisitor, TriangleGap};
use super::nearest_first::Missed;
use crate::bvh::pair::from_afar::from_afar;
use crate::bvh::pair::models::numbers;
use crate::bvh::pair::stored_pair::StoredPair;
use crate::num::tolerance::U64;
use crate::query::{PairWithin, QueryError, Undecided, Verdict, Work};

/// The visitor that wants a pair within a distance.
pub(crate) struct Threshold<'a> {
    pair: &'a StoredPair<'a>,
    /// Input units.
    distance: f32,
    /// Common units.
    limit: f64,
    /// A pair that is certainly within.
    pub(crate) near: Option<TriangleGap>,
    /// A pair that may be within.
    undecided: Option<TriangleGap>,
}

impl<'a> Threshold<'a> {
    pub(crate) fn new(pair: &'a StoredPair<'a>, distance: f32) -> Self {
        let limit = (pair.lengths.inward(distance) + pair.lengths.error) * (1.0 + 8.0 * U64);
        Threshold { pair, distance, limit, near: None, undecided: None }
    }

    /// The answer after a search.
    pub(crate) fn answer(
        &self,
        missed: Option<Missed>,
        work: Work,
    ) -> Result<PairWithin, QueryError> {
        let &Threshold { pair, distance, .. } = self;
        let (verdict, gap) = match (self.near, missed, self.undecided) {
            (Some(gap), _, _) => (Verdict::Yes, Some(gap)),
            (None, Some(missed), _) => {
                let far = from_afar(pair).ok_or(QueryError::Unchecked)?;
                let is_apart = pair.lengths.lower(far.lower) > distance;
                let open = Verdict::Undecided(missed.why.undecided());
                (if is_apart { Verdict::No } else { open }, None)
            }
            (None, None, Some(gap)) => (Verdict::Undecided(Undecided::Resolution), Some(gap)),
            (None, None, None) => (Verdict::No, None),
        };
        let [a, b] = pair.trees;
        let numbers = |gap: TriangleGap| numbers(a, b, gap.place).ok_or(QueryError::Unchecked);
        Ok(PairWithin { verdict, triangles: gap.map(numbers).transpose()?, work })
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
            self.near = Some(*gap);
            return false;
        }
        if self.undecided.is_none() && self.pair.lengths.lower(gap.lower) <= self.distance {
            self.undecided = Some(*gap);
        }
        true
    }
}
