//! The answers about two models, after a search among their gaps.

use super::nearest_first::Missed;
use crate::bvh::pair::from_afar::from_afar;
use crate::bvh::pair::models::numbers;
use crate::bvh::pair::stored_pair::StoredPair;
use crate::bvh::tree::gap::{GapThreshold, NearestGap};
use crate::bvh::tree::triangle_at::TriangleAt;
use crate::num::greater;
use crate::query::{Decided, Ended, Interval, PairDistance, QueryError, Verdict, Work};

/// The distance of two models after a search.
pub(crate) fn nearest(
    found: &NearestGap<[TriangleAt; 2]>,
    pair: &StoredPair<'_>,
    missed: Option<Missed>,
    work: Work,
) -> Result<PairDistance, QueryError> {
    let (gap, lower, ended) = match found.best {
        Some(gap) => {
            let (lower, ended) = found.lower(missed.map(|missed| (missed.why, missed.lower)));
            if gap.meets { (gap, 0.0, Ended::Exact) } else { (gap, lower, ended) }
        }
        // Nothing was measured, so `gap.lower` and `missed.lower` are both lower bounds; the
        // greater counts.
        None => {
            let gap = from_afar(pair).ok_or(QueryError::Unchecked)?;
            let (bound, ended) = missed.map_or((0.0, Ended::Exact), |m| (m.lower, m.why));
            (gap, greater(gap.lower, if pair.common.is_in_range { bound } else { 0.0 }), ended)
        }
    };
    let distance =
        if gap.meets { Interval::new(0.0, 0.0) } else { pair.lengths.interval(lower, gap.upper) };
    let [a, b] = pair.trees;
    Ok(PairDistance {
        distance,
        points: gap.points.map(|point| pair.to_input(point)),
        triangles: numbers(a, b, gap.place).ok_or(QueryError::Unchecked)?,
        work,
        ended,
    })
}

/// Whether two models are within a distance, after a search.
pub(crate) fn within(
    threshold: &GapThreshold<[TriangleAt; 2]>,
    pair: &StoredPair<'_>,
    missed: Option<Missed>,
    work: Work,
) -> Result<Decided<[u32; 2]>, QueryError> {
    let &GapThreshold { distance, found, .. } = threshold;
    let (mut verdict, place) = found.answer(missed.map(|missed| missed.why));
    if missed.is_some() && found.met.is_none() {
        let far = from_afar(pair).ok_or(QueryError::Unchecked)?;
        if pair.lengths.lower(far.lower) > distance {
            verdict = Verdict::No;
        }
    }
    let [a, b] = pair.trees;
    let numbers = |place| numbers(a, b, place).ok_or(QueryError::Unchecked);
    Ok(Decided { verdict, witness: place.map(numbers).transpose()?, work })
}
