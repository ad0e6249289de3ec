//! Pairs that a search left out.

/// Keeps the pairs that a search left out, so that a later search can begin with them.
pub(crate) trait LeftOut {
    /// Whether it keeps anything.
    const KEEPS: bool;
    /// These pairs are not nearer than `distance`, common units.
    fn keep(&mut self, pairs: ChildPairs, distance: f64);
    /// Pairs were dropped for lack of scratch memory. It never gets them.
    fn overflow(&mut self);
}

/// A search that is not continued.
pub(crate) struct Forgotten;

impl LeftOut for Forgotten {
    const KEEPS: bool = false;

    fn keep(&mut self, _: ChildPairs, _: f64) {}

    fn overflow(&mut self) {}
}

/// Pairs of children of two nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ChildPairs {
    pub(crate) nodes: [u32; 2],
    /// A byte for each child of the first node, a bit in it for each child of the second.
    pub(crate) wanted: u64,
}

impl ChildPairs {
    /// Both trees whole.
    pub(crate) const ALL: ChildPairs = ChildPairs { nodes: [0; 2], wanted: u64::MAX };
}
