//! Whether a segment meets the surface.

use super::descent::{Descent, descend};
use super::segment_leaf::{CrossingCollector, Facing, SegmentVisitor};
use super::segment_query::SegmentQuery;
use super::segment_start::SegmentStart;
use crate::bvh::format::Bvh;
use crate::geom::fan::Crossing;
use crate::query::{Budget, QueryError, ScratchEntry, Undecided, Verdict, Work};

/// Whether a segment meets the surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct AnyHit {
    /// `Yes`: the segment meets the input mesh. `No`: no point of the segment lies on a triangle of
    /// the wanted facing. Undecided for [`Resolution`](Undecided::Resolution): the segment passes
    /// so near an edge, or ends so near the surface, that rounding and the surface error leave it
    /// undecided.
    pub verdict: Verdict,
    /// The work of the search.
    pub work: Work,
}

impl Bvh<'_> {
    /// Whether the closed segment `a b` (input units) meets the surface. It ends at the first
    /// proof.
    ///
    /// Arguments and degenerate cases as for [`first_hit`](Bvh::first_hit). Cost: less than there.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Bvh, Facing, Scratch, Verdict};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/groove.msw"));
    /// let (part, mut scratch) = (Bvh::open(bytes)?, Scratch::<64>::new());
    /// let (front, down) = (Facing::Front, [[0.0, 0.0, 400.0], [0.0, 0.0, -400.0]]);
    /// let found = part.any_hit(down[0], down[1], front, Budget::EXACT, &mut scratch)?;
    /// assert_ne!(found.verdict, Verdict::No);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`first_hit`](Bvh::first_hit).
    #[inline(never)]
    pub fn any_hit(
        &self,
        a: [f32; 3],
        b: [f32; 3],
        facing: Facing,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<AnyHit, QueryError> {
        let mut work = Work::default();
        let Some(start) = SegmentStart::find(self, [a, b], &budget, scratch)? else {
            return Ok(AnyHit { verdict: Verdict::No, work });
        };
        let query = SegmentQuery::new(self, &start);
        let collector = AnyCrossing { end: query.ray.end(), undecided: false, certain: false };
        let mut visitor = SegmentVisitor { query: &query, facing, collector };
        let descent = descend(self, &query, budget.steps, scratch, &mut visitor, &mut work)?;
        let verdict = match descent {
            _ if visitor.collector.certain => Verdict::Yes,
            Descent::Truncated { ended, .. } => Verdict::Undecided(ended.undecided()),
            _ if visitor.collector.undecided => Verdict::Undecided(Undecided::Resolution),
            _ => Verdict::No,
        };
        Ok(AnyHit { verdict, work })
    }
}

struct AnyCrossing {
    end: f32,
    undecided: bool,
    certain: bool,
}

impl CrossingCollector for AnyCrossing {
    #[inline(always)]
    fn limit(&self) -> f32 {
        self.end
    }

    #[inline(always)]
    fn meet(&mut self, _: &Crossing, _: u32, _: u32, _: u32) -> Option<()> {
        self.undecided = true;
        Some(())
    }

    #[inline(always)]
    fn certain(&mut self, _: f32) {
        self.certain = true;
    }

    #[inline(always)]
    fn covered(&mut self, _: u32, upper: f32, _: u32, _: u32) -> Option<()> {
        self.certain(upper);
        Some(())
    }

    #[inline(always)]
    fn is_answered(&self) -> bool {
        self.certain
    }

    const TELLS_EACH: bool = false;
}
