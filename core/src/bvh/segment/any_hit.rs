//! Whether a segment meets the surface.

#[cfg(meshsweep_avx2)]
use super::blocks::{SegmentKernels, is_unlimited};
#[cfg(meshsweep_avx2)]
use super::leaf::FlaggedOfLeaf;
use super::leaf::{CrossingCollector, Facing, SegmentVisitor, compiled_flagged};
use super::query::SegmentQuery;
use super::start::SegmentStart;
use crate::bvh::tree::descent::{Descent, descend};
use crate::bvh::tree::format::Bvh;
#[cfg(meshsweep_avx2)]
use crate::bvh::tree::node::{OpenedNode, TakenLeast};
use crate::bvh::tree::triangle_at::TriangleAt;
use crate::geom::fan::Crossing;
#[cfg(meshsweep_avx2)]
use crate::geom::fan::WIDTH;
use crate::query::{Budget, Decided, QueryError, ScratchEntry, Witness, Work};

impl Bvh<'_> {
    /// Whether the closed segment `a b` (input units) meets the surface. It ends at the first
    /// proof.
    ///
    /// `No` says that no point of the segment lies on a triangle of the wanted facing. The verdict
    /// is undecided for [`Resolution`](crate::Undecided::Resolution) if the segment passes so near
    /// an edge, or ends so near the surface, that rounding and the surface error leave it
    /// undecided. The witness names no triangle: [`first_hit`](Bvh::first_hit) does.
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
    ) -> Result<Decided<()>, QueryError> {
        let Some(start) = SegmentStart::find(self, [a, b], &budget, scratch)? else {
            return Ok(Decided::CLEAR);
        };
        along(self, &start, facing, &budget, scratch)
    }
}

/// The answer about a line from its start.
#[inline(always)]
pub(super) fn along(
    tree: &Bvh<'_>,
    start: &SegmentStart,
    facing: Facing,
    budget: &Budget,
    scratch: &mut [ScratchEntry],
) -> Result<Decided<()>, QueryError> {
    let mut work = Work::default();
    let query = SegmentQuery::new(tree, start);
    let collector = AnyCrossing::new(&query);
    let flagged = compiled_flagged();
    let mut visitor = SegmentVisitor { query: &query, facing, flagged, collector };
    let descent = descend(tree, &query, budget.steps, scratch, &mut visitor, &mut work)?;
    Ok(visitor.collector.answer(descent, work))
}

/// The answer, if neither steps nor memory may end the search. Without registers of 256 bits the
/// order of entries takes fewer instructions.
#[cfg(meshsweep_avx2)]
#[inline(always)]
pub(crate) fn any_hit_by_blocks(
    tree: &Bvh<'_>,
    ends: [[f32; 3]; 2],
    facing: Facing,
    budget: &Budget,
    scratch: &mut [ScratchEntry],
    kernels: SegmentKernels<
        impl Fn(&SegmentQuery, &OpenedNode) -> Option<[u32; WIDTH]>,
        impl Fn(&[u32; WIDTH], u32) -> TakenLeast,
        impl FlaggedOfLeaf,
    >,
) -> Option<Result<Decided<()>, QueryError>> {
    if !is_unlimited(tree, budget, scratch) {
        return None;
    }
    let start = match SegmentStart::find(tree, ends, budget, scratch) {
        Ok(Some(start)) => start,
        Ok(None) => return Some(Ok(Decided::CLEAR)),
        Err(error) => return Some(Err(error)),
    };
    let query = SegmentQuery::new(tree, &start);
    let found = kernels.search(tree, &query, facing, AnyCrossing::new(&query), scratch)?;
    Some(found.map(|(found, work)| found.answer(Descent::Done, work)))
}

struct AnyCrossing {
    /// Bits of the greatest parameter.
    end: u32,
    found: Witness<()>,
}

impl AnyCrossing {
    #[inline(always)]
    fn new(query: &SegmentQuery) -> Self {
        AnyCrossing { end: query.ray.end().to_bits(), found: Witness::NONE }
    }

    #[inline(always)]
    fn answer(&self, descent: Descent, work: Work) -> Decided<()> {
        let (verdict, witness) = self.found.answer(descent.cut());
        Decided { verdict, witness, work }
    }
}

impl CrossingCollector for AnyCrossing {
    #[inline(always)]
    fn limit(&self) -> u32 {
        self.end
    }

    #[inline(always)]
    fn meet(&mut self, _: &Crossing, _: TriangleAt) -> Option<()> {
        self.found.may = Some(());
        Some(())
    }

    #[inline(always)]
    fn certain(&mut self, _: f32) {
        self.found.met = Some(());
    }

    #[inline(always)]
    fn covered(&mut self, _: u32, upper: f32, _: TriangleAt) -> Option<()> {
        self.certain(upper);
        Some(())
    }

    #[inline(always)]
    fn is_answered(&self) -> bool {
        self.found.met.is_some()
    }

    const TELLS_EACH: bool = false;
}
