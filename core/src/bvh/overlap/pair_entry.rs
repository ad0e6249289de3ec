//! Pairs of nodes that wait for the descent.

/// Nodes whose pairs of children wait: 16 bytes of the caller's stack.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PairEntry {
    pub(crate) nodes: [u32; 2],
    /// A byte for each child of the first, a bit in it for each of the second.
    pub(crate) left: [u32; 2],
}

impl PairEntry {
    /// Any value, for filling arrays.
    pub const EMPTY: PairEntry = PairEntry { nodes: [0; 2], left: [0; 2] };

    /// Entries with which no question can overflow: every entry is deeper in one of the trees, and
    /// none of these has more than 64 levels.
    pub const ENOUGH: usize = 128;
}
