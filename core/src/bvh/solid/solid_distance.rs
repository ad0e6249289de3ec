//! The distance of a convex solid and the surface.

use super::box_keys::{ByDistance, distance_of};
use super::leaf_search::{GapVisitor, LeafSearch, TriangleGap};
use super::placed::PlacedSolid;
use crate::bvh::tree::descent::{Descent, descend};
use crate::bvh::tree::format::Bvh;
use crate::num::tolerance::U32;
use crate::num::{greater, lesser};
use crate::query::{Budget, Ended, Interval, QueryError, ScratchEntry, Solid, SolidDistance, Work};

impl Bvh<'_> {
    /// The least distance of a point of `solid` from the surface, and where the two are nearest.
    ///
    /// The interval contains the distance of the input mesh, even if a grid moved vertices. It is
    /// `0 ..= 0` if it is proved that the solid and the surface meet. Only the surface counts: of a
    /// solid inside of a closed mesh it is the distance from the surface. If it is above 0,
    /// [`signed_distance`](Bvh::signed_distance) of a corner tells whether the solid is inside. Ask
    /// [`solid_within`](Bvh::solid_within) where a threshold matters: it is faster.
    ///
    /// `scratch`: [`scratch_entries`](Bvh::scratch_entries) make overflow impossible. With fewer
    /// the interval still holds, and [`Ended::Scratch`] says so. Lengths and coordinates are in
    /// input units, in the mesh's frame. A tolerance or the steps of the budget end the search
    /// earlier. A search that ends before the first triangle goes down to one all the same, and
    /// does not count that.
    ///
    /// Solids may be flat, or have equal corners. A solid without radius that the surface only
    /// touches has a lower end of 0 and an upper end of the surface error and rounding.
    ///
    /// Cost: five to twenty nodes. Of the triangles that boxes leave, each takes an inner product
    /// in f64 for each corner of the solid, some five times.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Bvh, Scratch, Solid};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/groove.msw"));
    /// let (part, mut scratch) = (Bvh::open(bytes)?, Scratch::<64>::new());
    /// let spindle = Solid::new(&[[3.0, 0.0, 40.0], [3.0, 0.0, 90.0]], 4.0)?;
    /// let found = part.solid_distance(&spindle, Budget::EXACT, &mut scratch)?;
    /// assert!(found.distance.lower <= found.distance.upper);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// Source: Gilbert, Johnson and Keerthi, *A Fast Procedure for Computing the Distance Between
    /// Complex Objects in Three-Dimensional Space* (1988), with bounds that hold whatever it finds.
    ///
    /// # Errors
    /// [`QueryError::NotServed`] unless the tree has boxes for segments;
    /// [`QueryError::OutOfDomain`] for a corner or a radius beyond 2^30 grid units;
    /// [`QueryError::Tolerance`] if a tolerance of the budget is negative, NaN or infinite;
    /// [`QueryError::NoScratch`] for scratch without entries.
    #[inline(never)]
    pub fn solid_distance(
        &self,
        solid: &Solid<'_>,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<SolidDistance, QueryError> {
        budget.check_with(scratch)?;
        let mut placed = PlacedSolid::NONE;
        placed.set(self, solid, None)?;
        let mut work = Work::default();
        let nearest = Nearest {
            placed: &placed,
            best: None,
            lower: f64::INFINITY,
            limit: f64::INFINITY,
            relative: f64::from(budget.relative),
            absolute: placed.lengths.inward(budget.absolute),
        };
        let query = ByDistance(&placed);
        let mut search = LeafSearch::new(&placed, nearest);
        let descent = descend(self, &query, budget.steps, scratch, &mut search, &mut work)?;
        work.exact = search.measured;
        let (best, lower, ended) = match search.visitor.best {
            Some(best) => {
                let (lower, ended) = search.visitor.lower(descent);
                (best, lower, ended)
            }
            // The search ended before the first leaf.
            None => {
                let best = some_triangle(self, &placed, scratch)?;
                let lower = match descent {
                    Descent::Truncated { least, .. } => distance_of(least),
                    _ => 0.0,
                };
                (best, lower, descent.ended())
            }
        };
        let distance = if placed.meets(&best) {
            Interval::new(0.0, 0.0)
        } else {
            let Interval { lower, upper } = placed.distance(lower, best.gap.upper);
            Interval::new(lesser(lower, upper), upper)
        };
        Ok(SolidDistance {
            distance,
            points: best.gap.points.map(|point| placed.to_input(point)),
            triangle: best.place.source(self).ok_or(QueryError::Unchecked)?,
            work,
            ended,
        })
    }
}

/// A triangle that a descent reaches first. A call, so that its stack is not the caller's.
#[cold]
#[inline(never)]
fn some_triangle(
    tree: &Bvh<'_>,
    placed: &PlacedSolid,
    scratch: &mut [ScratchEntry],
) -> Result<TriangleGap, QueryError> {
    let mut search = LeafSearch::new(placed, FirstTriangle(None));
    let mut work = Work::default();
    descend(tree, &ByDistance(placed), u32::MAX, scratch, &mut search, &mut work)?;
    search.visitor.0.ok_or(QueryError::Unchecked)
}

/// The visitor that wants the nearest triangle.
struct Nearest<'a> {
    placed: &'a PlacedSolid,
    best: Option<TriangleGap>,
    /// The least lower end of all triangles that were measured.
    lower: f64,
    /// Triangles that are farther cannot matter, for the tolerance or at all.
    limit: f64,
    relative: f64,
    absolute: f64,
}

impl Nearest<'_> {
    /// The least lower end that meets the tolerance: upper ≤ lower · (1 + relative), or upper −
    /// lower ≤ absolute, where the answer's ends lack the radius, have the surface error and are
    /// rounded to f32.
    fn tolerated(&self, upper: f64) -> f64 {
        let (error, radius) = (self.placed.lengths.error, self.placed.radius);
        let (told, rounded) = (greater(0.0, upper - radius + error), 4.0 * f64::from(U32));
        let relative = told / (1.0 + self.relative) * (1.0 + rounded);
        let absolute = told - greater(0.0, self.absolute - told * rounded);
        let least = lesser(relative, absolute) + error + radius;
        greater(0.0, lesser(upper, least))
    }

    /// The lower end of all triangles, and why the search ended.
    fn lower(&self, descent: Descent) -> (f64, Ended) {
        let lower = lesser(self.lower, self.limit);
        match descent {
            Descent::Truncated { least, ended } => (lesser(lower, distance_of(least)), ended),
            _ if self.limit < self.lower => (lower, Ended::Tolerance),
            _ => (lower, Ended::Exact),
        }
    }
}

impl GapVisitor for Nearest<'_> {
    #[inline(always)]
    fn limit(&self) -> f64 {
        self.limit
    }

    fn take(&mut self, found: &TriangleGap) -> bool {
        self.lower = lesser(self.lower, found.gap.lower);
        let meets = self.placed.meets(found);
        if meets || self.best.is_none_or(|best| found.gap.upper < best.gap.upper) {
            self.best = Some(*found);
            self.limit = self.tolerated(found.gap.upper);
        }
        !meets
    }
}

/// The visitor that ends at the first triangle.
struct FirstTriangle(Option<TriangleGap>);

impl GapVisitor for FirstTriangle {
    fn limit(&self) -> f64 {
        f64::INFINITY
    }

    fn take(&mut self, found: &TriangleGap) -> bool {
        self.0 = Some(*found);
        false
    }
}
