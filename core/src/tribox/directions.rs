//! The nine directions of a tribox.

/// Number of slabs.
pub const SLABS: usize = 9;

/// Faces: face `2·d` is where direction `d` is least, `2·d + 1` where it is greatest.
pub const FACES: usize = 2 * SLABS;

/// The slabs' directions. The last six have length √2.
pub const DIRECTIONS: [[i8; 3]; SLABS] = [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
    [1, 1, 0],
    [1, -1, 0],
    [0, 1, 1],
    [0, 1, -1],
    [1, 0, 1],
    [-1, 0, 1],
];
