//! Whether the mesh is within a distance.
//!
//! This costs less than the distance. The search ends at the first triangle that is certainly near
//! enough, and it opens no node that is certainly too far.

use super::leaf::bounds::limit_within;
use super::leaf::nearest::LeafNearest;
use super::leaf::squares::LeafSquares;
use super::query::{Asked, FarPoint, PointQuery, PreparedPoint};
use super::triangle_visitor::{LeafTriangle, Next, TriangleCollector, TriangleVisitor};
use crate::bvh::tree::descent::{LeafVisit, descend};
use crate::bvh::tree::format::{Bvh, FanLeaf};
use crate::bvh::tree::triangle_at::TriangleAt;
use crate::num::{Real, SOFT_FLOAT, sqrt_approx};
use crate::query::{
    Budget, ClosestPoint, Decided, QueryError, ScratchEntry, Undecided, Verdict, Witness, Work,
};
use glam::Vec3;

impl Bvh<'_> {
    /// Whether the input mesh is at most `distance` from `point`, both in input units.
    ///
    /// It ends as soon as one triangle is certainly near enough. The witness of a `Yes` is this
    /// triangle, by its number in the input file. It is not always the closest one. The verdict is
    /// undecided for [`Resolution`](Undecided::Resolution) if the difference from the distance
    /// asked about is within the surface error and rounding. A distance of 0 asks whether the
    /// point touches the surface: the answer is `No` or, as f32 cannot prove a contact, undecided.
    /// The verdict is undecided for lack of precision only if the distance is within
    /// [`surface_error`](Bvh::surface_error) and rounding of the one asked about. Farther than a
    /// million model sizes the model's box answers.
    ///
    /// `scratch` as for [`closest_point`](Bvh::closest_point). A shorter one may leave the question
    /// undecided; it never makes the answer wrong. Of the budget only `steps` matters.
    ///
    /// Cost: no node if the model's box is beyond the distance, one in small code and without
    /// floating point. Else everything within `distance`, and no more than a few leaves where the
    /// answer is yes.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Bvh, Scratch};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/groove.msw"));
    /// let (part, mut scratch) = (Bvh::open(bytes)?, Scratch::<64>::new());
    /// let near = part.within([3.0, 0.0, 400.0], 5.0, Budget::EXACT, &mut scratch)?;
    /// assert!(near.is_clear());
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`QueryError::NotFinite`]; [`QueryError::Tolerance`] also for a distance that is negative,
    /// NaN or infinite; [`QueryError::NoScratch`]; [`QueryError::NotServed`].
    #[inline(never)]
    pub fn within(
        &self,
        point: [f32; 3],
        distance: f32,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<Decided<u32>, QueryError> {
        let tree = self;
        // A distance is refused as an absolute tolerance is.
        budget.with_absolute(distance).check()?;
        // In place: a copy would take a board as long as the preparation.
        let prepared = PreparedPoint::prepare(tree, point, &budget, scratch);
        let query = match prepared.as_ref().map(PreparedPoint::asked) {
            Ok(Asked::Near(query)) => query,
            Ok(Asked::Far(far)) => return from_afar(tree, point, far, distance),
            Err(refused) => return Err(*refused),
        };
        let mut work = Work::default();
        let limit = limit_within(query, distance);
        let collector = Threshold { query, distance, found: Witness::NONE };
        let mut visitor = TriangleVisitor::new(tree, query, limit, collector);
        // Where steps or memory may end the search, the verdict is that of the search.
        if !(SOFT_FLOAT || cfg!(meshsweep_small))
            && visitor.is_box_beyond()
            && budget.steps == Budget::EXACT.steps
            && scratch.len() >= tree.scratch_entries()
        {
            return Ok(Decided { verdict: Verdict::No, witness: None, work });
        }
        let descent = descend(tree, query, budget.steps, scratch, &mut visitor, &mut work)?;
        let (verdict, place) = visitor.collector.found.proof(descent.cut());
        let mut witness = None;
        if let Some(place) = place {
            witness = Some(place.source(tree).ok_or(QueryError::Unchecked)?);
        }
        Ok(Decided { verdict, witness, work })
    }
}

#[cold]
fn from_afar(
    tree: &Bvh<'_>,
    point: [f32; 3],
    far: FarPoint<'_>,
    distance: f32,
) -> Result<Decided<u32>, QueryError> {
    let ClosestPoint { distance: found, triangle, work, .. } = far.closest_point(tree, point)?;
    let (verdict, witness) = match triangle {
        Some(_) if found.upper <= distance => (Verdict::Yes, triangle),
        _ if found.lower > distance => (Verdict::No, None),
        _ => (Verdict::Undecided(Undecided::Resolution), None),
    };
    Ok(Decided { verdict, witness, work })
}

struct Threshold<'a> {
    query: &'a PointQuery,
    /// Input units.
    distance: f32,
    /// A triangle that is certainly within, one that may be.
    found: Witness<TriangleAt>,
}

impl TriangleCollector for Threshold<'_> {
    #[inline(always)]
    fn nearest(
        &mut self,
        visit: &LeafVisit<'_>,
        (near, _): (&LeafNearest, &LeafSquares),
        limit: &mut f32,
    ) -> Option<Next> {
        if Real(near.distance_sq) <= Real(*limit) && self.is_within(near.distance_sq) {
            let (lane, ..) = near.lane();
            self.found.met = Some(visit.triangle(lane));
            return Some(Next::Nothing);
        }
        Some(if self.found.may.is_some() { Next::Leaf } else { Next::Triangles })
    }

    /// A triangle that a nearer one of the leaf leaves out does not change the verdict: it is not
    /// certainly within unless the nearer one is, and it is beyond if the nearer one is.
    #[inline(always)]
    fn allowance(&self) -> f32 {
        self.query.side_allowance()
    }

    /// A triangle that is not certainly beyond the distance leaves the verdict undecided. A refined
    /// sliver may be certainly within.
    #[inline(always)]
    fn take(
        &mut self,
        triangle: LeafTriangle,
        leaf: &FanLeaf<'_>,
        _: Option<&[Vec3; 3]>,
        _: &mut f32,
    ) {
        if self.found.met.is_none() && self.is_within(triangle.distance_sq) {
            self.found.met = Some(triangle.place);
        }
        if self.found.may.is_none()
            && self.query.lower(triangle.lower(leaf, self.query)) <= self.distance
        {
            self.found.may = Some(triangle.place);
        }
    }

    #[inline(always)]
    fn is_answered(&self) -> bool {
        self.found.met.is_some()
    }
}

impl Threshold<'_> {
    /// Whether a triangle at this squared distance is certainly within.
    #[inline(always)]
    fn is_within(&self, distance_sq: f32) -> bool {
        self.query.upper(sqrt_approx(distance_sq)) <= self.distance
    }
}
