//! The front of a coherent query: nodes and leaves that together hold the whole surface, each with
//! a lower bound of its distance. It is kept from query to query.
//!
//! An entry's key is its bound plus the path length at that time. The query comes nearer by no more
//! than the path that it travels. So *key − path* stays a lower bound, and no entry has to be
//! changed or sorted (Guéziec 2000, 5.1: intervals widen by the motion).
//!
//! Entries that lately could hold the answer are active. They stand first. The least key of the
//! inactive entries is known, so most queries never read them.

use crate::num::lesser;
use crate::num::tolerance::PATH_SUM;

/// A child of a node and the kind of its bound in 32 bits: 24 for the node (a blob has no more), 5
/// for the kind (2 in use), 3 for the number of the child in the node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Child(u32);

/// The kind of bound that an entry's key holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum BoundKind {
    /// The bound of the child's box.
    Box,
    /// The bound of a leaf's triangles.
    Triangles,
    /// A leaf with a sliver: its key has to be the bound of its box.
    Sliver,
}

impl Child {
    /// Fills memory without an entry. Nothing compares with it: the first child of the root has the
    /// same bits.
    pub(crate) const PLACEHOLDER: Child = Child(0);

    #[inline(always)]
    pub(crate) fn new(node: u32, index: u32) -> Child {
        Child(node << 8 | index & 7)
    }

    #[inline(always)]
    pub(crate) fn node(self) -> u32 {
        self.0 >> 8
    }

    #[inline(always)]
    pub(crate) fn index(self) -> u32 {
        self.0 & 7
    }

    /// Node and number, without the kind of the bound.
    #[inline(always)]
    pub(crate) fn without_bound(self) -> u32 {
        self.0 & 0xFFFF_FF07
    }

    #[inline(always)]
    pub(crate) fn bound_kind(self) -> BoundKind {
        match self.0 >> 3 & 3 {
            0 => BoundKind::Box,
            1 => BoundKind::Triangles,
            _ => BoundKind::Sliver,
        }
    }

    #[inline(always)]
    pub(crate) fn with(self, kind: BoundKind) -> Child {
        Child(self.0 & !(3 << 3) | (kind as u32) << 3)
    }
}

/// The counters and bounds of a front, beside its entries.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FrontState {
    /// Entries.
    pub(crate) count: usize,
    /// Active entries. They stand first.
    pub(crate) active: usize,
    /// No inactive entry has a lesser key.
    pub(crate) rest: f32,
    /// No entry that was dropped for lack of memory has a lesser key.
    pub(crate) dropped: f32,
    /// Path length since the front was begun, grid units, rounded up.
    pub(crate) path: f32,
}

impl FrontState {
    pub(crate) const EMPTY: FrontState =
        FrontState { count: 0, active: 0, rest: f32::INFINITY, dropped: f32::INFINITY, path: 0.0 };
}

/// Entries in the caller's memory.
pub(crate) struct TraversalFront<'a> {
    pub(crate) keys: &'a mut [f32],
    pub(crate) children: &'a mut [Child],
    pub(crate) state: &'a mut FrontState,
}

impl TraversalFront<'_> {
    /// Removes all entries.
    pub(crate) fn clear(&mut self) {
        *self.state = FrontState::EMPTY;
    }

    /// The query has moved by `step`.
    #[inline(always)]
    pub(crate) fn advance(&mut self, step: f32) {
        self.state.path = (self.state.path + step) * (1.0 + PATH_SUM);
    }

    /// Sets the path length to 0 and lowers all keys by it. Keys of a longer path would round too
    /// much.
    #[cold]
    #[inline(never)]
    pub(crate) fn rebase(&mut self) {
        let FrontState { count, rest, dropped, path, .. } = *self.state;
        let less = |key: f32| if key > path { (key - path) * (1.0 - PATH_SUM) } else { 0.0 };
        self.keys.iter_mut().take(count).for_each(|key| *key = less(*key));
        (self.state.rest, self.state.dropped, self.state.path) = (less(rest), less(dropped), 0.0);
    }

    /// Key of a lower bound from the present query. A negative bound counts as 0.
    #[inline(always)]
    pub(crate) fn key(&self, bound: f32) -> f32 {
        let bound = if bound > 0.0 { bound } else { 0.0 };
        (bound + self.state.path) * (1.0 - PATH_SUM)
    }

    /// An entry with a greater key holds nothing within `max_distance`.
    #[inline(always)]
    pub(crate) fn horizon(&self, max_distance: f32) -> f32 {
        (max_distance + self.state.path) * (1.0 + PATH_SUM)
    }

    #[inline(always)]
    pub(crate) fn get(&self, i: usize) -> Option<(f32, Child)> {
        Some((*self.keys.get(i)?, *self.children.get(i)?))
    }

    #[inline(always)]
    pub(crate) fn set(&mut self, i: usize, key: f32, child: Child) {
        if let (Some(slot), Some(of)) = (self.keys.get_mut(i), self.children.get_mut(i)) {
            (*slot, *of) = (key, child);
        }
    }

    #[inline(always)]
    pub(crate) fn swap(&mut self, i: usize, j: usize) {
        if let (Some((key, child)), Some((other_key, other))) = (self.get(i), self.get(j)) {
            self.set(i, other_key, other);
            self.set(j, key, child);
        }
    }

    /// Whether `more` entries fit.
    #[inline(always)]
    pub(crate) fn has_room(&self, more: usize) -> bool {
        self.state.count + more <= self.keys.len().min(self.children.len())
    }

    /// Adds an entry, active if its key is within `horizon`. If it does not fit, it is dropped.
    #[inline(always)]
    pub(crate) fn insert(&mut self, key: f32, child: Child, horizon: f32) {
        let last = self.state.count;
        if !self.has_room(1) {
            self.state.dropped = lesser(self.state.dropped, key);
            return;
        }
        self.set(last, key, child);
        self.state.count = last + 1;
        if key <= horizon {
            self.swap(last, self.state.active);
            self.state.active += 1;
        } else {
            self.state.rest = lesser(self.state.rest, key);
        }
    }

    /// Makes entry `i` inactive. Another active one takes its place.
    #[inline(always)]
    pub(crate) fn deactivate(&mut self, i: usize, key: f32) {
        let last = self.state.active.saturating_sub(1);
        self.swap(i, last);
        self.state.active = last;
        self.state.rest = lesser(self.state.rest, key);
    }

    /// Whether there are entries that are not active.
    #[inline(always)]
    pub(crate) fn has_inactive(&self) -> bool {
        self.state.active < self.state.count
    }

    /// Makes all entries within `horizon` active.
    pub(crate) fn activate(&mut self, horizon: f32) {
        let (mut active, mut rest) = (self.state.active, f32::INFINITY);
        let inactive = active..self.state.count;
        for i in inactive {
            let Some(&key) = self.keys.get(i) else { break };
            if key <= horizon {
                self.swap(i, active);
                active += 1;
            } else {
                rest = lesser(rest, key);
            }
        }
        (self.state.active, self.state.rest) = (active, rest);
    }

    /// Frees memory. Deactivates the active entries from `from` on that are beyond `horizon`, then
    /// drops the inactive entries whose keys are not below the mean.
    #[cold]
    #[inline(never)]
    pub(crate) fn evict(&mut self, from: usize, horizon: f32) {
        let mut i = from;
        while i < self.state.active {
            match self.keys.get(i) {
                Some(&key) if key > horizon => self.deactivate(i, key),
                _ => i += 1,
            }
        }
        let FrontState { count, active, .. } = *self.state;
        let keys = self.keys.get(active..count).unwrap_or(&[]);
        let mean = keys.iter().sum::<f32>() / keys.len().max(1) as f32;
        let (mut kept, mut dropped) = (active, self.state.dropped);
        for i in active..count {
            let Some((key, child)) = self.get(i) else { break };
            if key < mean {
                self.set(kept, key, child);
                kept += 1;
            } else {
                dropped = lesser(dropped, key);
            }
        }
        (self.state.count, self.state.dropped) = (kept, dropped);
    }

    /// No entry but the first, and no dropped entry, has a lesser key.
    #[inline(always)]
    pub(crate) fn least_other_key(&self) -> f32 {
        let active = self.keys.get(1..self.state.active).unwrap_or(&[]);
        active
            .iter()
            .fold(lesser(self.state.rest, self.state.dropped), |least, &key| lesser(least, key))
    }
}
