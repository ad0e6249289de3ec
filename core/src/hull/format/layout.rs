//! Sizes, limits and offsets in the sections of the hull hierarchy.

/// Bytes of one record of the level table.
pub const LEVEL_BYTES: usize = 20;
/// Triangles of the base hull that share a bound.
pub const BASE_GROUP: u32 = 16;
/// Most ring vertices of a split, so that six bits hold the right wing.
pub const MAX_RING: usize = 64;
/// The right wing's position in the ring, in a split's byte of wings.
pub const RIGHT_WING: u8 = 0x3F;
/// Bit of the wings: the triangle at the right wing is a child of the triangle before the wing.
pub const RIGHT_BEFORE: u8 = 0x40;
/// Bit of the wings: the triangle at the left wing is a child of the triangle before the wing.
pub const LEFT_BEFORE: u8 = 0x80;
/// Splits that share a start in the source numbers.
pub const START_GROUP: u32 = 8;
/// A split's triangles take so many numbers of [`Instance`](super::Instance)s.
pub const SLOTS: u32 = 128;

/// Bytes before the numbers of vertices: a u32, the vertices of the input file.
pub const NUMBERS_HEADER_BYTES: usize = 4;
/// Bytes before the records of key frames: a u32, the key frames but the first.
pub const KEYS_HEADER_BYTES: usize = 4;
/// Bytes of the record of one key frame.
pub const KEY_BYTES: usize = 28;
/// Most key frames, so that their numbers are exact in f32.
pub const MAX_KEYS: u32 = 1 << 16;

/// Offsets in the record of a key frame.
pub mod key {
    /// f32.
    pub const ERROR: usize = 0;
    /// Six f32: least corner, greatest corner.
    pub const BOX: usize = 4;
}

/// Offsets in a record of the level table.
pub mod level {
    /// u32.
    pub const FACES: usize = 0;
    /// u32.
    pub const SPLITS: usize = 4;
    /// f32.
    pub const HULL_TO_SURFACE: usize = 8;
    /// f32.
    pub const SURFACE_TO_HULL: usize = 12;
    /// f32.
    pub const VOID_RATIO: usize = 16;
}
