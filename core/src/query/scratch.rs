//! The caller's memory that a query works in.

use core::ops::{Deref, DerefMut};

/// Eight bytes of working memory. Its contents mean nothing between queries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ScratchEntry {
    /// A key: the bits of an f32 that is not negative, or a part of a pair's state.
    key: u32,
    /// What the key belongs to.
    node: u32,
}

impl ScratchEntry {
    /// Any value, for filling arrays.
    pub const EMPTY: ScratchEntry = ScratchEntry { key: 0, node: 0 };

    #[inline(always)]
    pub(crate) const fn new(key: f32, node: u32) -> ScratchEntry {
        ScratchEntry { key: key.to_bits(), node }
    }

    #[inline(always)]
    pub(crate) const fn of_words([key, node]: [u32; 2]) -> ScratchEntry {
        ScratchEntry { key, node }
    }

    #[inline(always)]
    pub(crate) const fn key(self) -> f32 {
        f32::from_bits(self.key)
    }

    #[inline(always)]
    pub(crate) const fn node(self) -> u32 {
        self.node
    }

    #[inline(always)]
    pub(crate) const fn words(self) -> [u32; 2] {
        [self.key, self.node]
    }
}

/// Working memory of `N` entries of eight bytes each.
///
/// Every question takes `&mut [ScratchEntry]`: a `&mut Scratch<N>`, an array, a part of a longer
/// slice. Each view says how many entries make overflow impossible (`scratch_entries`). With fewer
/// an answer still holds, and it says when memory cut it short.
///
/// ```
/// use meshsweep_core::Scratch;
/// let mut scratch = Scratch::<64>::new();
/// assert_eq!(scratch.len(), 64);
/// assert_eq!(size_of_val(&*scratch), 512);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Scratch<const N: usize>([ScratchEntry; N]);

impl<const N: usize> Scratch<N> {
    /// Memory that no query has used. May initialise a `static`.
    pub const fn new() -> Self {
        Scratch([ScratchEntry::EMPTY; N])
    }
}

impl<const N: usize> Default for Scratch<N> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const N: usize> Deref for Scratch<N> {
    type Target = [ScratchEntry];

    fn deref(&self) -> &[ScratchEntry] {
        &self.0
    }
}

impl<const N: usize> DerefMut for Scratch<N> {
    fn deref_mut(&mut self) -> &mut [ScratchEntry] {
        &mut self.0
    }
}
