//! Sizes and offsets in the section of the tight hulls.

/// Bytes of the header of the tight hulls.
pub const TIGHT_BYTES: usize = 8;
/// Bytes of the record of a tight hull.
pub const TIGHT_HULL_BYTES: usize = 24;

/// Offsets in the header of the tight hulls.
pub mod field {
    /// u32.
    pub const COUNT: usize = 0;
    /// Four zeros.
    pub const RESERVED: usize = 4;
}

/// Offsets in the record of a hull.
pub mod record {
    /// u32: of the hull's blob in the section.
    pub const OFFSET: usize = 0;
    /// u32: of the hull's blob.
    pub const BYTES: usize = 4;
    /// u32.
    pub const FACES: usize = 8;
    /// f32.
    pub const SLACK: usize = 12;
    /// f32.
    pub const DEPTH: usize = 16;
    /// f32.
    pub const VOID_RATIO: usize = 20;
}
