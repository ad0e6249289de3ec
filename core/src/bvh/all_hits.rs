//! All common points of a segment and the stored surface.

use super::descent::descend;
use super::segment_leaf::{CrossingCollector, Facing, SegmentVisitor};
use super::segment_query::SegmentQuery;
use crate::bvh::format::Bvh;
use crate::geom::fan::Crossing;
use crate::query::{AllHits, Budget, Ended, Hit, Hits, QueryError, ScratchEntry, Work};

impl Bvh<'_> {
    /// All common points of the closed segment `a b` (input units) and the stored surface, by
    /// rising parameter, into `hits`.
    ///
    /// Each triangle gives one hit at most. So a segment through an edge or a vertex may give one
    /// for each triangle there. [`AllHits::dropped`] counts the hits that do not fit; the slice
    /// keeps the first ones. With [`Ended::Exact`] these are exactly the input's triangles that the
    /// segment meets, for certain. With [`Ended::Resolution`] rounding or the surface error leaves
    /// some of them undecided.
    ///
    /// `a`, `b`, `facing`, `budget`, `scratch` and degenerate cases as for
    /// [`first_hit`](Bvh::first_hit). Cost: all leaves that the segment enters.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Bvh, Facing, Hit, Scratch};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/groove.msw"));
    /// let (part, mut scratch) = (Bvh::open(bytes)?, Scratch::<64>::new());
    /// let (a, b, mut hits) = ([0.0, 0.0, -400.0], [0.0, 0.0, 400.0], [Hit::EMPTY; 8]);
    /// let found = part.all_hits(a, b, Facing::Both, &mut hits, Budget::EXACT, &mut scratch)?;
    /// assert!(hits[..found.stored].is_sorted_by(|x, y| x.t <= y.t));
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`first_hit`](Bvh::first_hit).
    #[inline(never)]
    pub fn all_hits(
        &self,
        a: [f32; 3],
        b: [f32; 3],
        facing: Facing,
        hits: &mut [Hit],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<AllHits, QueryError> {
        let mut work = Work::default();
        let hits = Hits::new(hits);
        let Some(query) = SegmentQuery::prepare(self, [a, b], &budget, scratch)? else {
            return Ok(hits.answer(work, Ended::Exact));
        };
        let collector = AllCrossings { tree: self, query: &query, hits, undecided: false };
        let mut visitor = SegmentVisitor { query: &query, facing, collector };
        let descent = descend(self, &query, budget.steps, scratch, &mut visitor, &mut work)?;
        let ended = match descent.ended() {
            Ended::Exact if visitor.collector.undecided => Ended::Resolution,
            ended => ended,
        };
        Ok(visitor.collector.hits.answer(work, ended))
    }
}

struct AllCrossings<'a> {
    tree: &'a Bvh<'a>,
    query: &'a SegmentQuery,
    hits: Hits<'a>,
    undecided: bool,
}

impl CrossingCollector for AllCrossings<'_> {
    fn limit(&self) -> f32 {
        self.query.ray.end()
    }

    fn meet(&mut self, crossing: &Crossing, node: u32, child: u32, lane: u32) -> Option<()> {
        self.undecided |= !crossing.certain;
        if crossing.stored {
            let number = self.tree.links(node)?.triangle(child).wrapping_add(lane);
            self.hits.insert(self.query.hit(crossing.t, self.tree.source(number)));
        }
        Some(())
    }

    fn certain(&mut self, _: f32) {}

    fn is_answered(&self) -> bool {
        false
    }

    const COVERS: bool = false;
}
