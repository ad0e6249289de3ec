//! The priority queue of the sweeping process (Guéziec 2000, 3.2), in the caller's slice.
//!
//! The search goes best first while memory is left: a binary heap grows from the left. If the heap
//! could leave too few entries for a depth-first descent, the search goes depth first, on a stack
//! that grows from the right. When the stack is empty, the search returns to the heap.
//!
//! The builder counts the depth-first worst case, `scratch_entries` of the view. So this number of
//! entries is enough for an exact answer. More entries give tighter intervals to a query that stops
//! early.

use super::scratch::ScratchEntry;
use crate::num::tolerance::SUMMED;
use crate::num::{Real, down_to_f32};

/// Total order by key, then node, so that the order of visits does not depend on the heap's
/// history.
pub(crate) fn before(a: &ScratchEntry, b: &ScratchEntry) -> bool {
    let (x, y) = (Real(a.key()), Real(b.key()));
    x < y || (x == y && a.node() < b.node())
}

/// A bound as a key that outlasts a motion: the bound plus the path of the point until then,
/// rounded down. The key less the path until now is a lower bound at any later time. So no key is
/// changed when the point moves.
pub(crate) fn key_of(bound: f64, moved: f64) -> f32 {
    down_to_f32((bound + moved) * (2.0 - SUMMED))
}

/// A key as a bound: the inverse of [`key_of`].
pub(crate) fn bound_of(key: f32, moved: f64) -> f64 {
    (f64::from(key) - moved).max(0.0)
}

/// An entry that left the queue.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Taken {
    pub(crate) entry: ScratchEntry,
    /// No entry that still waits has a smaller key.
    pub(crate) least: bool,
}

#[derive(Debug)]
pub(crate) struct SweepQueue<'a> {
    slots: &'a mut [ScratchEntry],
    /// Entries at the left end.
    heap: usize,
    /// Entries at the right end: the stack of a depth-first descent. If `best_first`: the entries
    /// that were set aside.
    stack: usize,
    /// Free slots that a depth-first descent may need.
    reserve: usize,
    /// Least key of the entries that did not fit.
    dropped: f32,
    depth_first: bool,
    /// Never goes depth first. The right end holds entries that were set aside.
    best_first: bool,
    /// Children pushed on the stack since `begin_children`.
    siblings: usize,
}

impl<'a> SweepQueue<'a> {
    pub(crate) fn new(slots: &'a mut [ScratchEntry], reserve: usize) -> Self {
        SweepQueue {
            slots,
            heap: 0,
            stack: 0,
            reserve,
            dropped: f32::INFINITY,
            depth_first: false,
            best_first: false,
            siblings: 0,
        }
    }

    /// A queue that never goes depth first: an entry that does not fit is dropped.
    pub(crate) fn best_first(slots: &'a mut [ScratchEntry]) -> Self {
        SweepQueue { best_first: true, ..SweepQueue::new(slots, 0) }
    }

    /// Decides where the children of a popped node go. Call it before they are pushed.
    pub(crate) fn begin_children(&mut self, count: u32) {
        self.siblings = 0;
        let free_slots = self.slots.len() - self.heap.min(self.slots.len());
        self.depth_first = !self.best_first
            && (self.stack > 0 || free_slots < (count as usize).saturating_add(self.reserve));
    }

    pub(crate) fn push(&mut self, entry: ScratchEntry) {
        if self.heap + self.stack >= self.slots.len() {
            self.dropped = self.dropped.min(entry.key());
        } else if self.depth_first {
            self.push_stack(entry);
        } else {
            self.push_heap(entry);
        }
    }

    /// The entry to open next. It is `nearest`, the nearest child of the node opened last, if that
    /// has the least key or if `dive` is set. Else it is the best that waits, and `nearest` joins
    /// the queue.
    #[inline]
    pub(crate) fn take(&mut self, nearest: Option<ScratchEntry>, dive: bool) -> Option<Taken> {
        let Some(nearest) = nearest else { return self.pop() };
        // In a descent the nearest child would lie on top of the stack.
        if dive || self.stack > 0 || self.depth_first {
            return Some(Taken { entry: nearest, least: false });
        }
        if self.heap == 0 || self.slots.first().is_none_or(|top| before(&nearest, top)) {
            return Some(Taken { entry: nearest, least: true });
        }
        self.push(nearest);
        self.pop()
    }

    /// Top of the stack during a descent, else of the heap.
    pub(crate) fn pop(&mut self) -> Option<Taken> {
        if self.stack > 0 {
            let top = self.slots.get(self.slots.len() - self.stack).copied();
            self.stack -= 1;
            return top.map(|entry| Taken { entry, least: false });
        }
        self.pop_heap().map(|entry| Taken { entry, least: true })
    }

    /// Least key of all entries that wait or were dropped. Infinite without any.
    pub(crate) fn lower(&self) -> f32 {
        let heap = if self.heap > 0 {
            self.slots.first().map_or(f32::INFINITY, |e| e.key())
        } else {
            f32::INFINITY
        };
        let stack =
            self.slots.iter().rev().take(self.stack).fold(f32::INFINITY, |low, e| low.min(e.key()));
        heap.min(stack).min(self.dropped)
    }

    pub(crate) fn dropped(&self) -> f32 {
        self.dropped
    }

    /// Whether a quarter of the slots hold entries.
    pub(crate) fn is_quarter_full(&self) -> bool {
        (self.heap + self.stack).saturating_mul(4) > self.slots.len()
    }

    /// Forgets everything.
    pub(crate) fn clear(&mut self) {
        (self.heap, self.stack, self.dropped) = (0, 0, f32::INFINITY);
        self.depth_first = false;
    }

    /// Keeps an entry where neither `push` nor `pop_heap` sees it.
    pub(crate) fn set_aside(&mut self, entry: ScratchEntry) {
        if self.heap + self.stack >= self.slots.len() {
            self.dropped = self.dropped.min(entry.key());
        } else {
            self.stack += 1;
            self.set(self.slots.len() - self.stack, entry);
        }
    }

    /// The entries that were set aside.
    pub(crate) fn aside(&self) -> impl ExactSizeIterator<Item = &ScratchEntry> {
        self.slots.iter().rev().take(self.stack)
    }

    /// Pushes the entries that were set aside.
    pub(crate) fn take_back(&mut self) {
        while self.stack > 0 {
            let top = self.slots.get(self.slots.len() - self.stack).copied();
            self.stack -= 1;
            if let Some(entry) = top {
                self.push_heap(entry);
            }
        }
    }

    /// Pushes among the siblings since `begin_children`, nearest on top. Entries below them must
    /// not move, or a descent could need more entries than the builder counted.
    fn push_stack(&mut self, entry: ScratchEntry) {
        self.stack += 1;
        let mut at = self.slots.len() - self.stack;
        let bottom = at + self.siblings;
        self.siblings += 1;
        while at < bottom {
            let Some(below) = self.slots.get(at + 1).copied().filter(|below| before(below, &entry))
            else {
                break;
            };
            self.set(at, below);
            at += 1;
        }
        self.set(at, entry);
    }

    fn set(&mut self, at: usize, entry: ScratchEntry) {
        if let Some(slot) = self.slots.get_mut(at) {
            *slot = entry;
        }
    }

    #[inline(always)]
    fn push_heap(&mut self, entry: ScratchEntry) {
        let mut at = self.heap;
        self.heap += 1;
        while at > 0 {
            let up = (at - 1) / 2;
            let Some(parent) = self.slots.get(up).copied() else { break };
            if !before(&entry, &parent) {
                break;
            }
            self.set(at, parent);
            at = up;
        }
        self.set(at, entry);
    }

    /// The entry of the heap with the least key.
    // Two loops call it, and a call for each entry is dear on boards.
    #[inline(always)]
    pub(crate) fn pop_heap(&mut self) -> Option<ScratchEntry> {
        if self.heap == 0 {
            return None;
        }
        let top = self.slots.first().copied()?;
        self.heap -= 1;
        let last = self.slots.get(self.heap).copied()?;
        let mut at = 0;
        loop {
            let left = 2 * at + 1;
            if left >= self.heap {
                break;
            }
            let mut child = left;
            let mut best = self.slots.get(left).copied()?;
            if left + 1 < self.heap {
                let right = self.slots.get(left + 1).copied()?;
                if before(&right, &best) {
                    best = right;
                    child = left + 1;
                }
            }
            if !before(&best, &last) {
                break;
            }
            self.set(at, best);
            at = child;
        }
        self.set(at, last);
        Some(top)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entries(keys: &[f32]) -> impl Iterator<Item = ScratchEntry> + '_ {
        keys.iter().enumerate().map(|(node, &key)| ScratchEntry::new(key, node as u32))
    }

    #[test]
    fn heap_pops_in_order() {
        let mut slots = [ScratchEntry::EMPTY; 16];
        let mut frontier = SweepQueue::new(&mut slots, 2);
        let keys = [5.0, 1.0, 4.0, 1.0, 3.0, 0.5];
        frontier.begin_children(keys.len() as u32);
        entries(&keys).for_each(|e| frontier.push(e));
        let mut last = ScratchEntry::new(-1.0, 0);
        for _ in 0..keys.len() {
            let taken = frontier.pop().expect("six were pushed");
            assert!(before(&last, &taken.entry) && taken.least);
            last = taken.entry;
        }
        assert!(frontier.pop().is_none());
    }

    #[test]
    fn short_memory_descends_and_sorts_siblings_only() {
        let mut slots = [ScratchEntry::EMPTY; 4];
        let mut frontier = SweepQueue::new(&mut slots, 4);
        frontier.begin_children(2);
        entries(&[7.0, 6.0]).for_each(|e| frontier.push(e));
        assert_eq!(frontier.pop().map(|t| t.entry.key()), Some(6.0));
        frontier.begin_children(2);
        entries(&[9.0, 8.0]).for_each(|e| frontier.push(e));
        assert_eq!(frontier.lower(), 7.0);
        let order: [Option<f32>; 4] =
            core::array::from_fn(|_| frontier.pop().map(|t| t.entry.key()));
        assert_eq!(order, [Some(8.0), Some(9.0), Some(7.0), None]);
    }

    #[test]
    fn the_last_of_a_descent_is_not_taken_for_the_least() {
        let mut slots = [ScratchEntry::EMPTY; 5];
        let mut frontier = SweepQueue::new(&mut slots, 3);
        frontier.begin_children(2);
        entries(&[1.0, 2.0]).for_each(|e| frontier.push(e));
        assert_eq!(frontier.pop().map(|t| (t.entry.key(), t.least)), Some((1.0, true)));
        frontier.begin_children(2);
        frontier.push(ScratchEntry::new(9.0, 7));
        let nearest = ScratchEntry::new(8.0, 8);
        assert_eq!(
            frontier.take(Some(nearest), false),
            Some(Taken { entry: nearest, least: false })
        );
        assert_eq!(frontier.pop().map(|t| (t.entry.key(), t.least)), Some((9.0, false)));
        assert_eq!(frontier.pop().map(|t| (t.entry.key(), t.least)), Some((2.0, true)));
    }

    #[test]
    fn what_does_not_fit_lowers_the_bound() {
        let mut slots = [ScratchEntry::EMPTY; 2];
        let mut frontier = SweepQueue::new(&mut slots, 8);
        frontier.begin_children(3);
        entries(&[3.0, 2.0, 1.0]).for_each(|e| frontier.push(e));
        assert_eq!(frontier.dropped(), 1.0);
        assert_eq!(frontier.lower(), 1.0);
    }
}
