//! All common points of a segment and the stored surface.

use super::leaf::{CrossingCollector, Facing, SegmentVisitor, compiled_flagged};
use super::query::SegmentQuery;
use super::start::SegmentStart;
use crate::bvh::tree::descent::descend;
use crate::bvh::tree::format::Bvh;
use crate::bvh::tree::triangle_at::TriangleAt;
use crate::geom::fan::{Crossing, WIDTH};
use crate::query::{
    AllHits, Budget, Ended, Hit, Hits, QueryError, ScratchEntry, TriangleHit, Work,
};

impl Bvh<'_> {
    /// All common points of the closed segment `a b` (input units) and the stored surface, by
    /// rising parameter, into `hits`.
    ///
    /// Each triangle gives one hit at most. So a segment through an edge or a vertex may give one
    /// for each triangle there. [`AllHits::dropped`] counts the hits that do not fit; the slice
    /// keeps the first ones. With [`Ended::Exact`] these are exactly the input's triangles that the
    /// segment meets, for certain. With [`Ended::Resolution`] rounding or the surface error leaves
    /// some triangles undecided. Each hit tells whether it is certain
    /// ([`TriangleHit::is_certain`]). An undecided triangle may be missing, if the segment passes
    /// beside the stored one: then [`AllHits::is_complete`] is false.
    ///
    /// `a`, `b`, `facing`, `budget`, `scratch` and degenerate cases as for
    /// [`first_hit`](Bvh::first_hit). Cost: all leaves that the segment enters.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Bvh, Facing, Scratch, TriangleHit};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/groove.msw"));
    /// let (part, mut scratch) = (Bvh::open(bytes)?, Scratch::<64>::new());
    /// let (a, b, mut hits) = ([0.0, 0.0, -400.0], [0.0, 0.0, 400.0], [TriangleHit::EMPTY; 8]);
    /// let found = part.all_hits(a, b, Facing::Both, &mut hits, Budget::EXACT, &mut scratch)?;
    /// assert!(hits[..found.stored].is_sorted_by(|x, y| x.hit.t <= y.hit.t));
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
        hits: &mut [TriangleHit],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<AllHits, QueryError> {
        let Some(start) = SegmentStart::find(self, [a, b], &budget, scratch)? else {
            return Ok(AllHits::NONE);
        };
        along(self, &start, facing, hits, &budget, scratch)
    }
}

/// The answer about a line from its start.
#[inline(always)]
pub(super) fn along(
    tree: &Bvh<'_>,
    start: &SegmentStart,
    facing: Facing,
    hits: &mut [TriangleHit],
    budget: &Budget,
    scratch: &mut [ScratchEntry],
) -> Result<AllHits, QueryError> {
    let mut work = Work::default();
    let query = SegmentQuery::new(tree, start);
    let collector = AllCrossings {
        tree,
        query: &query,
        hits: Hits::new(hits),
        undecided: false,
        lacks: false,
        places: [0.0; WIDTH],
    };
    let flagged = compiled_flagged();
    let mut visitor = SegmentVisitor { query: &query, facing, flagged, collector };
    let descent = descend(tree, &query, budget.steps, scratch, &mut visitor, &mut work)?;
    let ended = match descent.ended() {
        Ended::Exact if visitor.collector.undecided => Ended::Resolution,
        ended => ended,
    };
    let AllCrossings { hits, lacks, .. } = visitor.collector;
    Ok(hits.answer(work, ended, lacks))
}

struct AllCrossings<'a> {
    tree: &'a Bvh<'a>,
    query: &'a SegmentQuery,
    hits: Hits<'a, TriangleHit>,
    undecided: bool,
    /// An undecided triangle is not among the hits: the segment passes beside the stored one.
    lacks: bool,
    /// Parameters of the stored triangles of the leaf that is being tested, by lane. Infinite if
    /// the triangle is not met.
    places: [f32; WIDTH],
}

impl CrossingCollector for AllCrossings<'_> {
    fn limit(&self) -> u32 {
        self.query.ray.end().to_bits()
    }

    fn meet(&mut self, crossing: &Crossing, triangle: TriangleAt) -> Option<()> {
        self.undecided |= !crossing.certain;
        if let Some(place) = self.places.get_mut(triangle.lane()) {
            *place = if crossing.stored { crossing.t } else { f32::INFINITY };
        }
        if crossing.stored {
            let hit = self.hit(crossing.t, triangle)?;
            self.hits.insert(TriangleHit { hit, is_certain: crossing.certain });
        } else {
            self.lacks = true;
        }
        Some(())
    }

    fn certain(&mut self, _: f32) {}

    /// One hit for the group is certain: the one that [`Bvh::first_hit`] would name.
    fn covered(&mut self, lanes: u32, _: f32, first: TriangleAt) -> Option<()> {
        let met = (0..).zip(self.places).filter(|&(lane, _)| lanes >> lane & 1 != 0);
        let (lane, t) = met.fold((0, f32::INFINITY), |x, y| if y.1 < x.1 { y } else { x });
        if t < f32::INFINITY {
            let hit = self.hit(t, first.with_lane(lane))?;
            self.hits.prove(&hit);
        }
        Some(())
    }

    fn is_answered(&self) -> bool {
        false
    }

    const TELLS_EACH: bool = true;
}

impl AllCrossings<'_> {
    fn hit(&self, t: f32, triangle: TriangleAt) -> Option<Hit> {
        let number = triangle.number(self.tree)?;
        Some(self.query.hit(t, self.tree.source(number)))
    }
}
