//! What one query leaves to the next.

/// The leaf of an answer, to visit first for a query nearby. Any value is safe. A bad one costs a
/// leaf.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Hint(u32);

impl Hint {
    /// No hint.
    pub const NONE: Hint = Hint(u32::MAX);

    /// The leaf that is a child of a node.
    #[inline(always)]
    pub(crate) fn of(node: u32, child: u32) -> Hint {
        Hint(node << 3 | child)
    }

    #[inline(always)]
    pub(crate) fn node(self) -> u32 {
        self.0 >> 3
    }

    #[inline(always)]
    pub(crate) fn child(self) -> u32 {
        self.0 & 7
    }
}

/// For the C interface, where zeros are no hint.
#[doc(hidden)]
impl Hint {
    /// The hint of a word.
    pub const fn of_word(word: u32) -> Hint {
        Hint(!word)
    }

    /// The word of a hint; 0 of none.
    pub const fn word(self) -> u32 {
        !self.0
    }
}
