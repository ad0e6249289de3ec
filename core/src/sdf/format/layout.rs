//! Sizes, limits and offsets in the section of the distance field.

/// Bytes of the header.
pub const SDF_BYTES: usize = 96;
/// Bits of a place within a cell, along each axis.
pub const FRACTION_BITS: u32 = 11;
/// Units along each axis of a cell.
pub const CELL_UNITS: i32 = 1 << FRACTION_BITS;
/// Bits of the value of a place that the step multiplies.
pub const VALUE_BITS: u32 = 10;
/// Most cells along an axis: fewer than 2^19 units, so that f32 tells units apart.
pub const MOST_CELLS: u8 = u8::MAX;
/// Largest step from one code to the next, units: its product with a value has 31 bits.
pub const MOST_STEP: u16 = 1 << 13;
/// Largest base, the distance that code 0 stands for, units, without sign.
pub const MOST_BASE: i32 = 1 << 28;
/// Errors in each of the two books.
pub const BOOK: usize = 16;

/// Largest loss of a query's shifts, units: 1 for the last, step/1024 for the shift to 18 bits,
/// step/2048 for the shift along z. A value is never too large.
pub const fn value_loss(step: u16) -> u32 {
    1 + (3 * step as u32).div_ceil(2048)
}

/// Offsets in the header.
pub mod field {
    /// Three f32, input units: the origin, half a unit below corner 0 of the lattice along each axis.
    /// So truncating (point − origin) · per_unit rounds to the nearest unit from corner 0.
    pub const ORIGIN: usize = 0;
    /// f32: units in one input unit.
    pub const PER_UNIT: usize = 12;
    /// f32: the inverse of that, rounded to nearest.
    pub const UNIT: usize = 16;
    /// i32: the distance that code 0 stands for, units.
    pub const BASE: usize = 20;
    /// u16: units from one code to the next.
    pub const STEP: usize = 24;
    /// u8: an [`SdfKind`](super::super::SdfKind).
    pub const KIND: usize = 26;
    /// u8: 0.
    pub const RESERVED: usize = 27;
    /// Three u8.
    pub const CELLS: usize = 28;
    /// u8: 0.
    pub const RESERVED_2: usize = 31;
    /// Sixteen u16: errors below, units.
    pub const LOW: usize = 32;
    /// Sixteen u16: errors above, units.
    pub const HIGH: usize = 64;
}
