//! The triangles near a point of which the side is asked: those that may be the closest, and for
//! each side that they show to the point the nearest one.
//!
//! A descent bounds the distance, leaf by leaf, as that of a closest point does. Leaves with
//! triangles that may be the closest wait. When the descent is done, few of them are left, and only
//! of their triangles it is asked how they face the point.

use super::pseudonormal::band_of;
use super::search::SideSearch;
use super::viewed_side::{ViewedSide, viewed_side};
use crate::bvh::point::leaf::bounds::{limit_of, lower_of_box, witness};
use crate::bvh::point::leaf::nearest::{Lanes, LeafNearest};
use crate::bvh::point::leaf::squares::{LatestSquares, LeafSquares};
use crate::bvh::point::query::PointQuery;
use crate::bvh::point::triangle_visitor::{LeafTriangle, Next, TriangleCollector, TriangleVisitor};
use crate::bvh::tree::descent::{Descent, LeafVisit, descend};
use crate::bvh::tree::format::{Bvh, FanLeaf};
use crate::bvh::tree::triangle_at::TriangleAt;
use crate::num::tolerance::{EMPTY_BALL, EVERYTHING_SQ, U32};
use crate::num::{Real, lesser, sqrt_approx};
use crate::query::{Budget, ClosestPoint, Ended, Interval, ScratchEntry};
use glam::Vec3;

/// The offset from a point to the nearer place where its side is searched again: a sixteenth of the
/// distance is left.
const WAY_TO_NEARER: f32 = 0.9375;

/// Leaves that may wait. More are looked at when they are reached.
const WAITING: usize = 16;

impl<'a, 't> SideSearch<'a, 't> {
    /// Fills an empty survey: it knows all triangles with an area that may be the closest of these.
    pub(crate) fn survey_with_area(&mut self, survey: &mut Survey<'_>) -> Option<()> {
        self.survey(survey, Bounding::Any)?;
        let is_known = survey.with_area.distance_sq <= survey.best.distance_sq;
        if is_known || survey.best.is_none() || self.truncated.is_some() {
            return Some(());
        }
        self.survey(survey, Bounding::WithArea)
    }

    /// Fills a survey, unless bounded by triangles with an area the descent is truncated.
    fn survey(&mut self, into: &mut Survey<'_>, bounding: Bounding) -> Option<()> {
        let (tree, query) = (self.tree, into.query);
        // In a place of their own, for the collector is moved into its visitor.
        let mut waiting = heapless::Vec::new();
        let mut nearby = Nearby {
            by_side: [LeafTriangle::NONE; ViewedSide::COUNT],
            least_sq: [f32::INFINITY; ViewedSide::COUNT],
            least: [f32::INFINITY; ViewedSide::COUNT],
        };
        let collector = Collector {
            query,
            marked: tree.if_marked(),
            bounding,
            bound_sq: f32::INFINITY,
            nearest: (TriangleAt::NONE, Lanes::NONE),
            band: f32::INFINITY,
            sure_sq: f32::INFINITY,
            nearby: &mut nearby,
            latest: LeafTriangle::NONE,
            latest_side: ViewedSide::Flat,
            waiting: &mut waiting,
            squares: LatestSquares::NONE,
            waits: false,
        };
        let mut visitor = TriangleVisitor::new(tree, query, EVERYTHING_SQ, collector);
        let descent = descend(tree, query, self.steps, self.stack, &mut visitor, &mut self.work);
        let descent = descent.ok()?;
        visitor.collector.waits = false;
        while let Some(leaf) = visitor.collector.waiting.pop() {
            if !visitor.is_beyond(leaf.lower_bound_sq) {
                let WaitingLeaf { place, low, squares, .. } = leaf;
                let known = visitor.collector.squares.of(squares, low);
                visitor.visit_again(place, low, known)?;
            }
        }
        let (bound_sq, band) = (visitor.collector.bound_sq, visitor.collector.band);
        let (place, lanes) = visitor.collector.nearest;
        let Nearby { by_side, least_sq, mut least } = nearby;
        for (least, least_sq) in least.iter_mut().zip(least_sq) {
            if Real(least_sq) < Real(f32::INFINITY) {
                *least = lesser(Real(*least), Real(sqrt_approx(least_sq))).0;
            }
        }
        let mut missed = None;
        if let Descent::Truncated { least, ended } = descent {
            missed = Some(least);
            self.truncated = Some(ended);
            if bounding == Bounding::WithArea {
                return Some(());
            }
        }
        let [front, back, unclear, flat] = by_side;
        let mut with_area = front;
        with_area.improve(back);
        with_area.improve(unclear);
        let mut best = with_area;
        best.improve(flat);
        let by_side = [front, back, unclear];
        // A refined distance, or another triangle's, is not that of the kept point.
        let (lane, v, w) = lanes.at(bound_sq);
        let is_best = best.distance_sq == bound_sq && best.place == place.with_lane(lane);
        let weights = if is_best { Some((v, w)) } else { None };
        // One by one: a whole survey would be made elsewhere, and copied.
        (into.best, into.with_area, into.by_side) = (best, with_area, by_side);
        (into.bound, into.weights) = ((bound_sq, band), weights);
        (into.least, into.missed) = (least, missed);
        Some(())
    }
}

impl LeafTriangle {
    pub(crate) fn is_none(&self) -> bool {
        self.place == TriangleAt::NONE
    }

    /// Whether squares are the same, and the number is greater.
    #[inline(always)]
    fn ties_with(&self, other: &LeafTriangle) -> bool {
        let differ = |a: f32, b: f32| a.to_bits() ^ b.to_bits();
        let bits = differ(self.distance_sq, other.distance_sq)
            | differ(self.lower_bound_sq, other.lower_bound_sq);
        bits == 0 && self.place < other.place
    }

    /// Takes the nearer triangle; of two equally near ones the lesser number.
    #[cfg_attr(meshsweep_small, inline(never))]
    #[cfg_attr(not(meshsweep_small), inline(always))]
    fn improve(&mut self, other: LeafTriangle) {
        if other.is_before(self) {
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
pub(crate) struct Survey<'p> {
    pub(crate) query: &'p PointQuery,
    /// The least squared distance of a bounding triangle, and the band of candidates for it.
    bound: (f32, f32),
    /// The closest triangle.
    pub(crate) best: LeafTriangle,
    /// The closest point on it by its weights (see [`FanLeaf::point`]), if they are known.
    weights: Option<(f32, f32)>,
    /// The closest triangle with an area.
    pub(crate) with_area: LeafTriangle,
    /// The closest triangle with its front to the point, with its back, with an unclear side. The
    /// index is a [`ViewedSide`] other than `Flat`.
    pub(crate) by_side: [LeafTriangle; ViewedSide::COUNT - 1],
    /// For each [`ViewedSide`] the least lower bound of its triangles, grid units.
    pub(crate) least: [f32; ViewedSide::COUNT],
    /// Least key of the nodes that were not opened.
    missed: Option<u32>,
}

impl<'p> Survey<'p> {
    /// An empty one.
    #[cfg_attr(meshsweep_small, inline(never))]
    pub(crate) fn of(query: &'p PointQuery) -> Self {
        Survey {
            query,
            bound: (f32::INFINITY, f32::INFINITY),
            best: LeafTriangle::NONE,
            weights: None,
            with_area: LeafTriangle::NONE,
            by_side: [LeafTriangle::NONE; ViewedSide::COUNT - 1],
            least: [f32::INFINITY; ViewedSide::COUNT],
            missed: None,
        }
    }
}

impl Survey<'_> {
    /// The [`band_of`] a squared distance.
    pub(crate) fn band_of(&self, distance_sq: f32) -> f32 {
        let (bound_sq, band) = self.bound;
        if distance_sq == bound_sq { band } else { band_of(self.query, distance_sq) }
    }

    /// Whether a triangle with an area may be the closest one.
    pub(crate) fn has_sides(&self) -> bool {
        if self.with_area.distance_sq <= self.best.distance_sq {
            return true;
        }
        let band = self.band_of(self.best.distance_sq);
        let [front, back, unclear, _] = self.least;
        front <= band || back <= band || unclear <= band
    }

    /// Lower bound of the distance to the input mesh, input units, without the nodes that were not
    /// opened. `distance` is that of the closest triangle, grid units.
    fn lower(&self, distance: f32) -> f32 {
        let least = self.least.iter().fold(Real(distance), |least, &of| lesser(least, Real(of)));
        self.query.lower(least.0)
    }

    /// A place on the way to a triangle, a sixteenth of the distance from the triangle, within the
    /// ball about this point that is proved empty. Input units.
    pub(crate) fn nearer(&self, tree: &Bvh<'_>, to: LeafTriangle) -> Option<[f32; 3]> {
        let query = self.query;
        let leaf = to.place.leaf(tree);
        let leaf = leaf.as_ref()?;
        let place = query.p + (witness(query, leaf, to.place.lane()) - query.p) * WAY_TO_NEARER;
        let place = query.units.point(place);
        let offset = query.units.inward_point(place) - query.p;
        let empty = query.units.inward(self.lower(sqrt_approx(self.best.distance_sq)));
        (offset.dot(offset) < empty * empty * (1.0 - EMPTY_BALL)).then_some(place)
    }

    pub(crate) fn closest(
        &self,
        search: &SideSearch<'_, '_>,
        point: [f32; 3],
    ) -> Option<ClosestPoint> {
        let &Survey { query, best, .. } = self;
        let tree = search.tree;
        let ended = search.truncated.unwrap_or(Ended::Exact);
        if best.is_none() {
            // The point is far away, no step was allowed, or the scratch memory was full: the box
            // of the model.
            let none = Budget::EXACT.with_steps(0);
            let closest = tree.closest_point(point, none, &mut [ScratchEntry::EMPTY]);
            return closest.ok().map(|closest| ClosestPoint { ended, ..closest });
        }
        let distance = sqrt_approx(best.distance_sq);
        let mut lower = self.lower(distance);
        if let Some(missed) = self.missed {
            let missed = lower_of_box(query, missed);
            lower = lesser(lower, missed);
        }
        let leaf = best.place.leaf(tree);
        let leaf = leaf.as_ref()?;
        Some(ClosestPoint {
            distance: Interval::new(lower, query.upper(distance)),
            point: query.units.point(match self.weights {
                Some((v, w)) => leaf.point(best.place.lane(), v, w),
                None => witness(query, leaf, best.place.lane()),
            }),
            triangle: best.place.source(tree),
            work: search.work,
            ended,
        })
    }
}

/// A leaf with triangles that may be the closest.
struct WaitingLeaf {
    /// That of its first triangle.
    place: TriangleAt,
    /// [`LeafVisit::key`].
    key: u32,
    /// [`LeafNearest::low`].
    low: u32,
    /// [`LeafNearest::lower_bound_sq`].
    lower_bound_sq: f32,
    /// See [`LatestSquares::keep`].
    squares: usize,
}

/// What is told of triangles that may be the closest.
struct Nearby {
    /// For each [`ViewedSide`] the closest triangle.
    by_side: [LeafTriangle; ViewedSide::COUNT],
    /// For each [`ViewedSide`] the least squared lower bound of its triangles that need no further
    /// bound.
    least_sq: [f32; ViewedSide::COUNT],
    /// For each [`ViewedSide`] the least lower bound of its other triangles, grid units.
    least: [f32; ViewedSide::COUNT],
}

/// What a descent collects for a [`Survey`].
struct Collector<'p, 'w> {
    query: &'p PointQuery,
    /// The tree, if some of its triangles are turned or sideless.
    marked: Option<&'p Bvh<'p>>,
    bounding: Bounding,
    /// The least squared distance of a bounding triangle.
    bound_sq: f32,
    /// The leaf that `bound_sq` is from, and lanes that find the triangle there.
    nearest: (TriangleAt, Lanes),
    /// The [`band_of`] `bound_sq`: farther triangles are no candidates.
    band: f32,
    /// A squared lower bound up to this is that of a candidate, without a root.
    sure_sq: f32,
    /// Triangles that may be the closest.
    nearby: &'w mut Nearby,
    /// The latest triangle that was taken since the bound fell, if it is certified.
    latest: LeafTriangle,
    latest_side: ViewedSide,
    /// Leaves whose triangles are looked at when the descent is done.
    waiting: &'w mut heapless::Vec<WaitingLeaf, WAITING>,
    /// Squares of their triangles.
    squares: LatestSquares,
    /// Whether the leaf in hand waits.
    waits: bool,
}

impl Collector<'_, '_> {
    /// Takes the distance of a triangle that bounds the survey.
    #[inline(always)]
    fn bound(&mut self, distance_sq: f32, limit: &mut f32) {
        if Real(distance_sq) < Real(self.bound_sq) {
            self.bound_sq = distance_sq;
            self.latest = LeafTriangle::NONE;
            self.nearest.0 = TriangleAt::NONE;
            self.band = band_of(self.query, distance_sq);
            let band = Real(self.band);
            self.sure_sq = (band * band * Real(1.0 - 8.0 * U32)).0;
            *limit = lesser(Real(*limit), Real(limit_of(self.query, self.band))).0;
        }
    }

    /// Lets a leaf wait. Returns whether there is room.
    #[inline(always)]
    fn wait(
        &mut self,
        visit: &LeafVisit<'_>,
        near: &LeafNearest,
        known: &LeafSquares,
        limit: f32,
    ) -> bool {
        if self.waiting.is_full() {
            // By keys, which are the same on every target.
            let limit = self.query.key_limit(limit);
            self.waiting.retain(|leaf| leaf.key <= limit);
        }
        let place = visit.triangle(0);
        let &LeafNearest { mut low, lower_bound_sq, .. } = near;
        let squares = self.squares.keep(known, &mut low, limit);
        let key = visit.key;
        self.waiting.push(WaitingLeaf { place, key, low, lower_bound_sq, squares }).is_ok()
    }
}

impl TriangleCollector for Collector<'_, '_> {
    /// A distance that is not refined yet bounds as well. Slivers are refined at once, so that they
    /// bound too.
    ///
    /// A leaf whose nearest triangle is beyond the limit does not wait: on some targets its lower
    /// bounds are left out.
    #[inline(always)]
    fn nearest(
        &mut self,
        visit: &LeafVisit<'_>,
        (near, known): (&LeafNearest, &LeafSquares),
        limit: &mut f32,
    ) -> Option<Next> {
        self.waits = false;
        if self.bounding == Bounding::WithArea {
            return Some(Next::Triangles);
        }
        if Real(near.distance_sq) < Real(self.bound_sq) {
            self.bound(near.distance_sq, limit);
            self.nearest = (visit.triangle(0), near.lanes);
        }
        self.waits =
            Real(near.distance_sq) <= Real(*limit) && self.wait(visit, near, known, *limit);
        let refine_below = self.query.refine_below(self.bound_sq);
        let is_sliver = Real(near.lower_bound_sq) < Real(refine_below);
        Some(if self.waits && !is_sliver { Next::Leaf } else { Next::Triangles })
    }

    #[inline(always)]
    fn allowance(&self) -> f32 {
        match self.bounding {
            Bounding::Any => self.query.side_allowance(),
            Bounding::WithArea => f32::INFINITY,
        }
    }

    /// The side of the latest triangle, which had the same squares and a lesser number; or of any
    /// triangle, if those beyond the band.
    #[cfg(not(meshsweep_wide))]
    #[inline(always)]
    fn told_side(&self, leaf: &FanLeaf<'_>, lane: usize) -> Option<bool> {
        if self.marked.is_some() {
            return None;
        }
        self.latest_side.in_winding(leaf, lane)
    }

    #[inline(always)]
    fn take(
        &mut self,
        here: LeafTriangle,
        leaf: &FanLeaf<'_>,
        seen: Option<&[Vec3; 3]>,
        limit: &mut f32,
    ) {
        if self.waits {
            self.bound(here.distance_sq, limit);
            return;
        }
        // Neighbours often tie at a corner. All but the sides is then as of the one before.
        let is_tie = self.latest.ties_with(&here);
        // Roots rise with their squares: the least square has the least root.
        let (mut is_certified, mut lower) = (true, f32::INFINITY);
        if !is_tie {
            is_certified = here.is_certified();
            if !is_certified || Real(here.lower_bound_sq) > Real(self.sure_sq) {
                lower = here.lower(leaf, self.query);
                if Real(lower) > Real(self.band) {
                    return;
                }
            }
        }
        let side = viewed_side(self.query, leaf, here.place.lane(), seen);
        let side = match self.marked {
            Some(tree) => side.told_by(tree, here.place),
            None => side,
        };
        if is_tie && side == self.latest_side {
            return;
        }
        if side != ViewedSide::Flat || self.bounding == Bounding::Any {
            self.bound(here.distance_sq, limit);
        }
        let Nearby { by_side, least_sq, least } = &mut *self.nearby;
        if let Some(by_side) = by_side.get_mut(side as usize) {
            by_side.improve(here);
        }
        if is_certified {
            (self.latest, self.latest_side) = (here, side);
            if let Some(least_sq) = least_sq.get_mut(side as usize)
                && Real(here.lower_bound_sq) < Real(*least_sq)
            {
                *least_sq = here.lower_bound_sq;
            }
        } else if let Some(least) = least.get_mut(side as usize)
            && Real(lower) < Real(*least)
        {
            *least = lower;
        }
    }
}
