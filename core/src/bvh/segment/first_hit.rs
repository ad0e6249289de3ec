//! The first common point of a segment and the surface.

#[cfg(meshsweep_wide)]
use super::blocks::{SegmentKernels, is_unlimited};
#[cfg(meshsweep_wide)]
use super::leaf::FlaggedOfLeaf;
use super::leaf::{CrossingCollector, Facing, SegmentVisitor, compiled_flagged};
use super::query::SegmentQuery;
use super::start::SegmentStart;
use crate::bvh::tree::descent::{Descent, descend, descend_inlined};
use crate::bvh::tree::format::Bvh;
#[cfg(meshsweep_wide)]
use crate::bvh::tree::node::{OpenedNode, TakenLeast, take_least};
#[cfg(meshsweep_wide)]
use crate::bvh::tree::prefetch::prefetch_source;
use crate::bvh::tree::triangle_at::TriangleAt;
use crate::geom::fan::Crossing;
#[cfg(meshsweep_wide)]
use crate::geom::fan::WIDTH;
use crate::num::{SOFT_FLOAT, lesser};
use crate::query::{Budget, Ended, FirstHit, Interval, QueryError, ScratchEntry, Work};

impl Bvh<'_> {
    /// First common point of the closed segment `a b` (input units) and the surface.
    ///
    /// It never says "clear" wrongly: if [`FirstHit::is_clear`], no point of the segment lies on
    /// the input mesh. With [`Ended::Exact`] and a hit the segment is proved to meet the input
    /// mesh, and the first common parameter lies in `t`, even if a grid moved vertices.
    /// With [`Ended::Resolution`] it is undecided whether they meet: the segment passes an outer
    /// edge of a fan, or ends, within rounding and the surface error of the surface.
    ///
    /// `hit` is the first triangle of the *stored* surface that is met, computed in f32. There is
    /// no gap along edges and at vertices. With [`Ended::Resolution`] the input's surface may only
    /// come near `hit`, or `hit` may be missing. Of equal parameters the answer is the least
    /// triangle in blob order.
    ///
    /// Vertices that rounding to f32, or snapping to a grid, made equal count as one vertex of the
    /// input. So a crack that is narrower than this rounding counts as closed.
    ///
    /// `facing` is by the winding of the input file. Of triangles on the same three vertices in
    /// opposite order each is met from its own front.
    ///
    /// A segment in a triangle's plane hits where it enters the triangle. So does a segment of no
    /// length, and a segment that meets a triangle without area. None of these hits is proved.
    ///
    /// `scratch` as for [`closest_point`](Bvh::closest_point). Of the budget only `steps` matters.
    ///
    /// Cost: two nodes and half a leaf on scanned parts. A segment that runs along the surface
    /// visits all boxes that it touches.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Bvh, Facing, Scratch};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/groove.msw"));
    /// let (part, mut scratch) = (Bvh::open(bytes)?, Scratch::<64>::new());
    /// let (a, b) = ([0.0, 0.0, 400.0], [0.0, 0.0, 300.0]);
    /// let hit = part.first_hit(a, b, Facing::Both, Budget::EXACT, &mut scratch)?;
    /// assert!(hit.is_clear());
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`QueryError::NotFinite`], [`QueryError::Tolerance`], [`QueryError::NoScratch`],
    /// [`QueryError::NotServed`];
    /// [`QueryError::OutOfDomain`] if an end is farther than 2^38 grid units away: a million model
    /// sizes or more, unless the model lies as far from its own origin. Far starts are clipped
    /// without loss.
    #[inline(never)]
    pub fn first_hit(
        &self,
        a: [f32; 3],
        b: [f32; 3],
        facing: Facing,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<FirstHit, QueryError> {
        #[cfg(meshsweep_wide)]
        if let Some(found) = first_hit_by_blocks(
            self,
            [a, b],
            facing,
            &budget,
            scratch,
            SegmentKernels::new(
                #[inline(always)]
                |query: &SegmentQuery, opened: &OpenedNode| query.keys_in_register(self, opened),
                #[inline(always)]
                |keys: &[u32; WIDTH], limit: u32| take_least(keys, limit),
                compiled_flagged(),
            ),
        ) {
            return found;
        }
        by_entries(self, [a, b], facing, &budget, scratch)
    }
}

/// The answer on targets without vector registers, and where steps or memory may end the search.
#[cfg_attr(meshsweep_wide, cold, inline(never))]
#[cfg_attr(not(meshsweep_wide), inline(always))]
fn by_entries(
    tree: &Bvh<'_>,
    ends: [[f32; 3]; 2],
    facing: Facing,
    budget: &Budget,
    scratch: &mut [ScratchEntry],
) -> Result<FirstHit, QueryError> {
    let Some(start) = SegmentStart::find(tree, ends, budget, scratch)? else {
        return Ok(FirstHit::CLEAR);
    };
    along(tree, &start, facing, budget, scratch)
}

/// The answer about a line from its start.
#[inline(always)]
pub(super) fn along(
    tree: &Bvh<'_>,
    start: &SegmentStart,
    facing: Facing,
    budget: &Budget,
    scratch: &mut [ScratchEntry],
) -> Result<FirstHit, QueryError> {
    let query = SegmentQuery::new(tree, start);
    let mut work = Work::default();
    let collector = FirstCrossing::new(tree, &query);
    let flagged = compiled_flagged();
    let mut visitor = SegmentVisitor { query: &query, facing, flagged, collector };
    let (steps, visits, counts) = (budget.steps, &mut visitor, &mut work);
    // Without an FPU floats take most of the time: there a call for each leaf costs little.
    let descent = if SOFT_FLOAT {
        descend(tree, &query, steps, scratch, visits, counts)?
    } else {
        descend_inlined(tree, &query, steps, scratch, visits, counts)?
    };
    visitor.collector.answer(&query, descent, work)
}

/// The answer, if neither steps nor memory may end the search. With one of these limits the order
/// of visits decides the answer, and it is that of all targets.
#[cfg(meshsweep_wide)]
#[inline(always)]
pub(crate) fn first_hit_by_blocks(
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
) -> Option<Result<FirstHit, QueryError>> {
    if !is_unlimited(tree, budget, scratch) {
        return None;
    }
    let start = match SegmentStart::find(tree, ends, budget, scratch) {
        Ok(Some(start)) => start,
        Ok(None) => return Some(Ok(FirstHit::CLEAR)),
        Err(error) => return Some(Err(error)),
    };
    let query = SegmentQuery::new(tree, &start);
    let found = kernels.search(tree, &query, facing, FirstCrossing::new(tree, &query), scratch)?;
    Some(match found {
        Ok((found, work)) => found.answer(&query, Descent::Done, work),
        Err(error) => Err(error),
    })
}

struct FirstCrossing<'a> {
    tree: &'a Bvh<'a>,
    /// Bits of a parameter. If `certain`, the input's surface is met not after it. Else the
    /// segment's end.
    limit: u32,
    /// The input's surface is not met before this parameter.
    lower: f32,
    /// The first stored triangle that is met, and where.
    best: (f32, TriangleAt),
    certain: bool,
}

impl<'a> FirstCrossing<'a> {
    #[inline(always)]
    fn new(tree: &'a Bvh<'a>, query: &SegmentQuery) -> Self {
        FirstCrossing {
            limit: query.ray.end().to_bits(),
            lower: f32::INFINITY,
            best: (f32::INFINITY, TriangleAt::NONE),
            certain: false,
            tree,
        }
    }

    #[inline(always)]
    fn answer(
        &self,
        query: &SegmentQuery,
        descent: Descent,
        work: Work,
    ) -> Result<FirstHit, QueryError> {
        let (mut lower, mut ended) = (self.lower, Ended::Exact);
        if let Descent::Truncated { least, ended: why } = descent {
            lower = lesser(lower, f32::from_bits(least));
            ended = why;
        } else if !(self.certain || lower == f32::INFINITY) {
            ended = Ended::Resolution;
        }
        let mut hit = None;
        let (t, triangle) = self.best;
        if t < f32::INFINITY {
            let number = triangle.number(self.tree).ok_or(QueryError::Unchecked)?;
            hit = Some(query.hit(t, self.tree.source(number)));
        }
        let upper = match (self.certain, hit) {
            (true, _) => query.upper(f32::from_bits(self.limit)),
            (false, Some(_)) => 1.0,
            (false, None) => f32::INFINITY,
        };
        Ok(FirstHit { t: Interval::new(query.lower(lower), upper), hit, work, ended })
    }
}

impl CrossingCollector for FirstCrossing<'_> {
    #[inline(always)]
    fn limit(&self) -> u32 {
        self.limit
    }

    #[inline(always)]
    fn meet(&mut self, crossing: &Crossing, triangle: TriangleAt) -> Option<()> {
        if crossing.lower < self.lower {
            self.lower = crossing.lower;
        }
        let (t, best) = self.best;
        // Of equal parameters the first triangle in blob order counts, which is that of places.
        if crossing.stored && (crossing.t < t || crossing.t == t && triangle < best) {
            self.best = (crossing.t, triangle);
            #[cfg(meshsweep_wide)]
            prefetch_source(self.tree, triangle.node(), triangle.child());
        }
        Some(())
    }

    #[inline(always)]
    fn certain(&mut self, upper: f32) {
        self.certain = true;
        if upper < f32::from_bits(self.limit) {
            self.limit = upper.to_bits();
        }
    }

    #[inline(always)]
    fn covered(&mut self, _: u32, upper: f32, _: TriangleAt) -> Option<()> {
        self.certain(upper);
        Some(())
    }

    #[inline(always)]
    fn is_answered(&self) -> bool {
        false
    }

    const TELLS_EACH: bool = false;
}
