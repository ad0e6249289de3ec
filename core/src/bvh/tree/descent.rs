//! The descent of one tree from its root, for a point, a segment or a solid. Coherent queries,
//! overlap and culling do not use it, nor do exact closest points, first hits and any hit on vector
//! targets (`block_walk`).
//!
//! The nearest child is followed at once. The other children within the limit go on a stack in the
//! caller's memory, unsorted. Sorted children, or a heap, visit fewer nodes and take longer: they
//! cost mispredicted branches.
//!
//! With a limit of steps that may end the search, the order changes after the first leaf: the child
//! or entry with the least key comes next, so that each step raises the lower bound the most. This
//! order needs more memory, so it is taken only while [`Limit::has_room`].
//!
//! Keys never fall from parent to child. So the leaves that can change an answer are the same in
//! every order of visits.

#[cfg(not(meshsweep_wide))]
mod boards;

use super::format::{Bvh, BvhChild, FanLeaf};
pub(crate) use super::node::OpenedNode;
#[cfg(not(meshsweep_wide))]
use super::node::Pushed;
use super::node::{CHILD_MASK, NO_CHILD};
#[cfg(meshsweep_wide)]
use super::node::{least_key, places_of_wanted};
use super::triangle_at::TriangleAt;
use crate::geom::fan::WIDTH;
use crate::num::lesser;
use crate::query::{Ended, QueryError, ScratchEntry, Work};
use core::mem::swap;

/// A point, a segment or a solid that is prepared for the descent.
///
/// It sets the unit of all keys, bounds and limits. For a point they are squared distances in
/// [key units](super::node::KeyPoint), for a segment the bits of its parameters, for a solid the
/// bits of its squared distances or times.
pub(crate) trait NodeQuery {
    /// Refuses a tree without the boxes that the query needs.
    fn check_served(tree: &Bvh<'_>) -> Result<(), QueryError>;

    /// Keys of the children of a node: lower bounds, not below its bound, with the number of the
    /// child in the low bits. Children beyond the limit may have any greater key. `None` says that
    /// the tree is unchecked.
    fn keys(&self, tree: &Bvh<'_>, opened: &OpenedNode, keys: &mut [u32; WIDTH]) -> Option<()>;

    /// Writes the children with keys up to the limit, except the nearest, to `slots`. A query that
    /// knows them without the keys of the others does so itself.
    #[cfg(not(meshsweep_wide))]
    #[inline(always)]
    fn push(
        &self,
        tree: &Bvh<'_>,
        opened: &OpenedNode,
        slots: &mut [ScratchEntry; WIDTH],
    ) -> Option<Pushed> {
        let mut keys = [NO_CHILD; WIDTH];
        self.keys(tree, opened, &mut keys)?;
        Some(opened.push_by_keys(&keys, slots))
    }
}

/// A leaf that a descent has reached.
pub(crate) struct LeafVisit<'a> {
    pub(crate) leaf: FanLeaf<'a>,
    /// Lower bound of all its triangles, in the unit of [`NodeQuery`].
    pub(crate) key: u32,
    /// The leaf's parent.
    pub(crate) node: u32,
    /// Number of the leaf among the children of `node`.
    pub(crate) child: u32,
}

impl LeafVisit<'_> {
    /// The place of a triangle of the leaf.
    #[inline(always)]
    pub(crate) fn triangle(&self, lane: usize) -> TriangleAt {
        TriangleAt::new(self.node, self.child, lane)
    }
}

/// A question's visitor for leaves.
pub(crate) trait LeafVisitor {
    /// Nothing with a greater key can change the answer. The unit is that of [`NodeQuery`].
    fn limit(&self) -> u32;

    /// Looks at a leaf. `Some(false)` ends the descent. `None` says that the tree is unchecked.
    fn leaf(&mut self, visit: &LeafVisit<'_>) -> Option<bool>;
}

/// How a descent ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Descent {
    /// Nothing within the limit is left.
    Done,
    /// The question was answered early.
    Answered,
    /// The steps were used up, or the stack was too short. Nothing with a key below `least` was
    /// missed.
    Truncated { least: u32, ended: Ended },
}

impl Descent {
    /// Why it missed leaves, if it did.
    #[inline(always)]
    pub(crate) fn cut(self) -> Option<Ended> {
        match self {
            Descent::Truncated { ended, .. } => Some(ended),
            _ => None,
        }
    }

    /// Why a search with an interval ended.
    #[inline(always)]
    pub(crate) fn ended(self) -> Ended {
        match self {
            Descent::Truncated { ended, .. } => ended,
            _ => Ended::Exact,
        }
    }
}

/// Above every key, and the bits of an infinite parameter.
const NOTHING: u32 = f32::INFINITY.to_bits();

/// The caller's memory as a stack.
struct Stack<'a> {
    entries: &'a mut [ScratchEntry],
    /// Entries in use.
    used: usize,
    /// Least key of the entries that did not fit.
    dropped: u32,
}

#[cfg(meshsweep_wide)]
impl Stack<'_> {
    /// Pushes the children of `node` within the limit, except the nearest. The nearest one's key.
    #[inline(always)]
    fn push_children(&mut self, node: u32, keys: &[u32; WIDTH], count: u32, limit: u32) -> u32 {
        let nearest = least_key(keys);
        if nearest > limit {
            return nearest;
        }
        let free = self.entries.get_mut(self.used..);
        let Some(slots) = free.and_then(|free| free.first_chunk_mut::<WIDTH>()) else {
            self.push_few(node, keys, count, [nearest, limit]);
            return nearest;
        };
        self.used += put_wanted(slots, node, keys, [nearest, limit]);
        nearest
    }

    /// The same, where not all children may fit.
    #[cold]
    #[inline(never)]
    fn push_few(&mut self, node: u32, keys: &[u32; WIDTH], count: u32, [nearest, limit]: [u32; 2]) {
        for &key in keys.iter().take(count as usize) {
            if key <= limit && key != nearest {
                match self.entries.get_mut(self.used) {
                    Some(slot) => {
                        *slot = ScratchEntry::of_words([key, node]);
                        self.used += 1;
                    }
                    None => self.dropped = lesser(self.dropped, key),
                }
            }
        }
    }
}

impl Stack<'_> {
    /// Least key of everything that is left, or that did not fit.
    #[cold]
    fn least(&self) -> u32 {
        let left = self.entries.iter().take(self.used);
        left.fold(self.dropped, |least, entry| least.min(entry.key_bits()))
    }
}

/// Writes the children with keys up to `limit`, except `nearest`, and tells how many they are.
#[cfg(meshsweep_wide)]
#[inline(always)]
fn put_wanted(
    slots: &mut [ScratchEntry; WIDTH],
    node: u32,
    keys: &[u32; WIDTH],
    [nearest, limit]: [u32; 2],
) -> usize {
    let (places, wanted) = places_of_wanted(keys, nearest, limit);
    for (child, &key) in keys.iter().enumerate() {
        // Without a branch: an unwanted entry is overwritten by the next one.
        let place = (places >> (8 * child)) as usize & (WIDTH - 1);
        slots[place] = ScratchEntry::of_words([key, node]);
    }
    wanted
}

/// How many nodes a descent opens at most.
struct Limit {
    /// Count of [`Work`] at which it ends.
    steps: u32,
    /// Whether it can end a search before the tree is exhausted.
    is_short: bool,
    /// Entries that no descent in depth-first order outgrows.
    entries: usize,
}

impl Limit {
    /// Whether the entry of the least key may be taken in place of the stack's top, and the memory
    /// still suffices. There are two reasons why it does.
    ///
    /// The free entries hold a whole search. The search below the taken entry needs no more. While
    /// it runs, fewer are free, so no second exchange happens before that search ends. Or the steps
    /// that are left cannot fill the free entries: each step adds fewer than [`WIDTH`].
    #[cfg_attr(meshsweep_small, inline(never))]
    fn has_room(&self, stack: &Stack<'_>, work: &Work) -> bool {
        let free = stack.entries.len().saturating_sub(stack.used);
        let left = self.steps.saturating_sub(work.opened) as usize;
        free >= self.entries || free >= left.saturating_mul(WIDTH)
    }

    /// Pushes the nearest child, for another entry may have a lesser key. False if there is no
    /// room for that.
    #[cold]
    #[inline(never)]
    fn push_nearest(&self, stack: &mut Stack<'_>, work: &Work, nearest: ScratchEntry) -> bool {
        if !self.has_room(stack, work) {
            return false;
        }
        let Some(slot) = stack.entries.get_mut(stack.used) else { return false };
        *slot = nearest;
        stack.used += 1;
        true
    }

    /// Exchanges the popped `entry` with the entry of the least key, if there is room for that.
    /// True if nothing on the stack has a lesser key.
    #[cold]
    #[inline(never)]
    fn take_least(&self, stack: &mut Stack<'_>, work: &Work, entry: &mut ScratchEntry) -> bool {
        if !self.has_room(stack, work) {
            return false;
        }
        let waiting = stack.entries.iter_mut().take(stack.used);
        if let Some(least) = waiting.min_by_key(|waiting| waiting.key_bits())
            && least.key_bits() < entry.key_bits()
        {
            swap(least, entry);
        }
        true
    }
}

/// Visits every leaf within the visitor's limit. Opens nodes until `work` counts `steps` of them,
/// earlier descents included.
#[inline(always)]
pub(crate) fn descend(
    tree: &Bvh<'_>,
    query: &impl NodeQuery,
    steps: u32,
    scratch: &mut [ScratchEntry],
    visitor: &mut impl LeafVisitor,
    work: &mut Work,
) -> Result<Descent, QueryError> {
    walk::<_, _, false>(tree, query, steps, scratch, visitor, work)
}

/// [`descend`] without a call for each leaf: on boards faster, and more code. Where code is to be
/// small, the same.
#[inline(always)]
pub(crate) fn descend_inlined(
    tree: &Bvh<'_>,
    query: &impl NodeQuery,
    steps: u32,
    scratch: &mut [ScratchEntry],
    visitor: &mut impl LeafVisitor,
    work: &mut Work,
) -> Result<Descent, QueryError> {
    walk::<_, _, { cfg!(not(meshsweep_small)) }>(tree, query, steps, scratch, visitor, work)
}

#[inline(always)]
fn walk<Q: NodeQuery, V: LeafVisitor, const INLINED: bool>(
    tree: &Bvh<'_>,
    query: &Q,
    steps: u32,
    scratch: &mut [ScratchEntry],
    visitor: &mut V,
    work: &mut Work,
) -> Result<Descent, QueryError> {
    let mut walk = Walk::new(tree, steps, scratch, work);
    let mut visit = LeafVisit { leaf: FanLeaf::NONE, key: 0, node: 0, child: 0 };
    loop {
        let limit = visitor.limit();
        let found = if INLINED {
            walk.next_leaf_inlined(tree, query, limit, work, &mut visit)
        } else {
            walk.next_leaf(tree, query, limit, work, &mut visit)
        };
        if !found.ok_or(QueryError::Unchecked)? {
            return Ok(walk.ended);
        }
        if !visitor.leaf(&visit).ok_or(QueryError::Unchecked)? {
            return Ok(Descent::Answered);
        }
    }
}

/// A descent between two leaves.
struct Walk<'a> {
    limit: Limit,
    stack: Stack<'a>,
    /// Whether the root was opened.
    has_begun: bool,
    /// Whether the least key comes next.
    least_first: bool,
    /// How the descent ended. No meaning while there is a further leaf.
    ended: Descent,
}

/// A node or leaf, with its entry.
type Place = (ScratchEntry, BvhChild);

#[inline(always)]
fn child_of(tree: &Bvh<'_>, entry: ScratchEntry) -> Option<BvhChild> {
    tree.child(entry.node(), entry.key_bits() & CHILD_MASK)
}

impl<'s> Walk<'s> {
    #[cfg_attr(meshsweep_small, inline(never))]
    #[cfg_attr(not(meshsweep_small), inline(always))]
    fn new(tree: &Bvh<'_>, steps: u32, scratch: &'s mut [ScratchEntry], work: &Work) -> Self {
        let all = work.opened.saturating_add(tree.most_steps());
        Walk {
            limit: Limit {
                steps: lesser(steps, all),
                is_short: steps < all,
                entries: tree.scratch_entries(),
            },
            stack: Stack { entries: scratch, used: 0, dropped: NOTHING },
            has_begun: false,
            least_first: false,
            ended: Descent::Answered,
        }
    }

    /// Goes on to the next leaf with a key up to `most`, and writes that leaf to `visit`. Returns
    /// whether there is one. `None` says that the tree is unchecked: the loop carries no other
    /// error.
    ///
    /// On boards it is a call, and all questions about a point share it.
    #[cfg_attr(meshsweep_wide, inline(always))]
    #[cfg_attr(not(meshsweep_wide), inline(never))]
    fn next_leaf<'t, Q: NodeQuery>(
        &mut self,
        tree: &Bvh<'t>,
        query: &Q,
        most: u32,
        work: &mut Work,
        visit: &mut LeafVisit<'t>,
    ) -> Option<bool> {
        self.next_leaf_inlined(tree, query, most, work, visit)
    }

    #[inline(always)]
    fn next_leaf_inlined<'t, Q: NodeQuery>(
        &mut self,
        tree: &Bvh<'t>,
        query: &Q,
        most: u32,
        work: &mut Work,
        visit: &mut LeafVisit<'t>,
    ) -> Option<bool> {
        let (mut node, mut bound) = (0, 0);
        let mut opens = !self.has_begun;
        self.has_begun = true;
        loop {
            let mut place = None;
            if opens {
                if work.opened >= self.limit.steps {
                    self.out_of_steps(bound);
                    return Some(false);
                }
                place = self.open(tree, query, [node, bound, most], work)?;
            }
            let (entry, child) = match place {
                Some(nearest) => nearest,
                None => match self.pop(tree, most, work)? {
                    Some(waiting) => waiting,
                    None => {
                        self.ended = self.end(most);
                        return Some(false);
                    }
                },
            };
            bound = entry.key_bits() & !CHILD_MASK;
            if child.is_leaf() {
                let leaf = tree.leaf_at(child.at, child.shape)?;
                work.triangles += child.shape.triangles() as u32;
                self.least_first = self.limit.is_short;
                let child = entry.key_bits() & CHILD_MASK;
                *visit = LeafVisit { leaf, key: bound, node: entry.node(), child };
                return Some(true);
            }
            node = child.at;
            opens = true;
        }
    }

    /// Opens a node: pushes its children, but for the nearest one, which comes next. `Some(None)`
    /// says that an entry of the stack comes next.
    #[inline(always)]
    fn open(
        &mut self,
        tree: &Bvh<'_>,
        query: &impl NodeQuery,
        [node, bound, limit]: [u32; 3],
        work: &mut Work,
    ) -> Option<Option<Place>> {
        let links = tree.links(node)?;
        let opened = OpenedNode { node, count: links.count, bound, limit };
        #[cfg(meshsweep_wide)]
        let nearest = {
            let mut keys = [NO_CHILD; WIDTH];
            query.keys(tree, &opened, &mut keys)?;
            self.stack.push_children(node, &keys, links.count, limit)
        };
        #[cfg(not(meshsweep_wide))]
        let nearest = self.stack.push_children(query, tree, &opened)?;
        work.opened += 1;
        work.bounds += links.count;
        if nearest > limit {
            return Some(None);
        }
        let entry = ScratchEntry::of_words([nearest, node]);
        if self.least_first && self.limit.push_nearest(&mut self.stack, work, entry) {
            return Some(None);
        }
        // The links are read already. For an entry from the stack they are read again.
        Some(Some((entry, links.child(nearest & CHILD_MASK))))
    }

    /// Takes an entry with a key up to `most` from the stack. `Some(None)`: there is none.
    #[cfg_attr(meshsweep_small, inline(never))]
    #[cfg_attr(not(meshsweep_small), inline(always))]
    fn pop(&mut self, tree: &Bvh<'_>, most: u32, work: &Work) -> Option<Option<Place>> {
        let entry = match self.pop_entry(most, work)? {
            Some(entry) => entry,
            None => return Some(None),
        };
        Some(Some((entry, child_of(tree, entry)?)))
    }

    #[inline(always)]
    fn pop_entry(&mut self, most: u32, work: &Work) -> Option<Option<ScratchEntry>> {
        #[cfg(not(meshsweep_wide))]
        if !self.least_first {
            return self.stack.pop_up_to(most);
        }
        loop {
            let Some(top) = self.stack.used.checked_sub(1) else { return Some(None) };
            self.stack.used = top;
            let mut entry = self.stack.entries.get(top).copied()?;
            let is_least =
                self.least_first && self.limit.take_least(&mut self.stack, work, &mut entry);
            if entry.key_bits() <= most {
                return Some(Some(entry));
            }
            if is_least {
                self.stack.used = 0;
            }
        }
    }

    /// Ends a descent before it opens a node with this bound.
    #[cold]
    #[inline(never)]
    fn out_of_steps(&mut self, bound: u32) {
        let least = lesser(bound, self.stack.least());
        self.ended = Descent::Truncated { least, ended: Ended::Steps };
    }

    /// How a descent without entries up to `most` ended.
    #[inline(always)]
    fn end(&self, most: u32) -> Descent {
        let least = self.stack.dropped;
        if least <= most {
            Descent::Truncated { least, ended: Ended::Scratch }
        } else {
            Descent::Done
        }
    }
}
