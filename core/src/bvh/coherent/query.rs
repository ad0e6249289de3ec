//! [`CoherentQuery`]: the state of a moving query, and the rule that decides when its front pays.
//!
//! After Guéziec, *"Meshsweeper": From Closest Point to Hausdorff Distances Between Meshes* (2000),
//! sections 3.3 and 5.1.

use super::follow::{Follow, Nearest, NoAnswer};
use super::front::{Child, Extent, Known, TraversalFront};
use super::planes::Planes;
use crate::bvh::closest_point::Hint;
use crate::bvh::format::Bvh;
use crate::bvh::point_query::PointQuery;
use crate::num::sqrt_approx;
use crate::num::tolerance::{FAN_DISTANCE, LEAST_DENOMINATOR, LONG_PATH, ROOT_AND_PRODUCTS, U32};
use crate::query::{Budget, ClosestPoint, Ended, Interval, QueryError, ScratchEntry, Work};
use core::marker::PhantomData;
use glam::Vec3;

/// The answer of a [`CoherentQuery`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct CoherentClosest {
    /// The answer of [`Bvh::closest_point`], with the same bits. `work` is that of this query.
    pub closest: ClosestPoint,
    /// Within this distance of the query, in input units, [`ClosestPoint::triangle`] stays the
    /// closest triangle of the input mesh. Rounded down. 0 if unknown: on edges and vertices, after
    /// a jump, and where it would be less than the last step.
    pub safe_radius: f32,
}

/// A query that moves. It remembers which parts of the mesh the last answers ruled out.
///
/// It keeps a *front*: up to `N` nodes and leaves that together hold the whole surface, each with a
/// lower bound of its distance. When the query has moved along a path, each bound less the length
/// of that path is still a lower bound. So a query visits only leaves that may have come near
/// enough. `N` = 128 is enough for steps of a thousandth of the model. RAM: 8·`N` bytes, and about
/// 800 bytes for 32 planes that separate the query from the leaves around it.
///
/// If steps are so long that the front does not pay, plain queries answer for a while.
///
/// The state belongs to one tree at a time. With another tree it starts anew. It borrows the blob's
/// bytes, so they cannot change between queries.
#[derive(Clone, Debug)]
pub struct CoherentQuery<'t, const N: usize = 128> {
    memory: Memory,
    keys: [f32; N],
    children: [Child; N],
    bytes: PhantomData<&'t [u8]>,
}

impl<const N: usize> Default for CoherentQuery<'_, N> {
    fn default() -> Self {
        Self::new()
    }
}

impl<'t, const N: usize> CoherentQuery<'t, N> {
    /// A query without memory of earlier answers. May initialise a `static`.
    pub const fn new() -> Self {
        CoherentQuery {
            memory: Memory::EMPTY,
            keys: [0.0; N],
            children: [Child::NONE; N],
            bytes: PhantomData,
        }
    }

    /// Forgets all earlier answers. No later answer changes.
    pub fn reset(&mut self) {
        self.memory = Memory::EMPTY;
    }

    /// [`Bvh::closest_point`] with the same bits in `distance`, `point` and `triangle`. The less
    /// the query moved, the less work it takes.
    ///
    /// With a tolerance in `budget`, the plain query answers. The steps bound the search on the
    /// front and, if that fails, the plain query after it: together at most twice as many nodes. So
    /// the answer may be exact where the plain query's is not.
    ///
    /// Cost: one triangle within [`CoherentClosest::safe_radius`] of the last answer. One to three
    /// leaves and sometimes a node for steps of 3e-4 of the model's diagonal. The plain query's for
    /// jumps.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Bvh, CoherentQuery, Scratch};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/groove.msw"));
    /// let (part, mut scratch) = (Bvh::open(bytes)?, Scratch::<64>::new());
    /// let mut tip = CoherentQuery::<128>::new();
    /// for step in 0..100 {
    ///     let point = [3.0, 0.01 * step as f32, 4.0];
    ///     let near = tip.closest_point(&part, point, Budget::EXACT, &mut scratch)?;
    ///     assert!(near.safe_radius >= 0.0);
    /// }
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`Bvh::closest_point`]. The state stays as it was.
    pub fn closest_point(
        &mut self,
        tree: &Bvh<'t>,
        point: [f32; 3],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<CoherentClosest, QueryError> {
        self.memory.closest_point(&mut self.keys, &mut self.children, tree, point, &budget, scratch)
    }
}

/// Entries stay active while their keys are within this many steps of the answer. So the inactive
/// ones are read about once in as many queries.
const AHEAD: f32 = 8.0;
/// Cost of a query in addition to its nodes and leaves.
const BASE: u32 = 4;
/// Debt at which the front rests, as a multiple of a plain query's cost. While it rests, plain
/// queries answer.
const CREDIT: u32 = 4;
/// Plain queries in the first rest, and in the longest.
const REST: (u32, u32) = (8, 256);
/// A rest ends early after this many steps in a row that are much [`SHORTER`] than the step at
/// which it began.
const WAKE: u32 = 3;
/// Ratio of two steps from which on the second counts as much shorter.
const SHORTER: f32 = 8.0;
/// After this many queries in a row without debt the next rest is a first one again.
const RELIABLE: u32 = 64;

/// The rule that decides whether the front pays.
///
/// Cost is counted in half leaves: about 250 instructions without vectors, 30 ns with them. The
/// front's cost counts one and a half times. With vectors it takes that long, because each step has
/// to wait for the leaf before it. The rule is the same on every target, so the answers are too.
#[derive(Clone, Copy, Debug)]
struct Pace {
    /// Cost of a plain query here. 0 before the first.
    plain: u32,
    /// Excess of the front's cost over that of plain queries, lately.
    debt: u32,
    /// Plain queries left in this rest.
    resting: u32,
    /// Plain queries of the next rest.
    rest: u32,
    /// Length of the step at which this rest began.
    too_long: f32,
    /// Steps in a row since then that were much shorter.
    short: u32,
    /// Queries from the front in a row without debt.
    good: u32,
}

impl Pace {
    const EMPTY: Pace =
        Pace { plain: 0, debt: 0, resting: 0, rest: REST.0, too_long: 0.0, short: 0, good: 0 };

    /// Whether to ask the front.
    #[inline(always)]
    fn follows(&mut self, step: f32) -> bool {
        if self.resting > 0 {
            self.short = if step * SHORTER < self.too_long { self.short + 1 } else { 0 };
            self.resting = if self.short < WAKE { self.resting - 1 } else { 0 };
            return false;
        }
        self.plain > 0
    }

    /// Counts a query from the front.
    #[inline(always)]
    fn spend(&mut self, cost: u32, step: f32) {
        let cost = cost + cost / 2;
        self.debt = (self.debt + cost).saturating_sub(self.plain);
        self.good = if self.debt == 0 { self.good + 1 } else { 0 };
        if self.debt > CREDIT * self.plain {
            (self.debt, self.good) = (0, 0);
            (self.too_long, self.short) = (step, 0);
            self.resting = self.rest;
            self.rest = (2 * self.rest).min(REST.1);
        } else if self.good == RELIABLE {
            (self.rest, self.good) = (REST.0, 0);
        }
    }

    /// Counts a plain query.
    #[inline(always)]
    fn plain_query(&mut self, work: &Work) {
        let cost = BASE + work.splits + work.splits / 3 + work.triangles * 2 / 7;
        self.plain = if self.plain == 0 { cost } else { (3 * self.plain + cost).div_ceil(4) };
    }
}

/// The state of a coherent query, without the front's entries.
#[derive(Clone, Copy, Debug)]
struct Memory {
    /// Address and number of the tree's nodes, which identify the tree.
    of: (usize, u32),
    extent: Extent,
    planes: Planes,
    last: Last,
    /// Leaf of the last plain query's answer.
    hint: Hint,
    pace: Pace,
}

/// The last answer.
#[derive(Clone, Copy, Debug)]
struct Last {
    /// The query, grid units.
    p: Vec3,
    /// Whether the front's first entry is the answer's leaf.
    known: bool,
    /// The triangle's place in the leaf, and its number in the input file.
    lane: usize,
    child: Child,
    triangle: Option<u32>,
    /// Upper bound of the distance by the last plain query, grid units.
    plain_upper: f32,
    /// No other triangle has a lesser key. 0 if unknown.
    second: f32,
}

impl Memory {
    const EMPTY: Memory = Memory {
        of: (0, 0),
        extent: Extent::EMPTY,
        planes: Planes::EMPTY,
        last: Last {
            p: Vec3::ZERO,
            known: false,
            lane: 0,
            child: Child::NONE,
            triangle: None,
            plain_upper: f32::INFINITY,
            second: 0.0,
        },
        hint: Hint::NONE,
        pace: Pace::EMPTY,
    };

    #[inline]
    fn closest_point(
        &mut self,
        keys: &mut [f32],
        children: &mut [Child],
        tree: &Bvh<'_>,
        point: [f32; 3],
        budget: &Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<CoherentClosest, QueryError> {
        let query = PointQuery::prepare(tree, point, budget, scratch)?;
        let first = tree.frame(0).ok_or(QueryError::Unchecked)?;
        if query.far || budget.relative > 0.0 || budget.absolute > 0.0 {
            let closest = tree.closest_point(point, *budget, scratch)?;
            return Ok(CoherentClosest { closest, safe_radius: 0.0 });
        }
        let of = (core::ptr::from_ref(first).addr(), tree.header().nodes);
        if self.of != of {
            *self = Memory { of, ..Memory::EMPTY };
        }
        let mut spent = Work::default();
        let d = query.p - self.last.p;
        let step = sqrt_approx(d.x * d.x + d.y * d.y + d.z * d.z) * (1.0 + ROOT_AND_PRODUCTS)
            + LEAST_DENOMINATOR;
        self.last.p = query.p;
        if self.pace.follows(step) {
            match self.follow(keys, children, tree, &query, (step, budget.steps), &mut spent) {
                Ok(answer) => return Ok(answer),
                Err(NoAnswer::Unchecked) => return Err(QueryError::Unchecked),
                Err(NoAnswer::Undecided) => {}
                Err(NoAnswer::Lost) => self.extent = Extent::EMPTY,
            }
        } else {
            // The path was not counted, so the keys are no bounds any more.
            self.extent = Extent::EMPTY;
            (self.last.known, self.last.second) = (false, 0.0);
        }
        let mut closest = tree.closest_point_from(point, &mut self.hint, *budget, scratch)?;
        self.pace.plain_query(&closest.work);
        self.last.plain_upper =
            query.units.inward(closest.distance.upper) + query.units.surface_error;
        closest.work.nodes = closest.work.nodes.saturating_add(spent.nodes);
        closest.work.triangles = closest.work.triangles.saturating_add(spent.triangles);
        closest.work.splits = closest.work.splits.saturating_add(spent.splits);
        Ok(CoherentClosest { closest, safe_radius: 0.0 })
    }

    /// The answer from the front.
    #[inline(always)]
    fn follow(
        &mut self,
        keys: &mut [f32],
        children: &mut [Child],
        tree: &Bvh<'_>,
        query: &PointQuery,
        (step, steps): (f32, u32),
        spent: &mut Work,
    ) -> Result<CoherentClosest, NoAnswer> {
        let Memory { extent, planes, last, pace, .. } = self;
        let fresh = extent.count == 0;
        let mut front = TraversalFront { keys, children, extent };
        front.advance(if fresh { 0.0 } else { step });
        let mut follow = Follow::new(tree, query, front, planes, AHEAD * step, steps);
        let path = follow.front.extent.path;
        if path > follow.box_error * LONG_PATH {
            last.second = if last.second > path {
                (last.second - path) * (1.0 - ROOT_AND_PRODUCTS)
            } else {
                0.0
            };
            follow.front.rebase();
        }
        let same = if last.second > follow.horizon(0.0) {
            follow.same(last.lane, last.second)
        } else {
            None
        };
        let nearest = match same {
            Some(nearest) => nearest,
            None => {
                let found = if fresh {
                    follow.begin(last.plain_upper + step, 4 * pace.plain)
                } else {
                    follow.nearest(last.known, 2 * pace.plain)
                };
                pace.spend(BASE + follow.front.extent.active as u32 / 8 + follow.cost, step);
                *spent = follow.work;
                (last.known, last.second) = (false, 0.0);
                let nearest = found?;
                last.known = true;
                if (last.child, last.lane) != (nearest.child, nearest.lane)
                    || last.triangle.is_none()
                {
                    (last.child, last.lane) = (nearest.child, nearest.lane);
                    last.triangle = number(tree, &nearest);
                }
                nearest
            }
        };
        let distance = sqrt_approx(nearest.distance_sq);
        let below = query.refine_below(nearest.distance_sq);
        let error = tree.header().star_radius * (FAN_DISTANCE * U32) + query.units.surface_error;
        let path = follow.front.extent.path;
        let safe = |second: f32| {
            0.5 * ((second - path) * (1.0 - ROOT_AND_PRODUCTS)
                - distance * (1.0 + ROOT_AND_PRODUCTS))
                - error
        };
        if same.is_none() && nearest.child.known() == Known::Triangles {
            let others = follow.front.second();
            if safe(others) > step {
                last.second = follow.second(&nearest, others);
            }
        }
        let safe_radius = safe(last.second);
        let leaf =
            tree.leaf(nearest.child.node(), nearest.child.lane()).ok_or(NoAnswer::Unchecked)?;
        let closest = ClosestPoint {
            distance: Interval::new(
                query.lower(sqrt_approx(if below > 0.0 { below } else { 0.0 })),
                query.upper(distance),
            ),
            point: query.units.point(leaf.point(nearest.lane, nearest.v, nearest.w)),
            triangle: last.triangle,
            work: follow.work,
            ended: Ended::Exact,
        };
        Ok(CoherentClosest { closest, safe_radius: query.units.lower(safe_radius) })
    }
}

/// The triangle's number in the input file.
fn number(tree: &Bvh<'_>, nearest: &Nearest) -> Option<u32> {
    let first = tree.links(nearest.child.node())?.triangle(nearest.child.lane());
    tree.source(first.wrapping_add(nearest.lane as u32))
}
