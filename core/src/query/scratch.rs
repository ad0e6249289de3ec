//! The caller's memory that a query works in.

use core::ops::{Deref, DerefMut};

/// Eight bytes of working memory. Its contents mean nothing between queries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ScratchEntry {
    words: [u32; 2],
}

impl ScratchEntry {
    /// Any value, for filling arrays.
    pub const EMPTY: ScratchEntry = ScratchEntry { words: [0; 2] };

    /// A bound and the node that it belongs to.
    #[inline(always)]
    pub(crate) const fn new(key: f32, node: u32) -> ScratchEntry {
        ScratchEntry { words: [key.to_bits(), node] }
    }

    /// Any two words.
    #[inline(always)]
    pub(crate) const fn of_words(words: [u32; 2]) -> ScratchEntry {
        ScratchEntry { words }
    }

    #[inline(always)]
    pub(crate) const fn key(self) -> f32 {
        f32::from_bits(self.key_bits())
    }

    /// The bits of the key. Keys are not negative, so bits compare as keys do.
    #[inline(always)]
    pub(crate) const fn key_bits(self) -> u32 {
        let [key, _] = self.words;
        key
    }

    #[inline(always)]
    pub(crate) const fn node(self) -> u32 {
        let [_, node] = self.words;
        node
    }

    #[inline(always)]
    pub(crate) const fn words(self) -> [u32; 2] {
        self.words
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
