//! Signed distance.
//!
//! *What the sign means.* In a closed mesh, triangles run through every edge as often in one
//! direction as in the other. It has a winding number at every point off the surface. The number
//! rises by one where a triangle is crossed from its front to its back. `Inside` says that the
//! surface next to the point has its back to it, `Outside` its front. For a mesh that bounds a
//! solid (winding number 1 in it, 0 elsewhere) these are the usual inside and outside. For an
//! inverted mesh the sides are exchanged: the solid is the rest of space. Parts that *overlap* are
//! not united: a point may lie in one part while the nearest surface belongs to another part and
//! has its front to the point. Then the answer is outside. Cavities are as their winding says.
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
//! over the directions x, for any arrangement of triangles, manifold or not; and only directions
//! with x·(p − q) ≤ 0 contribute. So (p − q)·Σ αᵢ·nᵢ is positive if the winding number is greater
//! behind q than at p: outside. (Bærentzen & Aanæs, *Signed Distance Computation Using the Angle
//! Weighted Pseudonormal*, 2005, prove it for manifolds.)
//!
//! *Rounding.* In f32 the closest triangle is not certain. So all triangles that may be the closest
//! are candidates. If every candidate clearly has its front to p, all terms of the sum at the true
//! q are positive; likewise for backs. This decides faces, smooth edges and vertices, and ties.
//! Else [`pseudonormal`](super::pseudonormal) sums about the feature that all candidates share. If
//! rounding leaves this open too, the search starts again from a place nearer to the surface,
//! within the empty ball about p. Far above a face and next to its edge, rounding cannot tell the
//! face beyond the edge from the face; from a sixteenth of the distance it can. If this does not
//! help either, the side is undecided. A point outside the model's box is replaced by a nearer
//! point: all points outside the box are on one side.

use super::closest_point::closest_point;
use super::descent::{Descent, LeafVisit, LeafVisitor, descend};
use super::leaf_distance::nearest_triangle;
use super::point_query::{PointQuery, bounds};
use super::pseudonormal::{Candidates, ViewedSide, side_of_shared_feature, viewed_side};
use super::side_search::{OPEN, Search};
use super::triangle_bounds::{each_triangle, limit_of, lower_of, lower_of_box, witness};
use crate::bvh::format::Bvh;
use crate::num::sqrt_approx;
use crate::num::tolerance::{EVERYTHING_SQ, FAN_DISTANCE, U32};
use crate::query::{
    Budget, ClosestPoint, Ended, Interval, QueryError, ScratchEntry, Side, Undecided, Work,
};
use glam::Vec3;

/// Signed distance: positive outside, negative inside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SignedDistance {
    /// The signed distance to the input mesh, input units. If the side is undecided, from minus the
    /// distance to the distance.
    pub distance: Interval,
    /// The side of the point.
    pub side: Side,
    /// The closest point, and the distance without sign. `work` and `ended` are those of the whole
    /// search. [`Ended::Resolution`]: the mesh is closed, and the stored surface or rounding leaves
    /// the side open.
    pub closest: ClosestPoint,
}

impl SignedDistance {
    fn new(closest: ClosestPoint, side: Side) -> Self {
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
    /// sides are exchanged. Parts that overlap are not united: the nearest surface decides, and of
    /// surfaces that are equally near up to rounding and the surface error, one of them. Cavities
    /// are as their winding says.
    ///
    /// The side is never wrong. It is undecided if the mesh is not closed and consistently wound
    /// ([`is_closed`](Bvh::is_closed)), if the distance is not clear of the surface error and
    /// rounding, next to walls and gaps thinner than these, next to slivers so flat that they have
    /// no certain normal, and where a triangle without area is certainly nearer than every other:
    /// it has no sides.
    ///
    /// `scratch` as for [`closest_point`](Bvh::closest_point). If it is too short, or the steps too
    /// few, the side is undecided too. Of the budget only `steps` matters: a side needs the closest
    /// point itself. Triangle and point are those of [`closest_point`](Bvh::closest_point).
    ///
    /// Cost: about that of the closest point. Two to three times as much next to sharp edges and
    /// vertices, and for points far outside. Up to four times more where the side has to be found
    /// from nearer by, above a face and next to its edge. Source: Bærentzen & Aanæs 2005.
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
    pub fn signed_distance(
        &self,
        point: [f32; 3],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<SignedDistance, QueryError> {
        let tree = self;
        budget.check()?;
        if scratch.is_empty() {
            return Err(QueryError::NoScratch);
        }
        let query = PointQuery::new(tree, point)?;
        let closed = tree.is_closed();
        let (steps, stack) = (budget.steps, scratch);
        let mut search = Search { tree, steps, stack, work: Work::default(), cut: None };
        let survey = if query.far { None } else { Some(search.survey(&query)?) };
        let mut closest = match &survey {
            Some(survey) => survey.closest(&search, point)?,
            None => closest_point(tree, point, &Budget::EXACT.with_steps(steps), search.stack)?,
        };
        let clear =
            closed && closest.distance.lower > 0.0 && survey.as_ref().is_none_or(Survey::has_sides);
        let mut side = match &survey {
            Some(survey) if clear => search.side(survey)?,
            _ => OPEN,
        };
        if side == OPEN
            && clear
            && search.cut.is_none()
            && let Some(nearby) = outside_of_box(tree, &query)
        {
            let survey = search.survey(&nearby)?;
            side = search.side(&survey)?;
        }
        if side == OPEN
            && clear
            && search.cut.is_none()
            && let Some(survey) = &survey
        {
            side = search.side_from_nearer(survey)?;
        }
        closest.work = search.work;
        if let Some(cut) = search.cut {
            closest.ended = cut;
        } else if side == OPEN && closed {
            closest.ended = Ended::Resolution;
        }
        if side == OPEN {
            side = Side::Undecided(match search.cut {
                _ if !closed => Undecided::OpenMesh,
                Some(cut) => cut.undecided(),
                None if closest.distance.lower > 0.0 => Undecided::Feature,
                None => Undecided::OnSurface,
            });
        }
        Ok(SignedDistance::new(closest, side))
    }
}

/// Searches from nearer places. Each time the distance falls to a sixteenth.
const NEARER: usize = 3;

/// For a point outside the model's box another point outside, a quarter of the model's size from
/// the box.
fn outside_of_box(tree: &Bvh<'_>, query: &PointQuery) -> Option<PointQuery> {
    let (low, high) = bounds(tree);
    let size = (high - low).max_element();
    let gap = if size > 0.0 { 0.25 * size } else { 1.0 };
    let out = |p: Vec3| (p - high).max(low - p).to_array();
    let most = out(query.p).into_iter().fold(0f32, |most, x| if x > most { x } else { most });
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
    fn survey<'p>(&mut self, query: &'p PointQuery) -> Result<Survey<'p>, QueryError> {
        let tree = *self.tree;
        let margin = FAN_DISTANCE * U32 * tree.header().star_radius;
        let mut sides = Sides {
            tree: &tree,
            query,
            margin,
            best: Place::NOWHERE,
            solid: Place::NOWHERE,
            seen: [Place::NOWHERE; 3],
            limit: EVERYTHING_SQ,
            least: [f32::INFINITY; 4],
        };
        let descent = descend(&tree, query, self.steps, self.stack, &mut sides, &mut self.work)?;
        let Sides { best, solid, seen, least, .. } = sides;
        let mut missed = f32::INFINITY;
        if let Descent::Truncated { least, ended } = descent {
            missed = least;
            self.cut = Some(ended);
        }
        Ok(Survey { query, margin, best, solid, seen, least, missed })
    }

    /// The side of points on the ways to the surface. The ball about the surveyed point that
    /// touches the surface is empty, so the winding number is the same in all of it. The difference
    /// of two features' distances grows as the inverse of the distance. Where parts overlap,
    /// equally near surfaces may show different sides: the ways to the closest triangles of either
    /// facing must agree.
    fn side_from_nearer(&mut self, survey: &Survey<'_>) -> Result<Side, QueryError> {
        let band = Candidates::new(survey.query, survey.margin, survey.solid.distance_sq).band;
        let mut agreed = None;
        for (place, lower) in survey.seen.into_iter().zip(survey.least) {
            if place.node == u32::MAX || lower > band {
                continue;
            }
            let side = self.side_on_the_way(survey, place)?;
            if side == OPEN || agreed.is_some_and(|agreed| agreed != side) {
                return Ok(OPEN);
            }
            agreed = Some(side);
        }
        Ok(agreed.unwrap_or(OPEN))
    }

    /// The first decided side of the points on the way to a triangle, and from there to the closest
    /// triangle.
    fn side_on_the_way(&mut self, survey: &Survey<'_>, place: Place) -> Result<Side, QueryError> {
        let mut nearer = survey.nearer(self.tree, place);
        for _ in 0..NEARER {
            let Some(query) = nearer else { break };
            let survey = self.survey(&query)?;
            let side = self.side(&survey)?;
            if side != OPEN || self.cut.is_some() {
                return Ok(side);
            }
            nearer = survey.nearer(self.tree, survey.best);
        }
        Ok(OPEN)
    }

    /// The side of the surveyed point, which is known to be clear of the surface.
    fn side(&mut self, survey: &Survey<'_>) -> Result<Side, QueryError> {
        let Survey { query, margin, solid, least, .. } = *survey;
        if self.cut.is_some() || solid.node == u32::MAX {
            return Ok(OPEN);
        }
        let candidates = Candidates::new(query, margin, solid.distance_sq);
        let [front, back, unclear, _] = least.map(|lower| lower <= candidates.band);
        match (front, back, unclear) {
            (true, false, false) => Ok(Side::Outside),
            (false, true, false) => Ok(Side::Inside),
            _ => {
                let leaf = self.tree.leaf(solid.node, solid.child).ok_or(QueryError::Unchecked)?;
                side_of_shared_feature(self, &candidates, leaf.corners(solid.lane))
            }
        }
    }
}

/// The place of a triangle.
#[derive(Clone, Copy)]
struct Place {
    distance_sq: f32,
    node: u32,
    child: u32,
    lane: usize,
}

impl Place {
    const NOWHERE: Place = Place { distance_sq: f32::INFINITY, node: u32::MAX, child: 0, lane: 0 };

    fn number(&self, tree: &Bvh<'_>) -> Option<u32> {
        Some(tree.links(self.node)?.triangle(self.child).wrapping_add(self.lane as u32))
    }

    /// Takes the nearer triangle; of two equally near ones the lesser number.
    fn improve(&mut self, tree: &Bvh<'_>, other: Place) {
        if other.distance_sq < self.distance_sq
            || (other.distance_sq == self.distance_sq && other.number(tree) < self.number(tree))
        {
            *self = other;
        }
    }
}

/// The triangles near a point.
struct Survey<'p> {
    query: &'p PointQuery,
    margin: f32,
    /// The closest triangle.
    best: Place,
    /// The closest triangle with an area.
    solid: Place,
    /// The closest triangle with its front to the point, with its back, with an open facing.
    seen: [Place; 3],
    /// For each [`ViewedSide`] the least lower bound of its triangles, grid units.
    least: [f32; 4],
    /// Squared box bound of the nodes that were not opened.
    missed: f32,
}

impl Survey<'_> {
    /// Whether a triangle with an area may be the closest one.
    fn has_sides(&self) -> bool {
        if self.solid.distance_sq <= self.best.distance_sq {
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
        self.query.lower(
            self.least.into_iter().fold(distance, |least, x| if x < least { x } else { least }),
        )
    }

    /// A point on the way to a triangle, a sixteenth of the distance from the triangle, within the
    /// ball about this point that is proved empty.
    fn nearer(&self, tree: &Bvh<'_>, to: Place) -> Option<PointQuery> {
        let query = self.query;
        let leaf = tree.leaf(to.node, to.child)?;
        let place = query.p + (witness(query, &leaf, to.lane) - query.p) * 0.9375;
        let nearer = PointQuery::new(tree, query.units.point(place)).ok()?;
        let way = nearer.p - query.p;
        let empty = query.units.inward(self.lower());
        (way.dot(way) < empty * empty * (1.0 - 64.0 * U32)).then_some(nearer)
    }

    fn closest(
        &self,
        search: &Search<'_, '_>,
        point: [f32; 3],
    ) -> Result<ClosestPoint, QueryError> {
        let Survey { query, best, .. } = *self;
        let tree = search.tree;
        let ended = search.cut.unwrap_or(Ended::Exact);
        if best.node == u32::MAX {
            // No step was allowed, or the scratch memory was full: the box of the model.
            let none = Budget::EXACT.with_steps(0);
            let closest = closest_point(tree, point, &none, &mut [ScratchEntry::EMPTY])?;
            return Ok(ClosestPoint { ended, ..closest });
        }
        let distance = sqrt_approx(best.distance_sq);
        let mut lower = self.lower();
        if self.missed < f32::INFINITY {
            let missed = lower_of_box(query, self.missed);
            lower = if missed < lower { missed } else { lower };
        }
        let leaf = tree.leaf(best.node, best.child).ok_or(QueryError::Unchecked)?;
        let number = best.number(tree).ok_or(QueryError::Unchecked)?;
        Ok(ClosestPoint {
            distance: Interval::new(lower, query.upper(distance)),
            point: query.units.point(witness(query, &leaf, best.lane)),
            triangle: tree.source(number),
            work: search.work,
            ended,
        })
    }
}

/// Finds the closest triangle, and the facings of all that may be the closest.
struct Sides<'a, 't> {
    tree: &'a Bvh<'t>,
    query: &'a PointQuery,
    margin: f32,
    best: Place,
    solid: Place,
    seen: [Place; 3],
    limit: f32,
    least: [f32; 4],
}

impl LeafVisitor for Sides<'_, '_> {
    #[inline(always)]
    fn limit(&self) -> f32 {
        self.limit
    }

    #[inline(always)]
    fn leaf(&mut self, visit: &LeafVisit<'_>) -> Option<bool> {
        let near = nearest_triangle(&visit.leaf, self.query.p)?;
        if near.lower_bound_sq <= self.limit {
            self.look(visit);
        }
        Some(true)
    }
}

impl Sides<'_, '_> {
    #[inline(never)]
    fn look(&mut self, visit: &LeafVisit<'_>) {
        let (leaf, p) = (&visit.leaf, self.query.p);
        each_triangle(self.query, leaf, |lane, distance_sq, lower_bound_sq| {
            if lower_bound_sq > self.limit {
                return;
            }
            let here = Place { distance_sq, node: visit.node, child: visit.lane, lane };
            self.best.improve(self.tree, here);
            let facing = viewed_side(leaf, lane, p);
            if facing != ViewedSide::Flat && distance_sq <= self.solid.distance_sq {
                self.solid.improve(self.tree, here);
                let band = Candidates::new(self.query, self.margin, self.solid.distance_sq).band;
                let limit = limit_of(self.query, band);
                self.limit = if limit < self.limit { limit } else { self.limit };
            }
            if let Some(seen) = self.seen.get_mut(facing as usize) {
                seen.improve(self.tree, here);
            }
            let lower = lower_of(leaf, lane, p, distance_sq, lower_bound_sq);
            if let Some(least) = self.least.get_mut(facing as usize)
                && lower < *least
            {
                *least = lower;
            }
        });
    }
}
