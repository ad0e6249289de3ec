//! The first common point of a segment and the surface.

use super::descent::{Descent, descend, descend_inlined};
use super::segment_leaf::{CrossingCollector, Facing, HitPlace, SegmentVisitor};
use super::segment_query::SegmentQuery;
use super::segment_start::SegmentStart;
use super::triangle_place::TrianglePlace;
use crate::bvh::format::Bvh;
use crate::geom::fan::Crossing;
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
        let Some(start) = SegmentStart::find(self, [a, b], &budget, scratch)? else {
            return Ok(FirstHit::CLEAR);
        };
        let query = SegmentQuery::new(self, &start);
        let mut work = Work::default();
        let collector = FirstCrossing {
            limit: query.ray.end(),
            lower: f32::INFINITY,
            best: HitPlace { t: f32::INFINITY, node: 0, child: 0, lane: 0 },
            certain: false,
            tree: self,
        };
        let mut visitor = SegmentVisitor { query: &query, facing, collector };
        let (steps, visits, counts) = (budget.steps, &mut visitor, &mut work);
        // Without an FPU floats take most of the time: there a call for each leaf costs little.
        let descent = if SOFT_FLOAT {
            descend(self, &query, steps, scratch, visits, counts)?
        } else {
            descend_inlined(self, &query, steps, scratch, visits, counts)?
        };
        visitor.collector.answer(&query, descent, work)
    }
}

struct FirstCrossing<'a> {
    tree: &'a Bvh<'a>,
    /// If `certain`, the input's surface is met not after this parameter. Else the segment's end.
    limit: f32,
    /// The input's surface is not met before this parameter.
    lower: f32,
    best: HitPlace,
    certain: bool,
}

impl FirstCrossing<'_> {
    #[inline(always)]
    fn number(&self, place: &HitPlace) -> Option<u32> {
        let &HitPlace { node, child, lane, .. } = place;
        TrianglePlace::new(node, child, lane as usize).number(self.tree)
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
        if self.best.t < f32::INFINITY {
            let number = self.number(&self.best).ok_or(QueryError::Unchecked)?;
            hit = Some(query.hit(self.best.t, self.tree.source(number)));
        }
        let upper = match (self.certain, hit) {
            (true, _) => query.upper(self.limit),
            (false, Some(_)) => 1.0,
            (false, None) => f32::INFINITY,
        };
        Ok(FirstHit { t: Interval::new(query.lower(lower), upper), hit, work, ended })
    }
}

impl CrossingCollector for FirstCrossing<'_> {
    #[inline(always)]
    fn limit(&self) -> f32 {
        self.limit
    }

    #[inline(always)]
    fn meet(&mut self, crossing: &Crossing, node: u32, child: u32, lane: u32) -> Option<()> {
        if crossing.lower < self.lower {
            self.lower = crossing.lower;
        }
        if crossing.stored && crossing.t <= self.best.t {
            let place = HitPlace { t: crossing.t, node, child, lane };
            if crossing.t < self.best.t || self.number(&place) < self.number(&self.best) {
                self.best = place;
            }
        }
        Some(())
    }

    #[inline(always)]
    fn certain(&mut self, upper: f32) {
        self.certain = true;
        if upper < self.limit {
            self.limit = upper;
        }
    }

    #[inline(always)]
    fn covered(&mut self, _: u32, upper: f32, _: u32, _: u32) -> Option<()> {
        self.certain(upper);
        Some(())
    }

    #[inline(always)]
    fn is_answered(&self) -> bool {
        false
    }

    const TELLS_EACH: bool = false;
}
