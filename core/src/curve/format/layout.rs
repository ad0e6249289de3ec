//! Sizes, limits, flags and offsets in the section of the curves.

/// Bytes of the header of the curves.
pub const CURVES_BYTES: usize = 32;
/// Bytes of the record of a polyline.
pub const POLYLINE_BYTES: usize = 4;
/// Bit of a polyline's record: its last point is its first.
pub const POLYLINE_CLOSED: u32 = 1 << 31;
/// More points than a section may hold.
pub const MAX_POINTS: u32 = 1 << 28;
/// Most nodes on the way from the root to a segment.
pub const MAX_CURVE_DEPTH: usize = 64;
/// Flag of the curves: all points have z = 0, which is not stored.
pub const CURVES_PLANAR: u32 = 1;
/// Flag of the curves: coordinates are f32, not integers of the grid.
pub const CURVES_F32: u32 = 2;
/// Byte of a polyline in the section of zones: an inclusion zone.
pub const ZONE_INCLUSION: u8 = 0;
/// Byte of a polyline in the section of zones: an exclusion zone.
pub const ZONE_EXCLUSION: u8 = 1;

/// Offsets in the header.
pub mod field {
    /// u32.
    pub const FLAGS: usize = 0;
    /// i32.
    pub const GRID_EXPONENT: usize = 4;
    /// Three i32.
    pub const GRID_ORIGIN: usize = 8;
    /// u32.
    pub const POINTS: usize = 20;
    /// u32.
    pub const POLYLINES: usize = 24;
    /// u32.
    pub const DEPTH: usize = 28;
}
