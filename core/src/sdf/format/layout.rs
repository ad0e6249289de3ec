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

/// The numbers of a tree: entries of five bytes.
///
/// | bits of a node | what stands there |
/// | --- | --- |
/// | 0 to 15 | entries between the node and its first child |
/// | 24 to 26 | the axes that it halves: x, y, z |
/// | the others | 0 |
///
/// Children stand one after the other, x fastest among the axes that are halved. On each axis the
/// lower side stands first.
///
/// | bits of a leaf | what stands there |
/// | --- | --- |
/// | 0 to 17 | components g of the gradient, six bits each with a sign |
/// | 18 to 23 | the curvature k, six bits with a sign |
/// | 24 to 28 | index of the width in the book |
/// | 29, 30 and 32 to 39 | the code, lowest bits first |
/// | 31 | 1 |
pub mod tree {
    /// Bytes of an entry.
    pub const ENTRY_BYTES: usize = 5;
    /// Bits of a place within a root cell, along each axis.
    pub const ROOT_BITS: u32 = 16;
    /// Most root cells along an axis: fewer than 2^19 units.
    pub const MOST_ROOTS: u8 = 7;
    /// Most halvings along an axis.
    pub const MOST_LEVEL: u32 = 7;
    /// Most entries that a question reads: a node halves at least one of three axes.
    pub const MOST_STEPS: u8 = 3 * MOST_LEVEL as u8 + 1;
    /// Most entries: the number of those before a child has 16 bits.
    pub const MOST_ENTRIES: usize = 1 << 16;
    /// Bit of a leaf in byte 3.
    pub const IS_LEAF: u8 = 1 << 7;
    /// Bits of the axes in byte 3 of a node.
    pub const AXES: u8 = 7;
    /// Widths in the book.
    pub const WIDTHS: usize = 32;
    /// Largest step from one code to the next, in [`PART`] of a unit.
    pub const MOST_STEP: u16 = 1 << 14;
    /// Greatest code.
    pub const MOST_CODE: u32 = 1023;
    /// Greatest component of a gradient: a slope of 1 but for 2^-15.
    pub const ONE: i32 = 31;
    /// One step of a gradient's component, and 1 of a code's step in units, both times
    /// [`PART_OF`]: so that 31 of them are 1 but for 2^-15.
    pub const PART: i32 = 1057;
    /// See [`PART`].
    pub const PART_OF: i32 = 1 << 15;
    /// Bits that the ways are cut by for the squares, less half the level.
    pub const SQUARE_BITS: u32 = 4;
    /// What the sum is shifted by before it is multiplied by [`PART`], so that the product fits.
    pub const VALUE_SHIFT: u32 = 4;
    /// Largest distance of a tree from its base, units. By 1023 codes of the largest step, a
    /// gradient of 32 in three half cells, and a curvature of 32 over 2¹⁶: less than 2^20.
    pub const MOST_VALUE: u32 = 1 << 20;

    /// What the bend's shift loses, in 2^-10 of a unit: less than one step of the sum, 33.03.
    const BEND_SHIFT: u32 = 36;
    /// What the two shifts of the sum lose: less than 16 of its steps and a unit, 1552.5.
    const LAST_SHIFTS: u32 = 1664;

    /// How much a query's value may be below and above the leaf's function, in 2^-10 of a unit: of
    /// a leaf with this curvature and this least level. All three ways count as the longest one.
    ///
    /// A square of n whole steps of 2^cut stands for one of less than (n + 1)², n below 2^11, or
    /// along the gradient below 2^13.
    pub fn loss(curvature: i32, level: u32) -> [u32; 2] {
        let cut = SQUARE_BITS - level / 2;
        // Of the ways, of which one is 2^15 over the level at most, in steps; and along the
        // gradient.
        let most = 1u32 << (15 - level - cut);
        let ways = 3 * (2 * most + 1);
        let along = 2 * 3 * most + 1;
        let bend = curvature.unsigned_abs();
        let part = |squares: u32| (bend * squares).div_ceil(1 << (16 - level - 2 * cut - 5));
        // 34 is above 1024 · 1057 / 2^15 = 33.03.
        let in_units = |squares: u32| part(squares) * 34 / 32 + 1;
        [in_units(ways + along) + BEND_SHIFT + LAST_SHIFTS, in_units(ways + along)]
    }
}

/// Offsets in the header.
pub mod field {
    /// Three f32, input units: the origin, half a unit below corner 0 of the lattice along each
    /// axis. So truncating (point − origin) · per_unit rounds to the nearest unit from corner 0.
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
    /// u8: an [`SdfLayout`](super::super::SdfLayout).
    pub const LAYOUT: usize = 27;
    /// Three u8: cells of a lattice, or root cells of a tree.
    pub const CELLS: usize = 28;
    /// u8: entries that a question of a tree reads at most; 0 of a lattice.
    pub const STEPS: usize = 31;
    /// Two books of sixteen u16: errors of a lattice below and above, or 32 widths of a tree,
    /// units.
    pub const BOOKS: usize = 32;
    /// The second book.
    pub const HIGH: usize = 64;
}
