//! Sizes, limits, flags and offsets in the section of the triboxes.

/// Bytes of the header of the tribox hierarchy.
pub const TRIBOXES_BYTES: usize = 32;
/// Bytes of the rows of the matrix after the header, if the triboxes are turned.
pub const TRIBOX_TURN_BYTES: usize = 36;
/// Bytes of one record of its level table.
pub const TRIBOX_LEVEL_BYTES: usize = 16;
/// Bytes of the number of the node that a split splits.
pub const TRIBOX_SPLIT_BYTES: usize = 2;
/// Bytes of a node of the tribox hierarchy.
pub const TRIBOX_BYTES: usize = 40;
/// Most splits above a tribox.
pub const MAX_TRIBOX_DEPTH: u32 = 64;
/// Most triboxes of a level: a node's number takes 16 bits.
pub const MAX_TRIBOXES: u32 = 1 << 15;
/// Flag of the tribox hierarchy: the mesh bounds a solid, and the triboxes hold its inside too.
pub const TRIBOXES_SOLID: u32 = 1;
/// Flag of the tribox hierarchy: a matrix after the header turns the mesh into the triboxes' frame.
pub const TRIBOXES_TURNED: u32 = 2;

/// Offsets in the hierarchy's header.
pub mod field {
    /// u32.
    pub const FLAGS: usize = 0;
    /// i32.
    pub const GRID_EXPONENT: usize = 4;
    /// Three i32.
    pub const GRID_ORIGIN: usize = 8;
    /// u32.
    pub const NODES: usize = 20;
    /// u32.
    pub const LEVELS: usize = 24;
    /// u32.
    pub const DEPTH: usize = 28;
}

/// Offsets in a record of the level table.
pub mod level {
    /// u32.
    pub const TRIBOXES: usize = 0;
    /// f32.
    pub const DISTANCE: usize = 4;
    /// f32.
    pub const ERROR: usize = 8;
    /// f32.
    pub const VOID_RATIO: usize = 12;
}

/// Offsets in a node. It begins with eighteen i16: the least and the greatest value along each
/// direction.
pub mod node {
    /// u16: the split that splits the node.
    pub const SPLIT: usize = 36;
    /// u16: the error as a stored radius.
    pub const ERROR: usize = 38;
}
