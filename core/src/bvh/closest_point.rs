//! Closest point on the box tree.

use super::descent::{Descent, LeafVisit, LeafVisitor, descend};
use super::leaf_distance::{Lanes, nearest_within};
use super::leaf_distance::{NearestOf, nearest_triangle};
use super::point_query::{PointQuery, at_least, at_most, bounds};
use super::triangle_bounds::{distance_of_box, nearness, refine_sliver, seen_from};
use crate::bvh::format::{Bvh, FanLeaf};
use crate::geom::fan::lower_bound;
use crate::num::sqrt_approx;
use crate::num::tolerance::{EVERYTHING_SQ, FAN_RELATIVE, U32};
use crate::query::{Budget, ClosestPoint, Ended, QueryError, ScratchEntry, Work};
use glam::Vec3;

/// Where an answer was found: the leaf to look at first for a query nearby. Any value is safe; a
/// bad one costs a leaf.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Hint(u32);

impl Hint {
    /// Nothing is known.
    pub const NONE: Hint = Hint(u32::MAX);
}

/// Closest point of the surface to `point` (input units, the mesh's frame), with an interval that
/// contains the distance to the input mesh.
///
/// `stack` is working memory; [`BvhHeader::stack_entries`](crate::bvh::format::BvhHeader) entries make
/// overflow impossible. With fewer the interval still holds, and [`Ended::Capacity`] says so.
/// Equidistant triangles: the least in blob order. All arithmetic is f32.
///
/// Cost: five to fifteen nodes and three to twelve leaves on scanned parts. The worst case is the
/// whole tree, at the centre of a sphere: where time is bounded, set [`Budget::steps`]. Farther than
/// a million model sizes the interval is that of the model's box.
///
/// # Errors
/// [`QueryError::NotFinite`], [`QueryError::Tolerance`], [`QueryError::NoQueue`];
/// [`QueryError::NotServed`] if the blob was not built for distances.
pub fn closest_point(
    tree: &Bvh<'_>,
    point: [f32; 3],
    stop: &Budget,
    stack: &mut [ScratchEntry],
) -> Result<ClosestPoint, QueryError> {
    closest_point_from(tree, point, stop, stack, &mut Hint::NONE.clone())
}

/// [`closest_point`], which looks at `hint`'s leaf first and leaves its own there. An exact answer
/// has the same bits whatever the hint.
///
/// # Errors
/// Those of [`closest_point`].
#[inline]
pub fn closest_point_from(
    tree: &Bvh<'_>,
    point: [f32; 3],
    stop: &Budget,
    stack: &mut [ScratchEntry],
    hint: &mut Hint,
) -> Result<ClosestPoint, QueryError> {
    stop.check()?;
    if stack.is_empty() {
        return Err(QueryError::NoQueue);
    }
    let query = PointQuery::new(tree, point)?;
    if query.far {
        return from_afar(tree, point, &query);
    }
    let mut work = Work::default();
    let mut visitor = Closest::new(tree, point, &query, stop);
    if *hint != Hint::NONE
        && let Some(leaf) = tree.leaf(hint.0 >> 3, hint.0 & 7)
    {
        visitor.bound_by(&leaf).ok_or(QueryError::Model)?;
    }
    let descent = descend(tree, query.p, stack, stop.steps, &mut visitor, &mut work)?;
    visitor.answer(descent, work, hint)
}

/// The best leaf so far.
#[derive(Clone, Copy)]
struct Best {
    distance_sq: f32,
    node: u32,
    child: u32,
    lanes: Lanes,
}

struct Closest<'a> {
    tree: &'a Bvh<'a>,
    /// As it was asked.
    point: [f32; 3],
    query: &'a PointQuery,
    stop: &'a Budget,
    /// Squared bound above which nothing matters.
    limit: f32,
    /// The same without the tolerance: no triangle beyond this square can improve the answer.
    beyond: f32,
    best: Best,
    /// Certified squares below this are weak.
    refine_below: f32,
    /// Least certified square of a triangle whose own distance says too little.
    certified: f32,
    tolerant: bool,
}

impl<'a> Closest<'a> {
    #[inline(always)]
    fn new(tree: &'a Bvh<'a>, point: [f32; 3], query: &'a PointQuery, stop: &'a Budget) -> Self {
        Closest {
            tree,
            point,
            query,
            stop,
            limit: EVERYTHING_SQ,
            beyond: EVERYTHING_SQ,
            best: Best { distance_sq: f32::MAX, node: u32::MAX, child: 0, lanes: Lanes::NONE },
            refine_below: f32::NEG_INFINITY,
            certified: f32::INFINITY,
            tolerant: stop.relative > 0.0 || stop.absolute > 0.0,
        }
    }

    /// Lowers the limit by a leaf that the descent will come to again.
    #[inline(always)]
    fn bound_by(&mut self, leaf: &FanLeaf<'_>) -> Option<()> {
        let near = nearest_triangle(leaf, self.query.p)?;
        self.beyond = self.query.limit(near.distance_sq);
        self.limit = self.beyond;
        // Farther leaves do not count, on whichever target they are told to be beyond the limit
        // before they are computed.
        self.best.distance_sq = near.distance_sq;
        self.refine_below = self.query.refine_below(near.distance_sq);
        Some(())
    }

    /// With a tolerance, what is not nearer by that much is not wanted.
    #[cold]
    fn tolerant_limit(&self, distance_sq: f32) -> f32 {
        let distance = sqrt_approx(distance_sq);
        let absolute = self.query.units.inward(self.stop.absolute);
        let wanted = (distance / (1.0 + self.stop.relative)).min(distance - absolute);
        if wanted > 0.0 { wanted * wanted } else { 0.0 }
    }

    #[inline(always)]
    fn improve(&mut self, near: &NearestOf, visit: &LeafVisit<'_>) {
        let distance_sq = near.distance_sq;
        let known = self.best.node != u32::MAX;
        if distance_sq == self.best.distance_sq && known && self.comes_later(visit) {
            return;
        }
        self.best = Best { distance_sq, node: visit.node, child: visit.lane, lanes: near.lanes };
        self.refine_below = self.query.refine_below(distance_sq);
        let beyond = self.query.limit(distance_sq);
        if beyond < self.beyond {
            self.beyond = beyond;
        }
        self.limit = if self.tolerant { self.tolerant_limit(distance_sq) } else { self.beyond };
    }

    /// Whether the leaf's triangles have greater numbers than the best one's.
    #[cold]
    fn comes_later(&self, visit: &LeafVisit<'_>) -> bool {
        let first = |node, child| Some(self.tree.links(node)?.triangle(child));
        first(visit.node, visit.lane) > first(self.best.node, self.best.child)
    }

    /// Triangles whose supporting plane is worse than the best distance by more than rounding:
    /// slivers, and points next to the surface. Each is looked at again. A triangle that is
    /// weak beside the final best is weak beside every one before it, so the order of visits does
    /// not decide what is found.
    #[cold]
    #[inline(never)]
    fn certify(&mut self, visit: &LeafVisit<'_>) {
        let query = self.query;
        let box_sq = square(distance_of_box(query, visit.key));
        for lane in 0..visit.leaf.tag().triangles() {
            let seen = seen_from(&visit.leaf, lane, query.p);
            let near = nearness(&seen);
            if near.lower_bound_sq >= self.refine_below {
                continue;
            }
            let better = refine_sliver(query, &seen, near);
            let (best_sq, lanes) = (self.best.distance_sq, &self.best.lanes);
            let here = visit.node == self.best.node && visit.lane == self.best.child;
            let first = !here || lane < lanes.at(best_sq).0;
            let nearer = better.distance_sq < best_sq || (better.distance_sq == best_sq && first);
            if better.distance_sq < near.distance_sq && nearer {
                let lanes = Lanes::one(lane, &better);
                let near = NearestOf {
                    distance_sq: better.distance_sq,
                    lower_bound_sq: near.lower_bound_sq,
                    lanes,
                };
                self.improve(&near, visit);
            }
            let [s, e, g] = seen;
            let lower = lower_bound(s, e, g);
            let lower_sq = square(lower);
            let lower_sq = if lower_sq > box_sq { lower_sq } else { box_sq };
            // Not less than what it counts for beside a farther best, where it is not weak.
            let lower_sq =
                if lower_sq > near.lower_bound_sq { lower_sq } else { near.lower_bound_sq };
            if lower_sq < self.certified {
                self.certified = lower_sq;
            }
        }
    }

    #[inline(always)]
    fn answer(
        &self,
        descent: Descent,
        work: Work,
        hint: &mut Hint,
    ) -> Result<ClosestPoint, QueryError> {
        let Best { distance_sq, node, child, lanes } = self.best;
        // What is not weak is certified to this part of the best square, and no more.
        let mut least_sq = match self.refine_below {
            below if below > 0.0 => below,
            // No leaf was looked at.
            f32::NEG_INFINITY => f32::MAX,
            _ => 0.0,
        };
        if self.certified < least_sq {
            least_sq = self.certified;
        }
        let mut ended = Ended::Exact;
        if let Descent::Truncated { least, steps } = descent {
            ended = if steps { Ended::Steps } else { Ended::Capacity };
            least_sq = least_sq.min(square(distance_of_box(self.query, least)));
        }
        if node == u32::MAX {
            let mut answer = from_afar(self.tree, self.point, self.query)?;
            answer.lower =
                answer.lower.max(self.query.lower(sqrt_approx(least_sq))).min(answer.upper);
            return Ok(ClosestPoint { work, ended, ..answer });
        }
        *hint = Hint(node << 3 | child);
        let distance = sqrt_approx(distance_sq);
        let mut least = sqrt_approx(least_sq);
        if self.tolerant {
            let absolute = self.query.units.inward(self.stop.absolute);
            let wanted = (distance / (1.0 + self.stop.relative)).min(distance - absolute).max(0.0);
            least = least.min(distance_of_box(self.query, wanted * wanted));
            ended = if ended == Ended::Exact { Ended::Tolerance } else { ended };
        }
        let (lane, v, w) = lanes.at(distance_sq);
        let first = self.tree.links(node).ok_or(QueryError::Model)?.triangle(child);
        let leaf = self.tree.leaf(node, child).ok_or(QueryError::Model)?;
        Ok(ClosestPoint {
            lower: self.query.lower(least),
            upper: self.query.upper(distance),
            point: self.query.units.point(leaf.point(lane, v, w)),
            triangle: self.tree.source(first.wrapping_add(lane as u32)),
            work,
            ended,
        })
    }
}

impl LeafVisitor for Closest<'_> {
    #[inline(always)]
    fn limit(&self) -> f32 {
        self.limit
    }

    #[inline(always)]
    fn leaf(&mut self, visit: &LeafVisit<'_>) -> Option<bool> {
        let near = nearest_within(&visit.leaf, self.query.p, self.beyond)?;
        if near.distance_sq <= self.best.distance_sq {
            self.improve(&near, visit);
        }
        if near.lower_bound_sq < self.refine_below {
            self.certify(visit);
        }
        Some(true)
    }
}

/// The interval of the model's box, and a point of the surface: from far enough away every point is
/// the closest, within a rounding of f32. In input units, scaled by a power of two so that no
/// square leaves f32's range.
#[cold]
#[inline(never)]
fn from_afar(
    tree: &Bvh<'_>,
    point: [f32; 3],
    query: &PointQuery,
) -> Result<ClosestPoint, QueryError> {
    let (low, high) = bounds(tree);
    let point = Vec3::from_array(point);
    let corners = [low, high].map(|corner| Vec3::from_array(query.units.point(corner)).abs());
    let size = point.abs().max(corners[0]).max(corners[1]).max_element();
    let (up, down) = match size {
        size if size > POWER_40 => (1.0 / POWER_70, POWER_70),
        size if size < 1.0 / POWER_40 => (POWER_70, 1.0 / POWER_70),
        _ => (1.0, 1.0),
    };
    let scaled = |x: f32| query.units.outward(x, up);
    let [low, high] =
        [low, high].map(|corner| Vec3::new(scaled(corner.x), scaled(corner.y), scaled(corner.z)));
    let p = point * up;
    let outside = (low - p).max(p - high).max(Vec3::ZERO);
    let farthest = (low - p).abs().max((p - high).abs());
    let (near, far) = (sqrt_approx(outside.dot(outside)), sqrt_approx(farthest.dot(farthest)));
    let margin = |distance: f32| distance * (2.0 * FAN_RELATIVE * U32) + scaled(query.margin());
    let mut node = 0;
    let (links, leaf) = loop {
        let links = tree.links(node).ok_or(QueryError::Model)?;
        let child = links.child(0);
        if child.is_leaf() {
            break (links, tree.patch(child.at, child.tag).ok_or(QueryError::Model)?);
        }
        node = child.at;
    };
    Ok(ClosestPoint {
        lower: at_least((near - margin(near)) * down),
        upper: at_most((far + margin(far)) * down),
        point: query.units.point(leaf.centre(0)),
        triangle: tree.source(links.triangle(0)),
        work: Work::default(),
        ended: Ended::Exact,
    })
}

fn square(x: f32) -> f32 {
    x * x
}

const POWER_40: f32 = (1u64 << 40) as f32;
const POWER_70: f32 = (1u128 << 70) as f32;
