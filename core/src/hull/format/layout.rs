//! Where everything stands in the sections of the hull hierarchy.

/// Bytes of one record of the level table.
pub const LEVEL_BYTES: usize = 24;
/// Children of a cover node fit in seven bits; the eighth says that they are triangles of the
/// surface.
pub const MAX_CHILDREN: usize = 127;
/// Flag of a cover node whose children are triangles.
pub const LEAF_FLAG: u8 = 0x80;
/// Triangles of the base hull that share a bound.
pub const BASE_GROUP: u32 = 16;
/// Most ring vertices of a split.
pub const MAX_RING: usize = 255;
