//! Segments on the box tree: first hit, any hit, all hits.
//!
//! A segment visits two nodes and less than one leaf on scanned parts, so what is done once for
//! each segment decides. The fan kernels flag the triangles that may be met; only these are settled
//! one by one, with the interval of parameters in which the *input's* triangle can be met.

use super::descent::push_children;
use super::segment_query::SegmentQuery;
use crate::bvh::format::{Bvh, FanLeaf};
use crate::bvh::node::{LANE_MASK, WIDE, box_entries, nearest_lane};
use crate::geom::fan::{Crossing, FanRay, LANES_BELOW, WIDTH, ray_patch, ray_patch8};
use crate::query::{AllHits, Ended, Hit, QueryError, ScratchEntry, SegmentHit, Work, insert};

/// Which sides of triangles a segment meets: the front is where corners run counter-clockwise, in
/// the input's winding.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Facing {
    /// Both.
    #[default]
    Both,
    /// Fronts only: back faces are culled.
    Front,
    /// Backs only.
    Back,
}

/// Whether a segment meets the surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AnyHit {
    /// Proved: it meets the input mesh.
    Hit,
    /// Proved: no point of it lies on the input mesh (on a triangle of the wanted facing).
    Clear,
    /// It passes so near an edge or ends so near the surface that rounding and the blob's surface
    /// error leave it open, or the stack was too short.
    Unknown,
}

/// First common point of the closed segment `a b` (input units) and the surface.
///
/// Never a wrong "clear": if [`SegmentHit::is_clear`], no point of the segment lies on the input
/// mesh. With [`Ended::Exact`] and a hit the segment is proved to meet the input mesh, and the
/// first common parameter lies in `lower ..= upper`, whatever the grid did to the vertices. [`Ended::Level`]: it passes an outer edge of a fan, or ends, so near the surface that rounding and the surface error leave open whether it meets it. `hit` is the
/// first triangle of the *stored* surface that is met, in f32, without a gap along edges and at
/// vertices; it may be one that the input's surface only comes near, or missing with
/// [`Ended::Level`]. Equal parameters: the least triangle in blob order.
///
/// A segment in a triangle's plane hits, as computed, where it enters the triangle, one of zero
/// length or a triangle without area likewise; none of these is proved. `stack` as for
/// [`closest_point`](super::closest_point).
///
/// Cost: two nodes and half a leaf on scanned parts. A segment that runs along the surface visits
/// all boxes that it touches.
///
/// # Errors
/// [`QueryError::NotFinite`], [`QueryError::NoQueue`], [`QueryError::NotServed`];
/// [`QueryError::OutOfDomain`] if an end is farther than 2^38 grid units away, a million model
/// sizes or more unless the model lies as far from its own origin. Far starts are clipped without
/// loss.
#[inline]
pub fn first_hit(
    tree: &Bvh<'_>,
    a: [f32; 3],
    b: [f32; 3],
    facing: &Facing,
    stack: &mut [ScratchEntry],
) -> Result<SegmentHit, QueryError> {
    let mut work = Work::default();
    let Some(query) = begin(tree, a, b, stack)? else {
        return Ok(SegmentHit {
            lower: f32::INFINITY,
            upper: f32::INFINITY,
            hit: None,
            work,
            ended: Ended::Exact,
        });
    };
    let mut first = First {
        limit: query.ray.end(),
        lower: f32::INFINITY,
        best: Place { t: f32::INFINITY, node: 0, child: 0, lane: 0 },
        certain: false,
        tree,
    };
    let dropped = descend(tree, &query, *facing, stack, &mut first, &mut work)?;
    first.answer(&query, dropped, work)
}

/// Whether the closed segment `a b` (input units) meets the surface: ends at the first proof.
///
/// What [`first_hit`] says of its arguments, errors and degenerate cases holds here. Cost: less
/// than that of [`first_hit`].
///
/// # Errors
/// Those of [`first_hit`].
#[inline]
pub fn any_hit(
    tree: &Bvh<'_>,
    a: [f32; 3],
    b: [f32; 3],
    facing: &Facing,
    stack: &mut [ScratchEntry],
) -> Result<AnyHit, QueryError> {
    let Some(query) = begin(tree, a, b, stack)? else { return Ok(AnyHit::Clear) };
    let mut any = Any { end: query.ray.end(), open: false, certain: false };
    let dropped = descend(tree, &query, *facing, stack, &mut any, &mut Work::default())?;
    Ok(match (any.certain, any.open | dropped.is_finite()) {
        (true, _) => AnyHit::Hit,
        (_, true) => AnyHit::Unknown,
        _ => AnyHit::Clear,
    })
}

/// All common points of the closed segment `a b` (input units) and the stored surface, by rising
/// parameter, into `hits`.
///
/// Each triangle gives one hit at most, so that a segment through an edge or a vertex may give one
/// for each triangle there. What does not fit is counted in [`AllHits::dropped`]; the first ones
/// are kept. [`Ended::Exact`]: these are exactly the input's triangles that the segment meets, and
/// it meets them for certain; [`Ended::Level`]: of some triangles rounding or the surface error
/// leaves it open.
///
/// # Errors
/// Those of [`first_hit`].
pub fn all_hits(
    tree: &Bvh<'_>,
    a: [f32; 3],
    b: [f32; 3],
    facing: &Facing,
    hits: &mut [Hit],
    stack: &mut [ScratchEntry],
) -> Result<AllHits, QueryError> {
    let mut work = Work::default();
    let Some(query) = begin(tree, a, b, stack)? else {
        return Ok(AllHits { stored: 0, dropped: 0, work, ended: Ended::Exact });
    };
    let mut all =
        All { tree, query: &query, hits, stored: 0, dropped: 0, open: false, failed: false };
    let missed = descend(tree, &query, *facing, stack, &mut all, &mut work)?;
    if all.failed {
        return Err(QueryError::Model);
    }
    let ended = match (missed.is_finite(), all.open) {
        (true, _) => Ended::Capacity,
        (_, true) => Ended::Level,
        _ => Ended::Exact,
    };
    Ok(AllHits { stored: all.stored, dropped: all.dropped, work, ended })
}

/// What has to be so before a descent; `None` if the segment is far from the model.
#[inline(always)]
fn begin(
    tree: &Bvh<'_>,
    a: [f32; 3],
    b: [f32; 3],
    stack: &[ScratchEntry],
) -> Result<Option<SegmentQuery>, QueryError> {
    if !tree.serves_segments() {
        return Err(QueryError::NotServed);
    }
    if stack.is_empty() {
        return Err(QueryError::NoQueue);
    }
    SegmentQuery::new(tree, a, b)
}

/// A stored triangle that is met.
#[derive(Clone, Copy)]
struct Place {
    t: f32,
    node: u32,
    child: u32,
    lane: u32,
}

/// What a question does with triangles that may be met, in any order.
trait Collect {
    /// Nothing that begins later matters.
    fn limit(&self) -> f32;
    /// A triangle of the wanted facing.
    fn meet(&mut self, crossing: &Crossing, node: u32, child: u32, lane: u32);
    /// The input's surface is met, not later than this.
    fn certain(&mut self, upper: f32);
    /// Whether the question is answered.
    fn is_answered(&self) -> bool;
    /// Whether it matters that one of several open triangles is met for certain.
    const COVERS: bool;
}

struct First<'a> {
    tree: &'a Bvh<'a>,
    /// The input's surface is met no later, if `certain`; else the segment's end.
    limit: f32,
    /// It is not met earlier.
    lower: f32,
    best: Place,
    certain: bool,
}

impl First<'_> {
    #[cold]
    fn number(&self, place: &Place) -> Option<u32> {
        Some(self.tree.links(place.node)?.triangle(place.child).wrapping_add(place.lane))
    }

    #[inline(always)]
    fn answer(
        &self,
        query: &SegmentQuery,
        dropped: f32,
        work: Work,
    ) -> Result<SegmentHit, QueryError> {
        let missed = dropped <= self.limit;
        let lower = if missed && dropped < self.lower { dropped } else { self.lower };
        let ended = match (missed, self.certain || lower == f32::INFINITY) {
            (true, _) => Ended::Capacity,
            (_, true) => Ended::Exact,
            _ => Ended::Level,
        };
        let mut hit = None;
        if self.best.t < f32::INFINITY {
            let number = self.number(&self.best).ok_or(QueryError::Model)?;
            hit = Some(query.hit(self.best.t, self.tree.source(number)));
        }
        let upper = match (self.certain, hit) {
            (true, _) => query.upper(self.limit),
            (false, Some(_)) => 1.0,
            (false, None) => f32::INFINITY,
        };
        Ok(SegmentHit { lower: query.lower(lower), upper, hit, work, ended })
    }
}

impl Collect for First<'_> {
    #[inline(always)]
    fn limit(&self) -> f32 {
        self.limit
    }

    #[inline(always)]
    fn meet(&mut self, crossing: &Crossing, node: u32, child: u32, lane: u32) {
        if crossing.lower < self.lower {
            self.lower = crossing.lower;
        }
        if crossing.stored && crossing.t <= self.best.t {
            let place = Place { t: crossing.t, node, child, lane };
            if crossing.t < self.best.t || self.number(&place) < self.number(&self.best) {
                self.best = place;
            }
        }
    }

    #[inline(always)]
    fn certain(&mut self, upper: f32) {
        self.certain = true;
        if upper < self.limit {
            self.limit = upper;
        }
    }

    #[inline(always)]
    fn is_answered(&self) -> bool {
        false
    }

    const COVERS: bool = true;
}

struct Any {
    end: f32,
    open: bool,
    certain: bool,
}

impl Collect for Any {
    #[inline(always)]
    fn limit(&self) -> f32 {
        self.end
    }

    #[inline(always)]
    fn meet(&mut self, _: &Crossing, _: u32, _: u32, _: u32) {
        self.open = true;
    }

    #[inline(always)]
    fn certain(&mut self, _: f32) {
        self.certain = true;
    }

    #[inline(always)]
    fn is_answered(&self) -> bool {
        self.certain
    }

    const COVERS: bool = true;
}

struct All<'a> {
    tree: &'a Bvh<'a>,
    query: &'a SegmentQuery,
    hits: &'a mut [Hit],
    stored: usize,
    dropped: u32,
    open: bool,
    failed: bool,
}

impl Collect for All<'_> {
    fn limit(&self) -> f32 {
        self.query.ray.end()
    }

    fn meet(&mut self, crossing: &Crossing, node: u32, child: u32, lane: u32) {
        self.open |= !crossing.certain;
        if crossing.stored {
            let Some(links) = self.tree.links(node) else {
                self.failed = true;
                return;
            };
            let number = links.triangle(child).wrapping_add(lane);
            let hit = self.query.hit(crossing.t, self.tree.source(number));
            insert(self.hits, &mut self.stored, &mut self.dropped, hit);
        }
    }

    fn certain(&mut self, _: f32) {}

    fn is_answered(&self) -> bool {
        false
    }

    const COVERS: bool = false;
}

/// Triangles of a leaf that the line may meet.
#[inline(always)]
fn flagged(leaf: &FanLeaf<'_>, query: &SegmentQuery) -> Option<u32> {
    let tag = leaf.tag();
    if WIDE {
        let (first, used) = (LANES_BELOW.get(tag.turn())?, LANES_BELOW.get(tag.triangles())?);
        return Some(ray_patch8(&query.ray, &leaf.ring8(query.ray.axes())?, first, used));
    }
    if leaf.is_f32() {
        return Some(flagged_single(leaf, &query.ray));
    }
    let ray = &query.ray;
    let ring = leaf.grid_ring()?;
    let origin = ray.in_order(ring.origin);
    let shadow = |vertex: [i32; 3]| {
        let mut at = [0f32; 3];
        for (at, (x, origin)) in at.iter_mut().zip(vertex.into_iter().zip(origin)) {
            *at = x.wrapping_add(origin) as f32;
        }
        ray.shadow_in_order(at)
    };
    let centres = ring.centres.map(|centre| shadow(ray.in_order(centre)));
    let [x, y, z] = ray.in_order([ring.x, ring.y, ring.z]);
    let vertices = x.iter().zip(y).zip(z);
    let vertices =
        vertices.map(|((x, y), z)| [x, y, z].map(|pair| i32::from(u16::from_le_bytes(*pair))));
    Some(ray_patch(ray, tag.turn(), centres, vertices.map(shadow)))
}

#[inline(never)]
fn flagged_single(leaf: &FanLeaf<'_>, ray: &FanRay) -> u32 {
    let tag = leaf.tag();
    let centres = [0, tag.centres() - 1].map(|which| ray.shadow(leaf.centre(which)));
    ray_patch(ray, tag.turn(), centres, (0..=tag.triangles()).map(|i| ray.shadow(leaf.ring(i))))
}

/// Settles the flagged triangles of a leaf.
#[inline(never)]
fn settle<C: Collect>(
    leaf: &FanLeaf<'_>,
    query: &SegmentQuery,
    facing: Facing,
    flagged: u32,
    bound: f32,
    [node, child]: [u32; 2],
    collect: &mut C,
) {
    let tag = leaf.tag();
    let ray = &query.ray;
    let sign = match facing {
        Facing::Both => 0.0,
        Facing::Front => ray.front(),
        Facing::Back => -ray.front(),
    };
    let wanted = |second: bool| if second && tag.second_reversed() { -sign } else { sign };
    let mut is_met = false;
    let (mut open, mut upper) = ([0u32; 2], [0f32; 2]);
    let mut within = [true; 2];
    let mut left = flagged;
    while left != 0 {
        let lane = left.trailing_zeros();
        left &= left - 1;
        let second = lane as usize >= tag.turn();
        let fan = usize::from(second);
        let corners = [leaf.centre(fan), leaf.ring(lane as usize), leaf.ring(lane as usize + 1)];
        let found = ray.crossing(corners.map(|v| ray.shadow(v)), wanted(second));
        let Some(mut crossing) = found else { continue };
        // All of the leaf lies in its box; and so the answer does not depend on which leaves beyond
        // it were looked at.
        if crossing.lower < bound {
            crossing.lower = bound;
        }
        if crossing.t < bound {
            crossing.t = bound;
        }
        // Only in a tree whose boxes do not hold their triangles, which `open` cannot see: the
        // interval stays one.
        if crossing.upper < bound {
            crossing.upper = bound;
        }
        collect.meet(&crossing, node, child, lane);
        if crossing.certain {
            is_met = true;
            collect.certain(crossing.upper);
        } else {
            open[fan & 1] |= 1 << lane;
            within[fan & 1] &= crossing.within;
            if crossing.upper > upper[fan & 1] {
                upper[fan & 1] = crossing.upper;
            }
        }
    }
    if is_met || !C::COVERS {
        return;
    }
    for fan in 0..2 {
        if open[fan] != 0 && within[fan] {
            let (from, to) = if fan == 0 { (0, tag.turn()) } else { (tag.turn(), WIDTH) };
            let to = if to < tag.triangles() { to } else { tag.triangles() };
            let centre = ray.shadow(leaf.centre(fan));
            let turns = ray.cover(centre, |i| ray.shadow(leaf.ring(i)), open[fan], from, to);
            let met =
                turns.is_some_and(|turns| turns != 0 && turns as f32 * wanted(fan == 1) >= 0.0);
            if met {
                collect.certain(upper[fan]);
            }
        }
    }
}

/// Visits what the segment enters before the limit; gives the least parameter of what did not fit
/// the stack, infinity if all did.
#[inline(always)]
fn descend<C: Collect>(
    tree: &Bvh<'_>,
    query: &SegmentQuery,
    facing: Facing,
    stack: &mut [ScratchEntry],
    collect: &mut C,
    work: &mut Work,
) -> Result<f32, QueryError> {
    let mut waiting = 0usize;
    let mut dropped = f32::INFINITY;
    let mut node = 0u32;
    let mut bound = 0f32;
    loop {
        let links = tree.links(node).ok_or(QueryError::Model)?;
        let record = tree.boxes(node).ok_or(QueryError::NotServed)?;
        let limit = collect.limit();
        let keys = box_entries(record, &query.slabs, links.count, bound, limit);
        work.splits += 1;
        work.nodes += links.count;
        let nearest = nearest_lane(&keys);
        let mut found = nearest <= limit;
        if found {
            push_children(
                stack,
                &mut waiting,
                &mut dropped,
                node,
                &keys,
                links.count,
                nearest,
                limit,
            );
        }
        // The nearest child's links are at hand; what comes off the stack has to look its parent's
        // up.
        let mut child = links.child(nearest.to_bits() & LANE_MASK);
        let mut entry = ScratchEntry { key: nearest, node };
        loop {
            if found {
                bound = f32::from_bits(entry.key.to_bits() & !LANE_MASK);
                if !child.is_leaf() {
                    node = child.at;
                    break;
                }
                work.triangles += child.tag.triangles() as u32;
                let leaf = tree.patch(child.at, child.tag).ok_or(QueryError::Model)?;
                let lanes = flagged(&leaf, query).ok_or(QueryError::Model)?;
                if lanes != 0 {
                    let lane = entry.key.to_bits() & LANE_MASK;
                    settle(&leaf, query, facing, lanes, bound, [entry.node, lane], collect);
                    if collect.is_answered() {
                        return Ok(dropped);
                    }
                }
            }
            found = true;
            loop {
                let Some(top) = waiting.checked_sub(1) else { return Ok(dropped) };
                waiting = top;
                entry = stack.get(top).copied().ok_or(QueryError::Model)?;
                if entry.key <= collect.limit() {
                    break;
                }
            }
            child =
                tree.child(entry.node, entry.key.to_bits() & LANE_MASK).ok_or(QueryError::Model)?;
        }
    }
}
