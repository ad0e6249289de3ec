//! [`CoherentQuery`]: the state of a moving query, and the rule that decides when its front pays.
//!
//! After Guéziec, *"Meshsweeper": From Closest Point to Hausdorff Distances Between Meshes* (2000),
//! sections 3.3 and 5.1.

use super::follow::{Follow, NearestInFront, NoAnswer};
use super::front::{BoundKind, Child, FrontState, TraversalFront};
use super::planes::Planes;
use crate::bvh::point::hint::Hint;
use crate::bvh::point::query::{Asked, PointQuery, PreparedPoint};
use crate::bvh::tree::format::Bvh;
use crate::bvh::tree::triangle_at::TriangleAt;
use crate::num::sqrt_approx;
use crate::num::tolerance::{LEAST_DENOMINATOR, LONG_PATH, ROOT_AND_PRODUCTS};
use crate::query::{Budget, ClosestPoint, Ended, Interval, QueryError, ScratchEntry, Work};
use core::marker::PhantomData;
use glam::Vec3;

/// The answer of a [`CoherentQuery`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct CoherentClosest {
    /// The answer of [`Bvh::closest_point`], with the same bits. `work` is that of this query.
    pub closest: ClosestPoint,
    /// Within this distance of the query, in input units, [`ClosestPoint::triangle`] stays the
    /// closest triangle of the input mesh. Rounded down. 0 if unknown: on edges, vertices and
    /// slivers, after a jump, far away, with a tolerance, and in a pause of the front.
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
/// On a Cortex-M4F a path takes half to four fifths of the instructions of
/// [`Bvh::closest_point_from`]. On x86-64 it takes as much time as with [`Bvh::closest_point`], 0.85
/// to 1.07 times (`core/docs/measured.md`). There `closest_point_from` of `meshsweep::bvh::FastBvh`,
/// which has AVX2, takes a tenth to a third less than a coherent query. Without an FPU the gain
/// depends on the mesh, and long triangles can make it a loss.
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
            children: [Child::PLACEHOLDER; N],
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
    /// Those of [`Bvh::closest_point`]. An argument that is refused leaves the state as it was.
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
const BASE_COST: u32 = 4;
/// Active entries that are read for a cost of 1.
const ENTRIES_READ: u32 = 8;
/// Plain queries that a search may cost: on a kept front, and one that begins with an empty front.
const MOST_COST: (u32, u32) = (2, 4);
/// Excess cost at which the front pauses, as a multiple of a plain query's cost. During a pause
/// plain queries answer.
const MOST_EXCESS: u32 = 4;
/// Plain queries in the first pause, and in the longest. Each pause is twice as long as the last.
const PAUSE: (u32, u32) = (8, 256);
/// A pause ends early after this many steps in a row that are much [`SHORTER`] than the step at
/// which it began.
const SHORT_STEPS: u32 = 3;
/// Ratio of two steps from which on the second counts as much shorter.
const SHORTER: f32 = 8.0;
/// After this many queries in a row without excess cost the next pause is as short as the first.
const RELIABLE: u32 = 64;

/// The rule that decides whether the front pays.
///
/// Cost is counted in half leaves: about 250 instructions without vectors, 30 ns with them. The
/// front's cost counts one and a half times. With vectors it takes that long, because each leaf
/// waits for the one before. The rule is the same on every target: it decides the safe radius, the
/// work and how a short search ends.
#[derive(Clone, Copy, Debug)]
struct FrontPolicy {
    /// Cost of a plain query here: a moving average. 0 before the first.
    plain_cost: u32,
    /// Sum of the front's cost beyond that of plain queries. Cheaper queries lower it, not below 0.
    excess: u32,
    /// Plain queries left in this pause.
    pause_left: u32,
    /// Plain queries of the next pause.
    next_pause: u32,
    /// Length of the step at which this pause began.
    pause_step: f32,
    /// Steps in a row since then that were much shorter.
    short_steps: u32,
    /// Queries from the front in a row without excess.
    without_excess: u32,
}

impl FrontPolicy {
    const EMPTY: FrontPolicy = FrontPolicy {
        plain_cost: 0,
        excess: 0,
        pause_left: 0,
        next_pause: PAUSE.0,
        pause_step: 0.0,
        short_steps: 0,
        without_excess: 0,
    };

    /// Whether to ask the front.
    #[inline(always)]
    fn uses_front(&mut self, step: f32) -> bool {
        if self.pause_left > 0 {
            let is_shorter = step * SHORTER < self.pause_step;
            self.short_steps = if is_shorter { self.short_steps + 1 } else { 0 };
            self.pause_left = if self.short_steps < SHORT_STEPS { self.pause_left - 1 } else { 0 };
            return false;
        }
        self.plain_cost > 0
    }

    /// Counts a query from the front.
    #[inline(always)]
    fn count_front_query(&mut self, cost: u32, step: f32) {
        let cost = cost + cost / 2;
        self.excess = (self.excess + cost).saturating_sub(self.plain_cost);
        self.without_excess = if self.excess == 0 { self.without_excess + 1 } else { 0 };
        if self.excess > MOST_EXCESS * self.plain_cost {
            (self.excess, self.without_excess) = (0, 0);
            (self.pause_step, self.short_steps) = (step, 0);
            self.pause_left = self.next_pause;
            self.next_pause = (2 * self.next_pause).min(PAUSE.1);
        } else if self.without_excess == RELIABLE {
            (self.next_pause, self.without_excess) = (PAUSE.0, 0);
        }
    }

    /// Counts a plain query: 4/3 for a node, 2/7 for a triangle.
    #[inline(always)]
    fn count_plain_query(&mut self, work: &Work) {
        let cost = BASE_COST + work.opened + work.opened / 3 + work.triangles * 2 / 7;
        let average = (3 * self.plain_cost + cost).div_ceil(4);
        self.plain_cost = if self.plain_cost == 0 { cost } else { average };
    }
}

/// The state of a coherent query, without the front's entries.
#[derive(Clone, Copy, Debug)]
struct Memory {
    /// The tree's identity.
    of: (usize, u32),
    state: FrontState,
    planes: Planes,
    last: Last,
    /// Leaf of the last plain query's answer.
    hint: Hint,
    policy: FrontPolicy,
}

/// The last answer.
#[derive(Clone, Copy, Debug)]
struct Last {
    /// The query, grid units.
    p: Vec3,
    /// Whether the front's first entry is the answer's leaf.
    is_first_entry: bool,
    /// The triangle's place in the leaf, and its number in the input file.
    lane: usize,
    child: Child,
    triangle: Option<u32>,
    /// Upper bound of the distance by the last plain query, grid units.
    plain_upper: f32,
    /// No other triangle has a lesser key. 0 if unknown.
    least_other_key: f32,
}

impl Memory {
    const EMPTY: Memory = Memory {
        of: (0, 0),
        state: FrontState::EMPTY,
        planes: Planes::EMPTY,
        last: Last {
            p: Vec3::ZERO,
            is_first_entry: false,
            lane: 0,
            child: Child::PLACEHOLDER,
            triangle: None,
            plain_upper: f32::INFINITY,
            least_other_key: 0.0,
        },
        hint: Hint::NONE,
        policy: FrontPolicy::EMPTY,
    };

    #[inline(never)]
    fn closest_point(
        &mut self,
        keys: &mut [f32],
        children: &mut [Child],
        tree: &Bvh<'_>,
        point: [f32; 3],
        budget: &Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<CoherentClosest, QueryError> {
        // In place: `?` would copy it.
        let prepared = PreparedPoint::prepare(tree, point, budget, scratch);
        let query = match prepared.as_ref().map(PreparedPoint::asked) {
            Ok(Asked::Near(query)) if budget.relative <= 0.0 && budget.absolute <= 0.0 => query,
            Ok(Asked::Near(_) | Asked::Far(_)) => {
                let closest = tree.closest_point(point, *budget, scratch)?;
                return Ok(CoherentClosest { closest, safe_radius: 0.0 });
            }
            Err(refused) => return Err(*refused),
        };
        let of = tree.identity();
        if self.of != of {
            *self = Memory { of, ..Memory::EMPTY };
        }
        let mut spent = Work::default();
        let d = query.p - self.last.p;
        let step = sqrt_approx(d.x * d.x + d.y * d.y + d.z * d.z) * (1.0 + ROOT_AND_PRODUCTS)
            + LEAST_DENOMINATOR;
        self.last.p = query.p;
        if self.policy.uses_front(step) {
            match self.follow(keys, children, tree, query, (step, budget.steps), &mut spent) {
                Ok(answer) => return Ok(answer),
                Err(NoAnswer::Unchecked) => return Err(QueryError::Unchecked),
                Err(NoAnswer::Undecided) => {}
                Err(NoAnswer::Lost) => self.state = FrontState::EMPTY,
            }
        } else {
            // The path was not counted, so the keys are no bounds any more.
            self.state = FrontState::EMPTY;
            (self.last.is_first_entry, self.last.least_other_key) = (false, 0.0);
        }
        let mut closest = tree.closest_point_in_order(point, &mut self.hint, *budget, scratch)?;
        self.policy.count_plain_query(&closest.work);
        self.last.plain_upper =
            query.units.inward(closest.distance.upper) + query.units.surface_error;
        closest.work.bounds = closest.work.bounds.saturating_add(spent.bounds);
        closest.work.triangles = closest.work.triangles.saturating_add(spent.triangles);
        closest.work.opened = closest.work.opened.saturating_add(spent.opened);
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
        let Memory { state, planes, last, policy, .. } = self;
        let fresh = state.count == 0;
        let mut front = TraversalFront { keys, children, state };
        front.advance(if fresh { 0.0 } else { step });
        let mut follow = Follow::new(tree, query, front, planes, AHEAD * step, steps);
        let path = follow.front.state.path;
        if path > follow.plane_error * LONG_PATH {
            last.least_other_key = if last.least_other_key > path {
                (last.least_other_key - path) * (1.0 - ROOT_AND_PRODUCTS)
            } else {
                0.0
            };
            follow.front.rebase();
        }
        let same = if last.least_other_key > follow.horizon(0.0) {
            follow.same(last.lane, last.least_other_key)
        } else {
            None
        };
        let nearest = match same {
            Some(nearest) => nearest,
            None => {
                let found = if fresh {
                    follow.begin(last.plain_upper + step, MOST_COST.1 * policy.plain_cost)
                } else {
                    follow.nearest(last.is_first_entry, MOST_COST.0 * policy.plain_cost)
                };
                let read = follow.front.state.active as u32 / ENTRIES_READ;
                policy.count_front_query(BASE_COST + read + follow.cost, step);
                *spent = follow.work;
                (last.is_first_entry, last.least_other_key) = (false, 0.0);
                let nearest = found?;
                last.is_first_entry = true;
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
        let error = query.fixed_error;
        let path = follow.front.state.path;
        let safe = |other_key: f32| {
            0.5 * ((other_key - path) * (1.0 - ROOT_AND_PRODUCTS)
                - distance * (1.0 + ROOT_AND_PRODUCTS))
                - error
        };
        if same.is_none() && nearest.child.bound_kind() == BoundKind::Triangles {
            let others = follow.front.least_other_key();
            if safe(others) > step {
                last.least_other_key = follow.least_other_key(&nearest, others);
            }
        }
        let safe_radius = safe(last.least_other_key);
        let leaf =
            tree.leaf(nearest.child.node(), nearest.child.index()).ok_or(NoAnswer::Unchecked)?;
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
fn number(tree: &Bvh<'_>, nearest: &NearestInFront) -> Option<u32> {
    TriangleAt::new(nearest.child.node(), nearest.child.index(), nearest.lane).source(tree)
}
