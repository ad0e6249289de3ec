//! The distance of a convex solid and the surface.

use super::box_keys::{ByDistance, distance_of};
use super::leaf_search::LeafSearch;
use super::placed_solid::PlacedSolid;
use crate::bvh::tree::descent::{Descent, descend};
use crate::bvh::tree::format::Bvh;
use crate::bvh::tree::gap::{Gap, GapVisitor, NearestGap};
use crate::bvh::tree::triangle_at::TriangleAt;
use crate::num::lesser;
use crate::query::{Budget, Interval, QueryError, ScratchEntry, Solid, SolidDistance, Work};

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
    /// the interval still holds, and [`Ended::Scratch`](crate::Ended::Scratch) says so. Lengths and
    /// coordinates are in input units, in the mesh's frame. A tolerance or the steps of the budget
    /// end the search earlier. A search that ends before the first triangle goes down to one all
    /// the same, and does not count that.
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
        let nearest = NearestGap::new(&placed.lengths, placed.radius, &budget);
        let query = ByDistance(&placed);
        let mut search = LeafSearch::new(&placed, nearest);
        let descent = descend(self, &query, budget.steps, scratch, &mut search, &mut work)?;
        work.exact = search.measured;
        let (best, lower, ended) = match search.visitor.best {
            Some(best) => {
                let missed = match descent {
                    Descent::Truncated { least, ended } => Some((ended, distance_of(least))),
                    _ => None,
                };
                let (lower, ended) = search.visitor.lower(missed);
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
        let distance = if best.meets {
            Interval::new(0.0, 0.0)
        } else {
            let Interval { lower, upper } = placed.distance(lower, best.upper);
            Interval::new(lesser(lower, upper), upper)
        };
        Ok(SolidDistance {
            distance,
            points: best.points.map(|point| placed.to_input(point)),
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
) -> Result<Gap<TriangleAt>, QueryError> {
    let mut search = LeafSearch::new(placed, FirstTriangle(None));
    let mut work = Work::default();
    descend(tree, &ByDistance(placed), u32::MAX, scratch, &mut search, &mut work)?;
    search.visitor.0.ok_or(QueryError::Unchecked)
}

/// The visitor that ends at the first triangle.
struct FirstTriangle(Option<Gap<TriangleAt>>);

impl GapVisitor<TriangleAt> for FirstTriangle {
    fn limit(&self) -> f64 {
        f64::INFINITY
    }

    fn take(&mut self, found: &Gap<TriangleAt>) -> bool {
        self.0 = Some(*found);
        false
    }
}
