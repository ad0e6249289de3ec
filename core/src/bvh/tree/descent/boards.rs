//! The stack on targets without vectors: children are pushed one by one, and entries beyond the
//! limit are passed over in one loop.

use super::{NodeQuery, Stack};
use crate::bvh::tree::format::Bvh;
use crate::bvh::tree::node::{OpenedNode, Pushed};
use crate::geom::fan::WIDTH;
use crate::num::lesser;
use crate::query::ScratchEntry;

/// Any entries. Of zeros alone it would be a call of `memclr`, for which alone firmware links it.
#[cold]
#[inline(never)]
fn blank() -> [ScratchEntry; WIDTH] {
    [ScratchEntry::of_words([0, 1]); WIDTH]
}

impl Stack<'_> {
    /// Pushes the children of a node within the limit, except the nearest. The nearest one's key.
    #[inline(always)]
    pub(crate) fn push_children(
        &mut self,
        query: &impl NodeQuery,
        tree: &Bvh<'_>,
        opened: &OpenedNode,
    ) -> Option<u32> {
        let mut spare = None;
        let free = self.entries.get_mut(self.used..);
        let slots = match free.and_then(|free| free.first_chunk_mut::<WIDTH>()) {
            Some(slots) => slots,
            None => spare.insert(blank()),
        };
        let Pushed { nearest, count } = query.push(tree, opened, slots)?;
        match &spare {
            None => self.used += count,
            Some(wanted) => self.push_few(wanted, count),
        }
        Some(nearest)
    }

    /// Pushes entries as far as they fit.
    #[cold]
    #[inline(never)]
    fn push_few(&mut self, wanted: &[ScratchEntry; WIDTH], count: usize) {
        for entry in wanted.iter().take(count) {
            match self.entries.get_mut(self.used) {
                Some(slot) => {
                    *slot = *entry;
                    self.used += 1;
                }
                None => self.dropped = lesser(self.dropped, entry.key_bits()),
            }
        }
    }

    /// Takes the top entry of those with a key up to `most`. `Some(None)`: there is none.
    #[inline(always)]
    pub(crate) fn pop_up_to(&mut self, most: u32) -> Option<Option<ScratchEntry>> {
        let waiting = self.entries.get(..self.used)?;
        let top = waiting.iter().rposition(|entry| entry.key_bits() <= most);
        self.used = top.unwrap_or(0);
        match top {
            Some(top) => Some(Some(waiting.get(top).copied()?)),
            None => Some(None),
        }
    }
}
