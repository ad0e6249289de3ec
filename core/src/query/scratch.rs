//! The caller's memory that a query works in.

use core::ops::{Deref, DerefMut};

/// Eight bytes of working memory. Its contents mean nothing between queries.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScratchEntry {
    /// A bound, or the bits of an integer below `SMALL_WORDS`.
    key: f32,
    /// The node that the key belongs to, or any word.
    node: u32,
}

impl ScratchEntry {
    /// Any value, for filling arrays.
    pub const EMPTY: ScratchEntry = ScratchEntry { key: 0.0, node: 0 };

    #[inline(always)]
    pub(crate) const fn new(key: f32, node: u32) -> ScratchEntry {
        ScratchEntry { key, node }
    }

    /// The words below this one are the bits of f32 that are not NaN: 2^31 − 2^23.
    pub(crate) const SMALL_WORDS: u32 = f32::INFINITY.to_bits();

    /// Two words, the first below [`SMALL_WORDS`](Self::SMALL_WORDS). A copy keeps the bits of an
    /// f32 that is not NaN on every target.
    #[inline(always)]
    pub(crate) const fn of_words([small, any]: [u32; 2]) -> ScratchEntry {
        ScratchEntry { key: f32::from_bits(small), node: any }
    }

    #[inline(always)]
    pub(crate) const fn key(self) -> f32 {
        self.key
    }

    #[inline(always)]
    pub(crate) const fn node(self) -> u32 {
        self.node
    }

    /// The bits of the key, or the first word.
    #[inline(always)]
    pub(crate) const fn key_bits(self) -> u32 {
        self.key.to_bits()
    }

    #[inline(always)]
    pub(crate) const fn words(self) -> [u32; 2] {
        [self.key.to_bits(), self.node]
    }
}

/// Working memory of `N` entries of eight bytes each.
///
/// Every question takes `&mut [ScratchEntry]`: a `&mut Scratch<N>`, an array or a part of a longer
/// slice. `scratch_entries` of each view is a number of entries with which no query runs out of
/// memory. With fewer entries an answer still holds, and says if memory ended the search.
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
