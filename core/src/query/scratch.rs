//! Memory that a query works in.

/// A child that waits: 8 bytes of the caller's stack.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScratchEntry {
    /// Squared lower bound of its distance, or the parameter at which a segment enters it; the
    /// lane in the low bits.
    pub(crate) key: f32,
    /// Its parent.
    pub(crate) node: u32,
}

impl ScratchEntry {
    /// Any value, for filling arrays.
    pub const EMPTY: ScratchEntry = ScratchEntry { key: 0.0, node: 0 };
}
