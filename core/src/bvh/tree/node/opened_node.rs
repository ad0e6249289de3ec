//! A node whose children are tested, and the children that are pushed.

#[cfg(any(test, not(meshsweep_wide)))]
use super::keys::NO_CHILD;
#[cfg(any(test, not(meshsweep_wide)))]
use crate::geom::fan::WIDTH;
#[cfg(any(test, not(meshsweep_wide)))]
use crate::query::ScratchEntry;

/// A node whose children get keys.
pub(crate) struct OpenedNode {
    pub(crate) node: u32,
    /// Children.
    pub(crate) count: u32,
    /// Lower bound of everything below the node, in the unit of keys.
    pub(crate) bound: u32,
    /// The visitor's limit, in the unit of keys.
    pub(crate) limit: u32,
}

/// Wanted children of a node: those with keys up to the limit. They are written to eight slots as
/// entries, in order, but for the nearest one, which is followed at once.
#[cfg(any(test, not(meshsweep_wide)))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pushed {
    /// Key of the nearest child; above the limit if none is wanted.
    pub(crate) nearest: u32,
    /// Entries that were written.
    pub(crate) count: usize,
}

/// Writes wanted children one by one, in order.
#[cfg(any(test, not(meshsweep_wide)))]
pub(crate) struct Pusher<'a> {
    slots: &'a mut [ScratchEntry; WIDTH],
    node: u32,
    /// Slots in use.
    used: usize,
    nearest: u32,
    /// The slot of the nearest.
    place: usize,
}

#[cfg(any(test, not(meshsweep_wide)))]
impl<'a> Pusher<'a> {
    /// Nothing written.
    #[inline(always)]
    pub(crate) fn new(node: u32, slots: &'a mut [ScratchEntry; WIDTH]) -> Self {
        Pusher { slots, node, used: 0, nearest: NO_CHILD, place: 0 }
    }

    /// Writes a child with a key up to the limit, at most eight times.
    #[inline(always)]
    pub(crate) fn push(&mut self, key: u32) {
        self.slots[self.used & (WIDTH - 1)] = ScratchEntry::of_words([key, self.node]);
        if key < self.nearest {
            (self.nearest, self.place) = (key, self.used);
        }
        self.used += 1;
    }

    /// Closes the nearest one's gap.
    #[inline(always)]
    pub(crate) fn finish(self) -> Pushed {
        let Pusher { slots, used, nearest, mut place, .. } = self;
        let count = used.saturating_sub(1);
        while place < count {
            slots[place & (WIDTH - 1)] = slots[(place + 1) & (WIDTH - 1)];
            place += 1;
        }
        Pushed { nearest, count }
    }
}

#[cfg(not(meshsweep_wide))]
impl OpenedNode {
    /// Pushes by the keys of all children.
    #[inline(always)]
    pub(crate) fn push_by_keys(
        &self,
        keys: &[u32; WIDTH],
        slots: &mut [ScratchEntry; WIDTH],
    ) -> Pushed {
        let mut pusher = Pusher::new(self.node, slots);
        for &key in keys {
            if key <= self.limit {
                pusher.push(key);
            }
        }
        pusher.finish()
    }
}
