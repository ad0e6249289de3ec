//! Where everything stands in the sections of the box tree.

/// Bytes of the box tree's header.
pub const TREE_BYTES: usize = 64;
/// Bytes of a node's links.
pub const LINK_BYTES: usize = 20;
/// Bytes of a node's boxes in a shared frame.
pub const FRAME_BYTES: usize = 108;
/// Bytes of a node's axis-aligned boxes.
pub const BOXES_BYTES: usize = 72;
/// Bytes of zeros after the last leaf, so that a leaf may be read at full width wherever it lies;
/// for f32 vertices twice that.
pub const FAN_PADDING: usize = 48;
/// Triangles of a block of source numbers.
pub const SOURCE_BLOCK: usize = 64;
/// Bytes of a block's entry in the directory of source numbers.
pub const SOURCE_ENTRY_BYTES: usize = 8;
/// Bytes of zeros after the last source number.
pub const SOURCE_PADDING: usize = 8;
/// Bytes of a leaf's normal cone.
pub const CONE_BYTES: usize = 4;
/// Tree flag: every edge belongs to two triangles that run through it in opposite directions, so
/// that the sign of a distance is defined.
pub const TREE_CLOSED: u8 = 1;
/// Tree flag: leaf vertices are f32 in grid units instead of u16 on the grid.
pub const TREE_SINGLE: u8 = 2;
