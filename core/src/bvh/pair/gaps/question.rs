//! The questions about the distance of two models.

use super::skipped::ChildPairs;
use crate::bvh::tree::gap::{GapThreshold, GapVisitor, NearestGap, TriangleGap};
use crate::bvh::tree::triangle_at::TriangleAt;

/// A question about the distance of two models. As one type, the search is compiled once for both.
pub(crate) enum PairQuestion<'v> {
    Distance(&'v mut NearestGap<[TriangleAt; 2]>),
    Within(&'v mut GapThreshold<[TriangleAt; 2]>),
}

impl PairQuestion<'_> {
    /// The leaves of the triangles that answer it.
    pub(crate) fn leaves(&self) -> Option<ChildPairs> {
        let [a, b] = match self {
            PairQuestion::Distance(nearest) => nearest.best?.place,
            PairQuestion::Within(threshold) => threshold.found.met?,
        };
        Some(ChildPairs { nodes: [a.node(), b.node()], wanted: 1 << (a.child() << 3 | b.child()) })
    }

    /// Pairs farther than this need no visit, common units.
    #[inline(always)]
    pub(crate) fn limit(&self) -> f64 {
        match self {
            PairQuestion::Distance(nearest) => nearest.limit(),
            PairQuestion::Within(threshold) => threshold.limit(),
        }
    }

    /// Takes a gap that was measured. Returns whether the search goes on.
    #[inline(always)]
    pub(crate) fn take(&mut self, gap: &TriangleGap) -> bool {
        match self {
            PairQuestion::Distance(nearest) => nearest.take(gap),
            PairQuestion::Within(threshold) => threshold.take(gap),
        }
    }
}
