//! Sizes and offsets in the sections of the box tree.

/// Bytes of the box tree's header.
pub const BVH_BYTES: usize = 64;
/// Bytes of a node's links.
pub const LINK_BYTES: usize = 20;
/// Bytes of a node's boxes in a shared frame.
pub const FRAME_BYTES: usize = 76;
/// Entries of a frame's matrix are integers in units of 2^-this.
pub const ROW_BITS: u32 = 13;
/// Greatest binary exponent of the step of a frame's axis: 255 steps span every model.
pub const MOST_EXPONENT: u8 = 9;
/// Nodes on the longest path from the root: eight-fold branching needs fewer than ten, degenerate
/// input a few more.
pub const MAX_TREE_DEPTH: usize = 64;
/// Whether a frame's matrix makes no vector longer. By Gershgorin's theorem no eigenvalue of the
/// rows' inner products is above the greatest sum of magnitudes.
#[must_use]
pub fn lengthens_nothing(matrix: &[[i16; 3]; 3]) -> bool {
    let dot = |[a, b, c]: [i16; 3], [x, y, z]: [i16; 3]| {
        let product = |a: i16, x: i16| i64::from(a) * i64::from(x);
        product(a, x) + product(b, y) + product(c, z)
    };
    matrix.iter().all(|row| {
        matrix.iter().map(|other| dot(*row, *other).abs()).sum::<i64>() <= 1 << (2 * ROW_BITS)
    })
}

/// Bytes of a node's axis-aligned boxes.
pub const BOXES_BYTES: usize = 72;
/// Bytes of zeros after the last leaf, so that every leaf can be read at full width. Twice as many
/// for f32 vertices.
pub const FAN_PADDING: usize = 48;
/// Triangles of a block of source numbers.
pub const SOURCE_BLOCK: usize = 64;
/// Bytes of a block's entry in the directory of source numbers.
pub const SOURCE_ENTRY_BYTES: usize = 8;
/// Bytes of zeros after the last source number.
pub const SOURCE_PADDING: usize = 8;
/// Bytes of a leaf's normal cone.
pub const CONE_BYTES: usize = 4;
/// Bytes of a node's moments.
pub const MOMENTS_BYTES: usize = 60;
/// Tree flag: triangles run through every edge as often in one direction as in the other.
pub const BVH_CLOSED: u8 = 1;
/// Tree flag: no triangle tells a side. The builder did not prove of the stored surface that a
/// front looks at places of winding number 0 only.
pub const BVH_SIDES_LOST: u8 = 4;
/// Tree flag: sides are those of triangles turned: of those that a section names, or of all if
/// there is no such section. A reader that does not know it must refuse the tree, or the sides of
/// those triangles would be wrong.
pub const BVH_TURNED: u8 = 8;
/// Tree flag: there is a section of triangles that tell no side. A reader that does not know it
/// must refuse the tree, or sides by those triangles could be wrong.
pub const BVH_SIDELESS: u8 = 16;
/// Tree flag: leaf vertices are f32 in grid units instead of u16 on the grid.
pub const BVH_F32: u8 = 2;

/// Offsets in the box tree's header.
pub mod field {
    /// A zero.
    pub const RESERVED: usize = 0;
    /// u8.
    pub const FLAGS: usize = 1;
    /// Two zeros.
    pub const RESERVED_BESIDE_FLAGS: usize = 2;
    /// i32.
    pub const GRID_EXPONENT: usize = 4;
    /// Three i32.
    pub const GRID_ORIGIN: usize = 8;
    /// u32.
    pub const NODES: usize = 20;
    /// u32.
    pub const LEAVES: usize = 24;
    /// u32.
    pub const VERTICES: usize = 28;
    /// u32.
    pub const TRIANGLES: usize = 32;
    /// u32.
    pub const STACK_ENTRIES: usize = 36;
    /// f32.
    pub const SURFACE_ERROR: usize = 40;
    /// f32.
    pub const STAR_RADIUS: usize = 44;
    /// Three u16.
    pub const LOW: usize = 48;
    /// Three u16.
    pub const HIGH: usize = 54;
    /// Four zeros.
    pub const RESERVED_AT_END: usize = 60;
}

/// Offsets in a node's boxes. Both kinds begin with six rows of eight u8: low and high planes of
/// the first axis, of the second, of the third. In a shared frame high planes are counted down
/// from 255.
pub mod boxes {
    /// Shared frame: nine i16, the rows of the matrix.
    pub const FRAME_ROWS: usize = 48;
    /// Shared frame: three u16, the grid point at byte 128.
    pub const FRAME_ORIGIN: usize = 66;
    /// Shared frame: three u8, the binary exponents of the steps of the axes, and a zero.
    pub const FRAME_EXPONENTS: usize = 72;
    /// Axis-aligned: three f32, where byte 128 lies.
    pub const ORIGIN: usize = 48;
    /// Axis-aligned: three f32, one step of each axis.
    pub const STEPS: usize = 60;
}
