//! Signed distance.
//!
//! *What the sign means.* In a closed mesh, triangles run through every edge as often in one
//! direction as in the other. It has a winding number at every point off the surface. The number
//! rises by one where a triangle is crossed from its front to its back. `Inside` says that the
//! surface next to the point has its back to it, `Outside` its front. For a mesh that bounds a
//! solid (winding number 1 in it, 0 elsewhere) these are the usual inside and outside. For an
//! inverted mesh the sides are exchanged: the solid is the rest of space. Components that *overlap*
//! are not united. A point may lie in one component while the nearest surface belongs to another
//! and has its front to the point. Then the answer is `Outside`. A cavity's winding decides its
//! side, as for any surface.
//!
//! *Why the stored surface's sign is the input's.* Move every vertex on a straight line from its
//! input place to its stored place. Every point of every triangle moves by at most `surface_error`.
//! So the surface never touches a point farther from the stored surface, and the point's winding
//! number cannot change. At a smaller distance the side is undecided.
//!
//! *How it is found.* Let q be the closest point, and w₀ the winding number at the query p. No
//! surface is nearer than q. So the winding number is w₀ in a half-space of directions about q. Let
//! triangles i about q have unit normals nᵢ and angles αᵢ at q (π where q lies on an edge, 2π
//! within a face). The divergence theorem on a small ball about q gives Σ αᵢ·nᵢ = −2·∫(w(x) − w₀)·x
//! over the directions x. It holds for any arrangement of triangles, manifold or not. Only
//! directions with x·(p − q) ≤ 0 contribute. So (p − q)·Σ αᵢ·nᵢ is positive if the winding number
//! is greater behind q than at p, that is, if p is outside. (Bærentzen & Aanæs, *Signed Distance
//! Computation Using the Angle Weighted Pseudonormal*, 2005, prove it for manifolds.)
//!
//! *Rounding.* In f32 the closest triangle is not certain. So all triangles that may be the closest
//! are candidates. The side is searched in four steps, until one decides:
//! 1. Every candidate clearly has its front to p, or every one its back. Then all terms of the sum
//!    at the true q have one sign. This decides faces, smooth edges and vertices, and ties.
//! 2. [`pseudonormal`](super::pseudonormal) sums about the feature that all candidates share.
//! 3. A point outside the model's box is replaced by one outside that is nearer to the box. All
//!    points outside the box are on one side.
//! 4. The search starts again from a place nearer to the surface, within the empty ball about p.
//!    High above a face and next to its edge, rounding cannot tell this face from the one beyond
//!    the edge. From a sixteenth of the distance it can.

use super::descent::{Descent, LeafVisit, descend};
use super::point_query::PointQuery;
use super::pseudonormal::{Candidates, ViewedSide, side_of_shared_feature, viewed_side};
use super::side_search::Search;
use super::triangle_bounds::{limit_of, lower_of_box, witness};
use super::triangle_visitor::{LeafTriangle, Next, TriangleCollector, TriangleVisitor};
use crate::bvh::format::{Bvh, FanLeaf};
use crate::num::tolerance::{EMPTY_BALL, EVERYTHING_SQ, FAN_DISTANCE, U32};
use crate::num::{greater, lesser, sqrt_approx};
use crate::query::{
    Budget, ClosestPoint, Ended, Interval, QueryError, ScratchEntry, Side, Undecided, Work,
};
use glam::Vec3;

/// Signed distance: positive outside, negative inside.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct SignedDistance {
    /// The signed distance to the input mesh, input units. If the side is undecided, from minus the
    /// distance to the distance.
    pub distance: Interval,
    /// The side of the point.
    pub side: Side,
    /// The closest point, and the distance without sign. `work` and `ended` are those of the whole
    /// search. [`Ended::Resolution`]: sides are defined, and the stored surface or rounding leaves
    /// this one undecided.
    pub closest: ClosestPoint,
}

impl SignedDistance {
    pub(super) fn new(closest: ClosestPoint, side: Side) -> Self {
        let Interval { lower, upper } = closest.distance;
        let distance = match side {
            Side::Outside => Interval { lower, upper },
            Side::Inside => Interval { lower: -upper, upper: -lower },
            Side::Undecided(_) => Interval { lower: -upper, upper },
        };
        SignedDistance { distance, side, closest }
    }
}

impl Bvh<'_> {
    /// Signed distance of `point` (input units), negative where the nearest surface has its back to
    /// the point.
    ///
    /// For a mesh that bounds a solid this is the usual signed distance. For an inverted mesh the
    /// sides are exchanged. A cavity's winding decides its side. Components that overlap are not
    /// united: the nearest surface decides. If several surfaces are equally near up to rounding and
    /// the surface error, one of them decides.
    ///
    /// The side is never wrong. It is undecided:
    /// - if the mesh is not closed and consistently wound ([`is_closed`](Bvh::is_closed));
    /// - if the distance is not clear of the surface error and rounding;
    /// - next to walls and gaps thinner than these;
    /// - next to slivers so flat that they have no certain normal;
    /// - where a triangle without area is certainly the nearest, because it has no sides.
    ///
    /// `scratch` as for [`closest_point`](Bvh::closest_point). If it is too short, or the steps too
    /// few, the side is undecided too. Of the budget only `steps` matters: a side needs the closest
    /// point itself. Triangle and point are those of [`closest_point`](Bvh::closest_point).
    ///
    /// Cost: about that of the closest point. Two to three times as much next to sharp edges and
    /// vertices, and for points far outside. Up to four times more above a face and next to its
    /// edge, where the side is searched from nearer places. Source: Bærentzen & Aanæs 2005.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Bvh, Scratch, Side};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/groove.msw"));
    /// let (part, mut scratch) = (Bvh::open(bytes)?, Scratch::<64>::new());
    /// let far = part.signed_distance([300.0, 0.0, 0.0], Budget::EXACT, &mut scratch)?;
    /// assert_eq!(far.side, Side::Outside);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`QueryError::NotFinite`], [`QueryError::Tolerance`], [`QueryError::NoScratch`],
    /// [`QueryError::NotServed`].
    #[inline(never)]
    pub fn signed_distance(
        &self,
        point: [f32; 3],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<SignedDistance, QueryError> {
        let tree = self;
        let query = PointQuery::prepare(tree, point, &budget, scratch)?;
        let closed = tree.is_closed();
        let (steps, stack) = (budget.steps, scratch);
        let mut search = Search { tree, steps, stack, work: Work::default(), truncated: None };
        let survey = if query.far { None } else { Some(search.survey_with_area(&query)?) };
        let mut closest = match &survey {
            Some(survey) => survey.closest(&search, point)?,
            None => tree.closest_point(point, Budget::EXACT.with_steps(steps), search.stack)?,
        };
        let clear =
            closed && closest.distance.lower > 0.0 && survey.as_ref().is_none_or(Survey::has_sides);
        let mut side = match &survey {
            Some(survey) if clear => search.side(survey)?,
            _ => None,
        };
        if side.is_none()
            && clear
            && search.truncated.is_none()
            && let Some(nearby) = outside_of_box(tree, &query)
        {
            let survey = search.survey_with_area(&nearby)?;
            side = search.side(&survey)?;
        }
        if side.is_none()
            && clear
            && search.truncated.is_none()
            && let Some(survey) = &survey
        {
            side = search.side_from_nearer(survey)?;
        }
        closest.work = search.work;
        if let Some(why) = search.truncated {
            closest.ended = why;
        } else if side.is_none() && closed {
            closest.ended = Ended::Resolution;
        }
        let side = side.unwrap_or(Side::Undecided(match search.truncated {
            _ if !closed => Undecided::OpenMesh,
            Some(why) => why.undecided(),
            None if closest.distance.lower > 0.0 => Undecided::Feature,
            None => Undecided::OnSurface,
        }));
        Ok(SignedDistance::new(closest, side))
    }
}

/// Searches from nearer places, at most.
const NEARER: usize = 3;

/// How far each of them goes towards the surface: a sixteenth of the distance is left.
const WAY_TO_NEARER: f32 = 0.9375;

/// A point outside the model's box, a quarter of the model's size from it. `None` if the query is
/// not outside.
fn outside_of_box(tree: &Bvh<'_>, query: &PointQuery) -> Option<PointQuery> {
    let (low, high) = tree.grid_bounds();
    let size = (high - low).max_element();
    let gap = if size > 0.0 { 0.25 * size } else { 1.0 };
    let out = |p: Vec3| (p - high).max(low - p).to_array();
    let most = out(query.p).into_iter().fold(0f32, greater);
    let mut near = [0f32; 3];
    let mut moved = false;
    let axes = query.p.to_array().into_iter().zip(low.to_array().into_iter().zip(high.to_array()));
    for (slot, (x, (low, high))) in near.iter_mut().zip(axes) {
        let farthest = !moved && (x - high == most || low - x == most) && most > 0.0;
        moved |= farthest;
        *slot = match (farthest, x > high, x < low) {
            (true, true, _) => high + gap,
            (true, ..) => low - gap,
            (_, true, _) => high,
            (_, _, true) => low,
            _ => x,
        };
    }
    let near = PointQuery::new(tree, query.units.point(Vec3::from_array(near))).ok()?;
    let still_outside = out(near.p).into_iter().any(|x| x > 0.0);
    (moved && still_outside && !near.far).then_some(near)
}

impl Search<'_, '_> {
    /// A survey that knows all triangles with an area that may be the closest of these.
    fn survey_with_area<'p>(&mut self, query: &'p PointQuery) -> Result<Survey<'p>, QueryError> {
        let survey = self.survey(query, Bounding::Any)?;
        let is_known = survey.with_area.distance_sq <= survey.best.distance_sq;
        if is_known || survey.best.is_none() || self.truncated.is_some() {
            return Ok(survey);
        }
        let again = self.survey(query, Bounding::WithArea)?;
        Ok(if self.truncated.is_some() { survey } else { again })
    }

    fn survey<'p>(
        &mut self,
        query: &'p PointQuery,
        bounding: Bounding,
    ) -> Result<Survey<'p>, QueryError> {
        let tree = self.tree;
        let collector = Survey {
            query,
            margin: FAN_DISTANCE * U32 * tree.header().star_radius,
            bounding,
            bound_sq: f32::INFINITY,
            band: f32::INFINITY,
            best: LeafTriangle::NONE,
            with_area: LeafTriangle::NONE,
            by_side: [LeafTriangle::NONE; 3],
            least: [f32::INFINITY; 4],
            missed: None,
        };
        let mut visitor = TriangleVisitor::new(tree, query, EVERYTHING_SQ, collector);
        let descent = descend(tree, query, self.steps, self.stack, &mut visitor, &mut self.work)?;
        let mut survey = visitor.collector;
        if let Descent::Truncated { least, ended } = descent {
            survey.missed = Some(least);
            self.truncated = Some(ended);
        }
        Ok(survey)
    }

    /// The side of points on the way to the surface, if it is proved.
    ///
    /// The ball about the surveyed point that touches the surface is empty, so the winding number
    /// is the same in all of it. Nearer to the surface, the distances of two features differ more.
    /// Where components overlap, equally near surfaces may show different sides. So the ways to the
    /// closest triangles of either facing must agree.
    fn side_from_nearer(&mut self, survey: &Survey<'_>) -> Result<Option<Side>, QueryError> {
        let band = Candidates::new(survey.query, survey.margin, survey.with_area.distance_sq).band;
        let mut agreed = None;
        for (place, lower) in survey.by_side.iter().zip(&survey.least) {
            if place.is_none() || *lower > band {
                continue;
            }
            let side = self.side_on_the_way(survey, *place)?;
            if side.is_none() || agreed.is_some() && agreed != side {
                return Ok(None);
            }
            agreed = side;
        }
        Ok(agreed)
    }

    /// The first decided side of the points on the way to a triangle, and from there to the closest
    /// triangle.
    fn side_on_the_way(
        &mut self,
        survey: &Survey<'_>,
        place: LeafTriangle,
    ) -> Result<Option<Side>, QueryError> {
        let mut nearer = survey.nearer(self.tree, place);
        for _ in 0..NEARER {
            let Some(query) = nearer else { break };
            let survey = self.survey_with_area(&query)?;
            let side = self.side(&survey)?;
            if side.is_some() || self.truncated.is_some() {
                return Ok(side);
            }
            nearer = survey.nearer(self.tree, survey.best);
        }
        Ok(None)
    }

    /// The side of the surveyed point, if it is proved. The point is clear of the surface.
    fn side(&mut self, survey: &Survey<'_>) -> Result<Option<Side>, QueryError> {
        let Survey { query, margin, with_area, least, .. } = *survey;
        if self.truncated.is_some() || with_area.is_none() {
            return Ok(None);
        }
        let candidates = Candidates::new(query, margin, with_area.distance_sq);
        let [front, back, unclear, _] = least.map(|lower| lower <= candidates.band);
        match (front, back, unclear) {
            (true, false, false) => Ok(Some(Side::Outside)),
            (false, true, false) => Ok(Some(Side::Inside)),
            _ => {
                let leaf = with_area.leaf(self.tree).ok_or(QueryError::Unchecked)?;
                side_of_shared_feature(self, &candidates, leaf.corners(with_area.lane as usize))
            }
        }
    }
}

impl LeafTriangle {
    const NONE: LeafTriangle = LeafTriangle {
        distance_sq: f32::INFINITY,
        lower_bound_sq: f32::INFINITY,
        number: u32::MAX,
        node: u32::MAX,
        child: 0,
        lane: 0,
    };

    fn is_none(&self) -> bool {
        self.node == u32::MAX
    }

    /// Takes the nearer triangle; of two equally near ones the lesser number.
    #[cfg_attr(any(target_arch = "x86_64", target_arch = "aarch64"), inline(always))]
    #[cfg_attr(not(any(target_arch = "x86_64", target_arch = "aarch64")), inline(never))]
    fn improve(&mut self, other: LeafTriangle) {
        if other.distance_sq < self.distance_sq
            || (other.distance_sq == self.distance_sq && other.number < self.number)
        {
            *self = other;
        }
    }
}

/// The triangles whose distance bounds a survey.
#[derive(Clone, Copy, PartialEq)]
enum Bounding {
    /// All. If one without an area is the nearest, others with an area may be missed.
    Any,
    /// Those with an area.
    WithArea,
}

/// The triangles near a point.
struct Survey<'p> {
    query: &'p PointQuery,
    margin: f32,
    bounding: Bounding,
    /// The least squared distance of a bounding triangle.
    bound_sq: f32,
    /// The [`Candidates::band`] of `bound_sq`: farther triangles are no candidates.
    band: f32,
    /// The closest triangle.
    best: LeafTriangle,
    /// The closest triangle with an area.
    with_area: LeafTriangle,
    /// The closest triangle with its front to the point, with its back, with an unclear side. The
    /// index is a [`ViewedSide`].
    by_side: [LeafTriangle; 3],
    /// For each [`ViewedSide`] the least lower bound of its triangles, grid units.
    least: [f32; 4],
    /// Least key of the nodes that were not opened.
    missed: Option<u32>,
}

impl Survey<'_> {
    /// Takes the distance of a triangle that bounds the survey.
    #[inline(always)]
    fn bound(&mut self, distance_sq: f32, limit: &mut f32) {
        if distance_sq < self.bound_sq {
            self.bound_sq = distance_sq;
            self.band = Candidates::new(self.query, self.margin, distance_sq).band;
            *limit = lesser(*limit, limit_of(self.query, self.band));
        }
    }

    /// Whether a triangle with an area may be the closest one.
    fn has_sides(&self) -> bool {
        if self.with_area.distance_sq <= self.best.distance_sq {
            return true;
        }
        let band = Candidates::new(self.query, self.margin, self.best.distance_sq).band;
        let [front, back, unclear, _] = self.least;
        front <= band || back <= band || unclear <= band
    }

    /// Lower bound of the distance to the input mesh, input units, without the nodes that were not
    /// opened.
    fn lower(&self) -> f32 {
        let distance = sqrt_approx(self.best.distance_sq);
        self.query.lower(self.least.iter().copied().fold(distance, lesser))
    }

    /// A point on the way to a triangle, a sixteenth of the distance from the triangle, within the
    /// ball about this point that is proved empty.
    fn nearer(&self, tree: &Bvh<'_>, to: LeafTriangle) -> Option<PointQuery> {
        let query = self.query;
        let leaf = to.leaf(tree)?;
        let place = query.p + (witness(query, &leaf, to.lane as usize) - query.p) * WAY_TO_NEARER;
        let nearer = PointQuery::new(tree, query.units.point(place)).ok()?;
        let way = nearer.p - query.p;
        let empty = query.units.inward(self.lower());
        (way.dot(way) < empty * empty * (1.0 - EMPTY_BALL)).then_some(nearer)
    }

    fn closest(
        &self,
        search: &Search<'_, '_>,
        point: [f32; 3],
    ) -> Result<ClosestPoint, QueryError> {
        let Survey { query, best, .. } = *self;
        let tree = search.tree;
        let ended = search.truncated.unwrap_or(Ended::Exact);
        if best.is_none() {
            // No step was allowed, or the scratch memory was full: the box of the model.
            let none = Budget::EXACT.with_steps(0);
            let closest = tree.closest_point(point, none, &mut [ScratchEntry::EMPTY])?;
            return Ok(ClosestPoint { ended, ..closest });
        }
        let distance = sqrt_approx(best.distance_sq);
        let mut lower = self.lower();
        if let Some(missed) = self.missed {
            let missed = lower_of_box(query, missed);
            lower = lesser(lower, missed);
        }
        let leaf = best.leaf(tree).ok_or(QueryError::Unchecked)?;
        Ok(ClosestPoint {
            distance: Interval::new(lower, query.upper(distance)),
            point: query.units.point(witness(query, &leaf, best.lane as usize)),
            triangle: tree.source(best.number),
            work: search.work,
            ended,
        })
    }
}

impl TriangleCollector for Survey<'_> {
    /// A distance that is not refined yet bounds as well.
    #[inline(always)]
    fn nearest(&mut self, _: &LeafVisit<'_>, distance_sq: f32, limit: &mut f32) -> Option<Next> {
        if self.bounding == Bounding::Any {
            self.bound(distance_sq, limit);
        }
        Some(Next::Triangles)
    }

    #[inline(always)]
    fn allowance(&self) -> f32 {
        match self.bounding {
            Bounding::Any => self.query.side_allowance(),
            Bounding::WithArea => f32::INFINITY,
        }
    }

    #[inline(always)]
    fn take(&mut self, here: LeafTriangle, leaf: &FanLeaf<'_>, seen: &[Vec3; 3], limit: &mut f32) {
        let lower = here.lower(leaf, self.query);
        if lower > self.band {
            return;
        }
        self.best.improve(here);
        let facing = viewed_side(leaf, here.lane as usize, seen);
        if facing != ViewedSide::Flat {
            self.with_area.improve(here);
        }
        if facing != ViewedSide::Flat || self.bounding == Bounding::Any {
            self.bound(here.distance_sq, limit);
        }
        if let Some(by_side) = self.by_side.get_mut(facing as usize) {
            by_side.improve(here);
        }
        if let Some(least) = self.least.get_mut(facing as usize)
            && lower < *least
        {
            *least = lower;
        }
    }
}
