//! The triangles near a point of which the side is asked: those that may be the closest, and for
//! each side that they show to the point the nearest one.

use super::descent::{Descent, LeafVisit, descend};
use super::point_query::PointQuery;
use super::pseudonormal::{Candidates, ViewedSide, viewed_side};
use super::side_search::Search;
use super::triangle_bounds::{limit_of, lower_of_box, witness};
use super::triangle_visitor::{LeafTriangle, Next, TriangleCollector, TriangleVisitor};
use crate::bvh::format::{Bvh, FanLeaf};
use crate::num::tolerance::{EMPTY_BALL, EVERYTHING_SQ};
use crate::num::{lesser, sqrt_approx};
use crate::query::{Budget, ClosestPoint, Ended, Interval, QueryError, ScratchEntry};
use glam::Vec3;

/// The way from a point to the nearer place where its side is searched again: a sixteenth of the
/// distance is left.
const WAY_TO_NEARER: f32 = 0.9375;

impl<'a, 't> Search<'a, 't> {
    /// A survey that knows all triangles with an area that may be the closest of these.
    pub(super) fn survey_with_area<'p>(
        &mut self,
        query: &'p PointQuery,
    ) -> Result<Survey<'p>, QueryError>
    where
        'a: 'p,
        't: 'p,
    {
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
    ) -> Result<Survey<'p>, QueryError>
    where
        'a: 'p,
        't: 'p,
    {
        let tree = self.tree;
        let collector = Survey {
            query,
            marked: tree.if_marked(),
            margin: query.rounding,
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

    pub(super) fn is_none(&self) -> bool {
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
pub(super) struct Survey<'p> {
    pub(super) query: &'p PointQuery,
    /// The tree, if some of its triangles are turned or sideless.
    marked: Option<&'p Bvh<'p>>,
    pub(super) margin: f32,
    bounding: Bounding,
    /// The least squared distance of a bounding triangle.
    bound_sq: f32,
    /// The [`Candidates::band`] of `bound_sq`: farther triangles are no candidates.
    band: f32,
    /// The closest triangle.
    pub(super) best: LeafTriangle,
    /// The closest triangle with an area.
    pub(super) with_area: LeafTriangle,
    /// The closest triangle with its front to the point, with its back, with an unclear side. The
    /// index is a [`ViewedSide`].
    pub(super) by_side: [LeafTriangle; 3],
    /// For each [`ViewedSide`] the least lower bound of its triangles, grid units.
    pub(super) least: [f32; 4],
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
    pub(super) fn has_sides(&self) -> bool {
        if self.with_area.distance_sq <= self.best.distance_sq {
            return true;
        }
        let band = Candidates::new(self.query, self.margin, self.best.distance_sq).band;
        let [front, back, unclear, _] = self.least;
        front <= band || back <= band || unclear <= band
    }

    /// Lower bound of the distance to the input mesh, input units, without the nodes that were not
    /// opened.
    pub(super) fn lower(&self) -> f32 {
        let distance = sqrt_approx(self.best.distance_sq);
        self.query.lower(self.least.iter().copied().fold(distance, lesser))
    }

    /// A point on the way to a triangle, a sixteenth of the distance from the triangle, within the
    /// ball about this point that is proved empty.
    pub(super) fn nearer(&self, tree: &Bvh<'_>, to: LeafTriangle) -> Option<PointQuery> {
        let query = self.query;
        let leaf = to.leaf(tree)?;
        let place = query.p + (witness(query, &leaf, to.lane as usize) - query.p) * WAY_TO_NEARER;
        let nearer = PointQuery::new(tree, query.units.point(place)).ok()?;
        let way = nearer.p - query.p;
        let empty = query.units.inward(self.lower());
        (way.dot(way) < empty * empty * (1.0 - EMPTY_BALL)).then_some(nearer)
    }

    pub(super) fn closest(
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
        let facing = match self.marked {
            Some(tree) => facing.told_by(tree, here.number),
            None => facing,
        };
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
