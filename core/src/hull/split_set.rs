//! The splits that were performed, in the caller's fixed memory: a list in the order in which they
//! were performed, and an open-addressing table that finds a split in the list.
//!
//! Every slot carries one entry of the list and two buckets of the table. So the table is never
//! more than half full, and a search ends at an empty bucket. The order of the list depends on the
//! calls alone, not on the table.

use crate::hull::format::SplitIdx;

/// Memory for one performed split of a [`RefinedHull`](crate::RefinedHull): sixteen bytes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SplitSlot {
    /// Number of the split. The two upper bits say which of its two vertices were replaced.
    split: u32,
    /// Uses of its two vertices by performed splits: as the vertex that is replaced, or in a ring.
    required_by: u32,
    /// One more than a position in the list, 0 for none.
    buckets: [u32; 2],
}

/// Bits of the split's number. A blob has fewer than 2^27 splits.
const NUMBER: u32 = (1 << 30) - 1;

/// The list and the table. `S` is an array where the memory lies, and a slice in all algorithms.
#[derive(Clone, Debug)]
pub(crate) struct SplitSet<S: ?Sized = [SplitSlot]> {
    len: usize,
    slots: S,
}

impl<const N: usize> SplitSet<[SplitSlot; N]> {
    pub(crate) const fn new() -> Self {
        SplitSet { len: 0, slots: [SplitSlot { split: 0, required_by: 0, buckets: [0; 2] }; N] }
    }
}

impl SplitSet {
    /// Splits in the list.
    #[inline(always)]
    pub(crate) fn len(&self) -> usize {
        self.len
    }

    pub(crate) fn capacity(&self) -> usize {
        self.slots.len()
    }

    pub(crate) fn is_full(&self) -> bool {
        self.len >= self.slots.len()
    }

    /// The split at a position of the list.
    #[inline(always)]
    pub(crate) fn get(&self, position: usize) -> Option<SplitIdx> {
        if position >= self.len {
            return None;
        }
        self.slots.get(position).map(|slot| SplitIdx(slot.split & NUMBER))
    }

    /// Whether the vertex that a split adds first (0) or second (1) was replaced.
    #[inline(always)]
    pub(crate) fn is_replaced(&self, position: usize, which: u32) -> bool {
        self.slots.get(position).is_some_and(|slot| slot.split & 1 << (30 + which) != 0)
    }

    pub(crate) fn set_replaced(&mut self, position: usize, which: u32, replaced: bool) {
        if let Some(slot) = self.slots.get_mut(position) {
            let bit = 1 << (30 + which);
            slot.split = if replaced { slot.split | bit } else { slot.split & !bit };
        }
    }

    /// Whether a performed split requires the one at a position.
    #[inline(always)]
    pub(crate) fn is_required(&self, position: usize) -> bool {
        self.slots.get(position).is_some_and(|slot| slot.required_by != 0)
    }

    /// One more use of a split's vertices.
    pub(crate) fn require(&mut self, position: usize) {
        if let Some(slot) = self.slots.get_mut(position) {
            slot.required_by = slot.required_by.saturating_add(1);
        }
    }

    /// One use less.
    pub(crate) fn release(&mut self, position: usize) {
        if let Some(slot) = self.slots.get_mut(position) {
            slot.required_by = slot.required_by.saturating_sub(1);
        }
    }

    pub(crate) fn contains(&self, split: SplitIdx) -> bool {
        self.find(split).is_some()
    }

    /// Position of a split in the list.
    #[inline]
    pub(crate) fn find(&self, split: SplitIdx) -> Option<usize> {
        let mut bucket = self.home(split);
        for _ in 0..=self.len {
            let position = self.bucket(bucket)?.checked_sub(1)? as usize;
            if self.get(position)? == split {
                return Some(position);
            }
            bucket = self.after(bucket);
        }
        None
    }

    /// Adds a split at the end of the list. `false`: the memory is full.
    pub(crate) fn push(&mut self, split: SplitIdx) -> bool {
        let position = self.len;
        let Some(slot) = self.slots.get_mut(position) else { return false };
        (slot.split, slot.required_by) = (split.0 & NUMBER, 0);
        self.len += 1;
        self.enter(split, position);
        true
    }

    /// Marks the split at a position as gone. [`close_gaps`](Self::close_gaps) has to follow before
    /// the next search.
    pub(crate) fn remove(&mut self, position: usize) {
        if let Some(slot) = self.slots.get_mut(position) {
            slot.split = NUMBER;
        }
    }

    /// Takes the marked splits out of the list. The others keep their order.
    pub(crate) fn close_gaps(&mut self) {
        let mut kept = 0;
        for position in 0..self.len {
            let Some(SplitSlot { split, required_by, .. }) = self.slots.get(position).copied()
            else {
                break;
            };
            if split & NUMBER != NUMBER
                && let Some(slot) = self.slots.get_mut(kept)
            {
                (slot.split, slot.required_by) = (split, required_by);
                kept += 1;
            }
        }
        self.len = kept;
        self.slots.iter_mut().for_each(|slot| slot.buckets = [0; 2]);
        for position in 0..kept {
            if let Some(split) = self.get(position) {
                self.enter(split, position);
            }
        }
    }

    /// An empty list. Cost: the slots.
    pub(crate) fn clear(&mut self) {
        self.len = 0;
        self.slots.iter_mut().for_each(|slot| slot.buckets = [0; 2]);
    }

    fn enter(&mut self, split: SplitIdx, position: usize) {
        let mut bucket = self.home(split);
        for _ in 0..=self.len {
            if self.bucket(bucket).is_none_or(|entry| entry == 0) {
                break;
            }
            bucket = self.after(bucket);
        }
        let slot = self.slots.get_mut(bucket / 2);
        if let Some(entry) = slot.and_then(|slot| slot.buckets.get_mut(bucket % 2)) {
            *entry = position as u32 + 1;
        }
    }

    /// The bucket where the search for a split begins: the upper bits of a product with 2^32 over
    /// the golden ratio, scaled to the number of buckets.
    #[inline(always)]
    fn home(&self, split: SplitIdx) -> usize {
        let mixed = split.0.wrapping_mul(0x9E37_79B1);
        ((u64::from(mixed) * (2 * self.slots.len() as u64)) >> 32) as usize
    }

    #[inline(always)]
    fn after(&self, bucket: usize) -> usize {
        if bucket + 1 < 2 * self.slots.len() { bucket + 1 } else { 0 }
    }

    #[inline(always)]
    fn bucket(&self, bucket: usize) -> Option<u32> {
        self.slots.get(bucket / 2)?.buckets.get(bucket % 2).copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_split_is_found_until_it_is_removed_and_the_order_stays() {
        let mut memory = SplitSet::<[SplitSlot; 7]>::new();
        let set: &mut SplitSet = &mut memory;
        let numbers = [900, 3, 17, 0, 5_000_000, 44, 12];
        for &number in &numbers {
            assert!(!set.contains(SplitIdx(number)));
            assert!(set.push(SplitIdx(number)));
        }
        assert!(!set.push(SplitIdx(1)) && !set.contains(SplitIdx(1)));
        for (position, &number) in numbers.iter().enumerate() {
            assert_eq!(set.find(SplitIdx(number)), Some(position));
        }
        set.remove(1);
        set.remove(4);
        set.close_gaps();
        assert!(
            (0..6)
                .map(|i| set.get(i))
                .eq([900, 17, 0, 44, 12].map(|n| Some(SplitIdx(n))).into_iter().chain([None]))
        );
        assert!(!set.contains(SplitIdx(3)) && set.find(SplitIdx(44)) == Some(3));
        set.clear();
        assert!(set.len() == 0 && !set.contains(SplitIdx(900)));
    }

    #[test]
    fn marks_of_a_split_do_not_change_its_number() {
        let mut memory = SplitSet::<[SplitSlot; 2]>::new();
        let set: &mut SplitSet = &mut memory;
        set.push(SplitIdx(6));
        set.set_replaced(0, 1, true);
        set.require(0);
        assert!(!set.is_replaced(0, 0) && set.is_replaced(0, 1) && set.is_required(0));
        assert_eq!((set.find(SplitIdx(6)), set.get(0)), (Some(0), Some(SplitIdx(6))));
        set.set_replaced(0, 1, false);
        set.release(0);
        assert!(!set.is_replaced(0, 1) && !set.is_required(0));
    }

    #[test]
    fn no_memory_holds_nothing() {
        let mut memory = SplitSet::<[SplitSlot; 0]>::new();
        let set: &mut SplitSet = &mut memory;
        assert!(!set.push(SplitIdx(0)) && !set.contains(SplitIdx(0)));
        set.close_gaps();
        assert_eq!(set.len(), 0);
    }
}
