//! Where everything stands in the section of the triboxes.

/// Bytes of the header of the tribox hierarchy.
pub const TRIBOXES_BYTES: usize = 32;
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
