//! Where everything stands in the section of the tight hulls.

/// Bytes of the header of the tight hulls.
pub const TIGHT_BYTES: usize = 8;
/// Bytes of the record of a tight hull.
pub const TIGHT_HULL_BYTES: usize = 24;
/// Flag of the tight hulls: each encloses all that follow it.
pub const TIGHT_NESTED: u32 = 1;
