//! One search of a coherent query. It updates the front as far as the answer depends on it.

use super::front::{BoundKind, Child, TraversalFront};
use super::planes::{Planes, VisitedLeaf, middle};
use super::sliver::has_no_sliver;
use crate::bvh::point::leaf::distance::nearest_and_edges;
use crate::bvh::point::query::{EVERY_KEY, PointQuery};
use crate::bvh::tree::descent::OpenedNode;
use crate::bvh::tree::format::{Bvh, FanLeaf};
use crate::bvh::tree::node::{CHILD_MASK, NO_CHILD, least_key};
use crate::geom::fan::{Nearness, PointFan, WIDTH, point_leaf};
use crate::num::tolerance::{ROOT_AND_PRODUCTS, SHORTFALL};
use crate::num::{lesser, sqrt_approx};
use crate::query::Work;
use glam::Vec3;

/// The nearest triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NearestInFront {
    pub(crate) distance_sq: f32,
    /// Its leaf.
    pub(crate) child: Child,
    /// Its place in the leaf, and the closest point on it.
    pub(crate) lane: usize,
    pub(crate) v: f32,
    pub(crate) w: f32,
    /// The leaf's place in the front.
    at: usize,
}

impl NearestInFront {
    const NONE: NearestInFront = NearestInFront {
        distance_sq: f32::INFINITY,
        child: Child::PLACEHOLDER,
        lane: 0,
        v: 0.0,
        w: 0.0,
        at: usize::MAX,
    };
}

/// Why a search on the front has no answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NoAnswer {
    /// A sliver decides the interval, or the steps are used up. The plain query answers, and the
    /// front is kept.
    Undecided,
    /// An entry that was dropped may hold the answer, or the search takes too long. The front
    /// begins anew.
    Lost,
    /// The tree is unchecked.
    Unchecked,
}

/// The cost of a search, in half leaves. It decides when plain queries take over. That changes no
/// distance, point or triangle of an exact answer, but the safe radius and the work.
mod cost {
    /// The triangles of a leaf.
    pub(super) const LEAF: u32 = 2;
    /// Whether a leaf has slivers.
    pub(super) const SHAPE: u32 = 1;
    /// The plane of a leaf.
    pub(super) const PLANE: u32 = 1;
    /// The boxes of a node, and their entries.
    pub(super) const NODE: u32 = 3;
    /// Entries that are read for a cost of 1 to activate some.
    pub(super) const ENTRIES_READ: u32 = 24;
    /// Entries that are read and moved for a cost of 1 to evict some.
    pub(super) const ENTRIES_MOVED: u32 = 12;
}

/// One search and its state.
pub(crate) struct Follow<'a, 't> {
    pub(crate) tree: &'a Bvh<'t>,
    pub(crate) query: &'a PointQuery,
    pub(crate) front: TraversalFront<'a>,
    planes: &'a mut Planes,
    /// From the model's middle to the query. Planes are measured from the middle.
    from_middle: Vec3,
    pub(crate) work: Work,
    /// Entries stay active while their key is at most this much above `bound`: a few steps.
    ahead: f32,
    best: NearestInFront,
    /// An entry with a greater key cannot hold the answer.
    bound: f32,
    /// The plain query refines a triangle with a smaller squared lower bound as a sliver.
    refine_below: f32,
    /// Least squared lower bound of the triangles that were below `refine_below` when visited.
    sliver_lower_sq: f32,
    /// Greatest error of a plane's bound.
    pub(crate) plane_error: f32,
    /// Greatest error of a triangle's bound, in addition to [`SHORTFALL`] of the bound itself.
    shortfall: f32,
    /// Work so far, in half leaves: see [`cost`].
    pub(crate) cost: u32,
    /// Nodes that may be opened.
    steps: u32,
}

impl<'a, 't> Follow<'a, 't> {
    #[inline(always)]
    pub(crate) fn new(
        tree: &'a Bvh<'t>,
        query: &'a PointQuery,
        front: TraversalFront<'a>,
        planes: &'a mut Planes,
        ahead: f32,
        steps: u32,
    ) -> Self {
        let plane_error = query.plane_error();
        let shortfall = tree.header().star_radius * SHORTFALL + query.rounding;
        Follow {
            tree,
            query,
            front,
            planes,
            from_middle: query.p - middle(tree),
            work: Work::default(),
            ahead,
            best: NearestInFront::NONE,
            bound: f32::INFINITY,
            refine_below: f32::NEG_INFINITY,
            sliver_lower_sq: f32::INFINITY,
            plane_error,
            shortfall,
            cost: 0,
            // Every node by the front, and again when it begins anew.
            steps: lesser(steps, tree.most_steps().saturating_mul(2)),
        }
    }

    /// The nearest triangle, searched from the root. An earlier answer proves that a triangle lies
    /// within `max_distance`.
    #[cold]
    #[inline(never)]
    pub(crate) fn begin(
        &mut self,
        max_distance: f32,
        budget: u32,
    ) -> Result<NearestInFront, NoAnswer> {
        self.front.clear();
        let max_distance = max_distance * (1.0 + 1.0 / 1024.0) + self.plane_error;
        let bound = self.horizon(max_distance * max_distance);
        self.bound = bound;
        self.open(0, None)?;
        let nearest = self.nearest(false, budget)?;
        // Children beyond the first bound were skipped. They do not matter if the answer is nearer.
        if self.bound <= bound { Ok(nearest) } else { Err(NoAnswer::Lost) }
    }

    /// The nearest triangle. With `first` the search begins with the leaf of the first entry. It is
    /// [`Lost`](NoAnswer::Lost) if the cost exceeds `budget`.
    #[cfg_attr(meshsweep_wide, inline(always))]
    #[cfg_attr(not(meshsweep_wide), inline(never))]
    pub(crate) fn nearest(&mut self, first: bool, budget: u32) -> Result<NearestInFront, NoAnswer> {
        let mut next = 0;
        if first && let Some((_, child)) = self.front.get(0) {
            self.look(0, child)?;
            next = 1;
        }
        loop {
            while next < self.front.state.active {
                let Some((key, child)) = self.front.get(next) else { break };
                if key <= self.bound {
                    self.visit(next, child)?;
                    if self.cost > budget {
                        return Err(NoAnswer::Lost);
                    }
                } else if key > self.bound + self.ahead {
                    self.front.deactivate(next, key);
                    continue;
                }
                next += 1;
            }
            if self.bound < self.front.state.rest || !self.front.has_inactive() {
                break;
            }
            let active = self.front.state.active;
            self.front.activate(self.bound + self.ahead);
            // Keys that are no numbers, of a tree that was not checked, would never end.
            if self.front.state.active == active {
                return Err(NoAnswer::Lost);
            }
            self.cost += self.front.state.count as u32 / cost::ENTRIES_READ;
        }
        if self.bound >= self.front.state.dropped || self.best.at == usize::MAX {
            return Err(NoAnswer::Lost);
        }
        if self.sliver_lower_sq < self.refine_below {
            return Err(NoAnswer::Undecided);
        }
        self.front.swap(0, self.best.at);
        Ok(self.best)
    }

    /// Updates entry `i` until its key is too great for it to hold the answer.
    #[cfg_attr(meshsweep_wide, inline(always))]
    #[cfg_attr(not(meshsweep_wide), inline(never))]
    fn visit(&mut self, i: usize, mut child: Child) -> Result<(), NoAnswer> {
        loop {
            match child.bound_kind() {
                BoundKind::Triangles => {
                    let key = self
                        .front
                        .key(self.planes.bound(child, self.from_middle) - self.plane_error);
                    if key > self.bound {
                        self.front.set(i, key, child);
                        return Ok(());
                    }
                    return self.look(i, child);
                }
                BoundKind::Sliver => {
                    let key = self.box_key(child)?;
                    self.front.set(i, key, child);
                    return if key <= self.bound { self.look(i, child) } else { Ok(()) };
                }
                BoundKind::Box => {}
            }
            let found = self.tree.child(child.node(), child.index()).ok_or(NoAnswer::Unchecked)?;
            if found.is_leaf() {
                let leaf = self.tree.leaf_at(found.at, found.shape).ok_or(NoAnswer::Unchecked)?;
                self.cost += cost::SHAPE;
                let kind = if has_no_sliver(&leaf).ok_or(NoAnswer::Unchecked)? {
                    BoundKind::Triangles
                } else {
                    BoundKind::Sliver
                };
                return self.look(i, child.with(kind));
            }
            self.open(found.at, Some(i))?;
            let Some((key, nearest)) = self.front.get(i) else { return Ok(()) };
            if key > self.bound {
                return Ok(());
            }
            child = nearest;
        }
    }

    /// Replaces an entry by the nearest child of its node and adds the others.
    #[cfg_attr(meshsweep_wide, inline(always))]
    #[cfg_attr(not(meshsweep_wide), inline(never))]
    fn open(&mut self, node: u32, entry: Option<usize>) -> Result<(), NoAnswer> {
        if self.work.opened >= self.steps {
            return Err(NoAnswer::Undecided);
        }
        let links = self.tree.links(node).ok_or(NoAnswer::Unchecked)?;
        let opened = OpenedNode { node, count: links.count, bound: 0, limit: EVERY_KEY };
        let mut keys = [NO_CHILD; WIDTH];
        self.query.keys_of(self.tree, &opened, &mut keys).ok_or(NoAnswer::Unchecked)?;
        self.work.opened += 1;
        self.work.bounds += links.count;
        self.cost += cost::NODE;
        let nearest = least_key(&keys);
        let horizon = self.bound + self.ahead;
        if !self.front.has_room(WIDTH) {
            self.front.evict(entry.map_or(0, |i| i + 1), horizon);
            self.cost += self.front.state.count as u32 / cost::ENTRIES_MOVED;
        }
        if let Some(i) = entry {
            let lane = nearest & CHILD_MASK;
            self.front.set(i, self.key_of_box(nearest), Child::new(node, lane));
        }
        for (lane, key) in (0..links.count).zip(keys) {
            if entry.is_none() || key != nearest {
                let key = self.key_of_box(key);
                self.front.insert(key, Child::new(node, lane), horizon);
            }
        }
        Ok(())
    }

    #[inline(always)]
    fn key_of_box(&self, key: u32) -> f32 {
        self.front.key(self.query.distance_of_key(key))
    }

    /// Key of a leaf by its box, for the present point.
    #[cold]
    fn box_key(&mut self, child: Child) -> Result<f32, NoAnswer> {
        let count = child.index() + 1;
        let opened = OpenedNode { node: child.node(), count, bound: 0, limit: EVERY_KEY };
        let mut keys = [NO_CHILD; WIDTH];
        self.query.keys_of(self.tree, &opened, &mut keys).ok_or(NoAnswer::Unchecked)?;
        self.work.bounds += count;
        let key = keys.get(child.index() as usize).copied().ok_or(NoAnswer::Unchecked)?;
        Ok(self.key_of_box(key))
    }

    /// Looks at the triangles of a leaf.
    #[cfg_attr(meshsweep_wide, inline(always))]
    #[cfg_attr(not(meshsweep_wide), inline(never))]
    fn look(&mut self, i: usize, child: Child) -> Result<(), NoAnswer> {
        let found = self.tree.child(child.node(), child.index()).ok_or(NoAnswer::Unchecked)?;
        let leaf = self.tree.leaf_at(found.at, found.shape).ok_or(NoAnswer::Unchecked)?;
        let (near, edges) = nearest_and_edges(&leaf, self.query).ok_or(NoAnswer::Unchecked)?;
        self.work.triangles += leaf.shape().triangles() as u32;
        self.cost += cost::LEAF;
        let distance_sq = near.distance_sq;
        if distance_sq < self.best.distance_sq
            || (distance_sq == self.best.distance_sq && self.comes_first(child))
        {
            let (lane, v, w) = near.lane();
            self.best = NearestInFront { distance_sq, child, lane, v, w, at: i };
            self.bound = self.horizon(distance_sq);
            self.refine_below = self.query.refine_below(distance_sq);
        }
        // The plain query refines slivers and may find them nearer.
        if near.lower_bound_sq < self.refine_below {
            self.sliver_lower_sq = lesser(self.sliver_lower_sq, near.lower_bound_sq);
        }
        if child.bound_kind() == BoundKind::Triangles {
            let key = self.key_of_triangles(near.lower_bound_sq);
            self.front.set(i, key, child);
            if key > self.bound {
                self.cost += cost::PLANE;
                let looked = VisitedLeaf { fans: &leaf, p: self.query.p, edges: edges.as_ref() };
                self.planes.put(
                    child,
                    &looked,
                    self.from_middle,
                    near.lane(),
                    self.shortfall + self.plane_error,
                );
            }
        } else if let Some((key, _)) = self.front.get(i) {
            self.front.set(i, key, child);
        }
        Ok(())
    }

    /// Ties go to the least number in the tree. The leaf that holds the best triangle counts as
    /// first.
    #[cold]
    fn comes_first(&self, child: Child) -> bool {
        let first = |child: Child| Some(self.tree.links(child.node())?.triangle(child.index()));
        first(child) <= first(self.best.child)
    }

    #[inline(always)]
    fn each(&mut self, leaf: &FanLeaf<'_>, mut then: impl FnMut(&mut Self, usize, Nearness)) {
        let (p, shape) = (self.query.p, leaf.shape());
        let centres = [0, shape.centres() - 1].map(|which| leaf.centre(which));
        point_leaf(
            shape.triangles(),
            shape.turn(),
            centres.map(|centre| p - centre),
            |i, which| match leaf.is_f32() {
                true => leaf.ring(i) - centres[which & 1],
                false => leaf.spoke(i, which),
            },
            |lane, near| then(self, lane, near),
        );
    }

    /// An entry with a greater key holds nothing at this squared distance or nearer.
    #[inline(always)]
    pub(crate) fn horizon(&self, distance_sq: f32) -> f32 {
        self.front.horizon(
            sqrt_approx(self.query.limit(distance_sq)) * (1.0 + ROOT_AND_PRODUCTS)
                + self.plane_error,
        )
    }

    /// Key of a leaf without slivers whose triangles have this least squared lower bound.
    #[inline(always)]
    fn key_of_triangles(&self, lower_bound_sq: f32) -> f32 {
        let lower = if lower_bound_sq > 0.0 { sqrt_approx(lower_bound_sq) } else { 0.0 };
        self.front.key(lower * (1.0 - SHORTFALL) - self.shortfall)
    }

    /// The least key of all triangles except the best. The best lies in the first entry; `others`
    /// is the least key of the other entries.
    #[cold]
    #[inline(never)]
    pub(crate) fn least_other_key(&mut self, best: &NearestInFront, others: f32) -> f32 {
        let Some(leaf) = self.tree.leaf(best.child.node(), best.child.index()) else { return 0.0 };
        let mut lower_bound_sq = f32::MAX;
        self.each(&leaf, |_, lane, near| {
            if lane != best.lane {
                lower_bound_sq = lesser(lower_bound_sq, near.lower_bound_sq);
            }
        });
        self.work.triangles += leaf.shape().triangles() as u32;
        lesser(others, self.key_of_triangles(lower_bound_sq))
    }

    /// The triangle `lane` of the first entry's leaf, if it is certainly still the nearest. All
    /// other triangles have keys of at least `others`.
    #[inline(always)]
    pub(crate) fn same(&mut self, lane: usize, others: f32) -> Option<NearestInFront> {
        let (_, child) = self.front.get(0)?;
        let leaf = self.tree.leaf(child.node(), child.index())?;
        let which = usize::from(lane >= leaf.shape().turn());
        let fan = PointFan::new(self.query.p - leaf.centre(which));
        let (e, g) = (fan.spoke(leaf.spoke(lane, which)), fan.spoke(leaf.spoke(lane + 1, which)));
        let Nearness { distance_sq, lower_bound_sq, v, w } = fan.triangle(&e, &g);
        self.work.triangles += 1;
        let certain = self.horizon(distance_sq) < others
            && lower_bound_sq >= self.query.refine_below(distance_sq);
        if certain { Some(NearestInFront { distance_sq, child, lane, v, w, at: 0 }) } else { None }
    }
}
