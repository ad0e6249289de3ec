//! Pairs of children that wait, in the caller's scratch memory.
//!
//! ```text
//! nodes a b │ key pair │ key pair │ nodes a b │ key pair
//! ```
//! The pairs of children of two nodes wait together behind an entry that names the nodes. It is a
//! stack: the last pair is taken first.

use crate::num::Real;
use crate::query::ScratchEntry;

/// Pairs that wait.
pub(crate) struct Pending<'s> {
    entries: &'s mut [ScratchEntry],
    used: usize,
}

/// Bits of the number of a pair of children: eight times the child of the first node, plus the
/// child of the second.
const PAIR_BITS: u32 = 6;

impl<'s> Pending<'s> {
    /// The index of the nodes' entry shares a word of 32 bits with the pair's number. So entries
    /// from 2^24 on are not used.
    pub(crate) fn new(entries: &'s mut [ScratchEntry]) -> Pending<'s> {
        let most = entries.len().min(1 << 24);
        Pending { entries: entries.get_mut(..most).unwrap_or_default(), used: 0 }
    }

    /// Adds the entry that names two nodes. `None` if memory ends.
    #[inline(always)]
    pub(crate) fn begin(&mut self, [a, b]: [u32; 2]) -> Option<PendingChildren<'_, 's>> {
        let at = self.used;
        // A node's number has 24 bits.
        *self.entries.get_mut(at)? = ScratchEntry::of_words([a & 0xFF_FFFF, b]);
        self.used += 1;
        Some(PendingChildren { pending: self, at })
    }

    /// The nodes of the last pair and its children. Pairs with keys above the limit are dropped.
    #[inline(always)]
    pub(crate) fn next(&mut self, limit: f32) -> Option<([u32; 2], [u32; 2])> {
        loop {
            let last = self.used.checked_sub(1)?;
            let entry = *self.entries.get(last)?;
            let at = (entry.node() >> PAIR_BITS) as usize;
            // The last pair of two nodes takes their entry with it.
            self.used = if at + 1 >= last { at } else { last };
            if Real(entry.key()) <= Real(limit) {
                let [a, b] = self.entries.get(at)?.words();
                return Some(([a, b], children_of(&entry)));
            }
        }
    }
}

/// Children of two nodes that are added to those that wait.
pub(crate) struct PendingChildren<'p, 's> {
    pending: &'p mut Pending<'s>,
    /// Index of the nodes' entry.
    at: usize,
}

impl PendingChildren<'_, '_> {
    /// `None` if memory ends.
    #[inline(always)]
    pub(crate) fn add(&mut self, key: f32, pair: u32) -> Option<()> {
        let Pending { entries, used } = &mut *self.pending;
        let word = (self.at as u32) << PAIR_BITS | pair;
        *entries.get_mut(*used)? = ScratchEntry::new(key, word);
        *used += 1;
        Some(())
    }

    /// Keeps some of them.
    #[inline(always)]
    pub(crate) fn retain(&mut self, is_kept: impl Fn([usize; 2]) -> bool) {
        let Pending { entries, used } = &mut *self.pending;
        let end = *used;
        *used = self.at + 1;
        for from in self.at + 1..end {
            let Some(&entry) = entries.get(from) else { continue };
            let [i, j] = children_of(&entry);
            if is_kept([i as usize, j as usize])
                && let Some(slot) = entries.get_mut(*used)
            {
                *slot = entry;
                *used += 1;
            }
        }
    }

    /// Puts the pair with the least key last, so that it is taken first. Without a pair the nodes'
    /// entry is removed.
    #[inline(always)]
    pub(crate) fn finish(self) -> Option<()> {
        let Pending { entries, used } = self.pending;
        let Some((last, others)) = entries.get_mut(self.at + 1..*used)?.split_last_mut() else {
            *used = self.at;
            return Some(());
        };
        for entry in others {
            if Real(entry.key()) < Real(last.key()) {
                core::mem::swap(entry, last);
            }
        }
        Some(())
    }
}

#[inline(always)]
fn children_of(entry: &ScratchEntry) -> [u32; 2] {
    [entry.node() >> 3 & 7, entry.node() & 7]
}
