//! Sizes, limits and offsets in the sections of the hull hierarchy.

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

/// Offsets in a record of the level table.
pub mod level {
    /// u32.
    pub const FACES: usize = 0;
    /// u32.
    pub const SPLITS: usize = 4;
    /// u32.
    pub const NODES: usize = 8;
    /// f32.
    pub const HULL_TO_SURFACE: usize = 12;
    /// f32.
    pub const SURFACE_TO_HULL: usize = 16;
    /// f32.
    pub const VOID_RATIO: usize = 20;
}
