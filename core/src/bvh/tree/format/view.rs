//! Checked views of the box tree.
//!
//! If [`Bvh::open`] returned `Ok`, then every node below the root is a child of exactly one node
//! with a lesser number, every leaf lies within the fans, and every coordinate is finite and within
//! the tree's box. Accessors return `Option` all the same. No path can panic.

use super::header::BvhHeader;
use super::layout::{
    BOXES_BYTES, BVH_SIDELESS, BVH_TURNED, CONE_BYTES, FRAME_BYTES, LINK_BYTES, MOMENTS_BYTES,
    SOURCE_BLOCK, SOURCE_ENTRY_BYTES,
};
use super::leaf::FanLeaf;
use super::leaf_shape::LeafShape;
use super::moments::NodeMoments;
use super::triangle_bits::TriangleBits;
use super::units::Units;
use crate::format::Bytes;
use crate::geom::fan::WIDTH;
use crate::num::sum_up;
use crate::num::tolerance::{MOST_SURFACE_ERROR, U32};
use crate::query::{Budget, QueryError};
use glam::Vec3;

/// The box tree of a blob: a static 8-wide tree over triangle fans. Copies are cheap: it borrows
/// the bytes and holds the header.
#[derive(Clone, Copy, Debug)]
pub struct Bvh<'a> {
    pub(crate) header: BvhHeader,
    pub(crate) scale_exponent: i32,
    pub(crate) input_triangles: u32,
    pub(super) units: Units,
    /// Corners of the box of the stored vertices, grid units: computed once, for every query.
    pub(super) grid_bounds: (Vec3, Vec3),
    pub(crate) links: &'a [[u8; LINK_BYTES]],
    pub(crate) frames: &'a [[u8; FRAME_BYTES]],
    pub(crate) boxes: &'a [[u8; BOXES_BYTES]],
    pub(crate) fans: &'a [u8],
    pub(crate) source: Bytes<'a>,
    pub(crate) cones: &'a [[u8; CONE_BYTES]],
    pub(crate) moments: &'a [[u8; MOMENTS_BYTES]],
    /// Triangles whose other side tells inside from outside.
    pub(super) turned: &'a [u8],
    /// Triangles that tell no side.
    pub(super) sideless: &'a [u8],
    /// The blob's [`checksum`](crate::Blob::checksum), which names its contents.
    pub(crate) checksum: u32,
}

/// Links to the children of a node: inner nodes first, then leaves.
#[derive(Clone, Copy, Debug)]
pub struct Links {
    /// Number of the first inner child; the others follow it.
    pub first_node: u32,
    /// Children that are nodes.
    pub inner: u32,
    /// All children, 1 to 8.
    pub count: u32,
    /// First vertex of the first leaf; the others follow it.
    pub first_vertex: u32,
    /// First triangle of the first leaf.
    pub first_triangle: u32,
    /// Shapes of the leaves, a byte for each child; 0 for a node.
    shapes: u64,
}

/// A child of a node: another node, or a leaf. Plain numbers and no enum of views: the descent
/// decides by the shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BvhChild {
    /// Number of the node, or first vertex of the leaf.
    pub at: u32,
    /// Shape of the leaf; 0 for a node.
    pub shape: LeafShape,
}

impl BvhChild {
    /// Whether it is a leaf.
    #[inline(always)]
    pub fn is_leaf(self) -> bool {
        self.shape.0 != 0
    }
}

/// Byte number `index` of eight.
#[inline(always)]
fn byte(bytes: u64, index: u32) -> u8 {
    if cfg!(target_pointer_width = "64") {
        // Without a branch: which half it is cannot be predicted.
        return (bytes >> (8 * (index & 7))) as u8;
    }
    let word = if index < 4 { bytes as u32 } else { (bytes >> 32) as u32 };
    (word >> (8 * (index & 3))) as u8
}

/// Sum of the bytes before number `index` of eight. It must be below 256, and each byte below 128.
#[inline(always)]
fn sum_before(bytes: u64, index: u32) -> u32 {
    if cfg!(target_pointer_width = "64") {
        let sums = bytes.wrapping_mul(0x0101_0101_0101_0101) << 8;
        return u32::from(byte(sums, index));
    }
    let (low, high) = (bytes as u32, (bytes >> 32) as u32);
    let before = !(u32::MAX << (8 * (index & 3)));
    let both = if index < 4 { low & before } else { low.wrapping_add(high & before) };
    both.wrapping_mul(0x0101_0101) >> 24
}

impl Links {
    /// A bit for each child.
    #[inline(always)]
    pub(crate) fn mask(&self) -> u32 {
        u32::MAX >> (32 - self.count.clamp(1, 8))
    }

    #[inline(always)]
    fn read(bytes: &[u8; LINK_BYTES]) -> Option<Self> {
        let (words, _) = bytes.as_chunks::<4>();
        let [node, vertex, triangle, low, high] = words.first_chunk::<5>()?.map(u32::from_le_bytes);
        Some(Links {
            first_node: node & 0xFF_FFFF,
            inner: node >> 24 & 0xF,
            count: node >> 28,
            first_vertex: vertex,
            first_triangle: triangle,
            shapes: u64::from(high) << 32 | u64::from(low),
        })
    }

    /// The record's bytes.
    pub fn write(
        first_node: u32,
        inner: usize,
        first_vertex: u32,
        first_triangle: u32,
        shapes: &[LeafShape],
    ) -> [u8; LINK_BYTES] {
        let mut out = [0u8; LINK_BYTES];
        let count = inner + shapes.len();
        let node = first_node & 0xFF_FFFF | (inner as u32 & 0xF) << 24 | (count as u32) << 28;
        let words = [node, first_vertex, first_triangle].into_iter().flat_map(u32::to_le_bytes);
        let shapes = core::iter::repeat_n(0, inner).chain(shapes.iter().map(|shape| shape.0));
        out.iter_mut().zip(words.chain(shapes)).for_each(|(slot, byte)| *slot = byte);
        out
    }

    /// Shape of child number `index`; 0 for a node.
    #[inline(always)]
    pub fn shape(&self, index: u32) -> LeafShape {
        LeafShape(byte(self.shapes, index))
    }

    /// Child number `index`.
    #[inline(always)]
    pub fn child(&self, index: u32) -> BvhChild {
        let (node, vertex) = (self.first_node.wrapping_add(index), self.vertex(index));
        BvhChild { at: if index < self.inner { node } else { vertex }, shape: self.shape(index) }
    }

    /// Child number `index`, which is known to be a leaf.
    #[cfg(meshsweep_wide)]
    #[inline(always)]
    pub(crate) fn leaf_child(&self, index: u32) -> BvhChild {
        BvhChild { at: self.vertex(index), shape: self.shape(index) }
    }

    /// First triangle of the leaf that is child `index`.
    pub fn triangle(&self, index: u32) -> u32 {
        // Vertices less two for each leaf and less one for each second fan.
        let shapes = self.shapes;
        let turns = (shapes >> 4 | shapes >> 5 | shapes >> 6) & 0x0101_0101_0101_0101;
        let leaves = index.saturating_sub(self.inner);
        let less = 2 * leaves + sum_before(turns, index);
        self.first_triangle.wrapping_add(self.vertices_before(index)).wrapping_sub(less)
    }

    /// First vertex of the leaf that is child `index`.
    #[inline(always)]
    pub fn vertex(&self, index: u32) -> u32 {
        self.first_vertex.wrapping_add(self.vertices_before(index))
    }

    /// Vertices of the leaves before child `index`.
    #[inline(always)]
    fn vertices_before(&self, index: u32) -> u32 {
        sum_before(self.shapes & 0x0F0F_0F0F_0F0F_0F0F, index)
    }
}

impl Bvh<'_> {
    /// With this many scratch entries no question about one point, one segment or one solid ends
    /// for lack of memory.
    #[inline]
    pub const fn scratch_entries(&self) -> usize {
        self.header.stack_entries as usize
    }

    /// Scratch entries for questions under `budget`: with a limit of steps twice
    /// [`scratch_entries`](Self::scratch_entries), by which intervals are mostly narrower. Without
    /// a limit as many as those.
    #[inline]
    pub const fn scratch_entries_for(&self, budget: Budget) -> usize {
        let enough = self.scratch_entries();
        if budget.steps < u32::MAX { enough.saturating_mul(2) } else { enough }
    }

    /// Least and greatest corner of the box of the stored vertices, input units, rounded to f32.
    pub fn bounds(&self) -> [[f32; 3]; 2] {
        let (low, high) = self.grid_bounds;
        [low, high].map(|corner| corner.to_array().map(|x| self.units.outward(x, 1.0)))
    }

    /// Triangles of the tree.
    pub const fn triangle_count(&self) -> u32 {
        self.header.triangles
    }

    /// No point of the input surface is farther than this from the stored surface, nor the other
    /// way round. Input units, rounded up.
    pub fn surface_error(&self) -> f32 {
        let error = self.units.outward(self.units.surface_error, 1.0);
        // Below f32's normal range the product may have been rounded down.
        if self.units.surface_error > 0.0 && error < f32::MIN_POSITIVE {
            f32::MIN_POSITIVE
        } else {
            error
        }
    }

    /// The same tree for queries whose place is known up to `error` (input units). A point, or each
    /// end of a segment, may be anywhere within this distance of the place asked about. Every
    /// interval and every verdict holds for all of these places. Points and triangles of answers
    /// are those of the place asked about.
    ///
    /// The error is added to [`surface_error`](Self::surface_error). Of noise larger than the
    /// model's details many answers are [`Ended::Resolution`](crate::Ended::Resolution).
    /// [`front_facing`](Self::front_facing) ignores it.
    ///
    /// # Errors
    /// [`QueryError::Tolerance`] if it is negative, NaN or infinite, or more than 2^60 grid units.
    pub fn with_error(mut self, error: f32) -> Result<Self, QueryError> {
        let mut more = self.units.inward(error);
        if error > 0.0 && more < f32::MIN_POSITIVE {
            more = f32::MIN_POSITIVE;
        }
        let sum = sum_up(self.units.surface_error, more) * (1.0 + 32.0 * U32);
        if error.is_nan() || error < 0.0 || sum.is_nan() || sum > MOST_SURFACE_ERROR {
            return Err(QueryError::Tolerance);
        }
        self.units.surface_error = sum;
        self.units.has_place_error |= error > 0.0;
        Ok(self)
    }

    /// Whether triangles run through every edge as often in one direction as in the other, turned
    /// ones against their winding.
    pub const fn is_closed(&self) -> bool {
        self.header.is_closed()
    }

    /// Whether [`signed_distance`](Bvh::signed_distance) can decide sides. False for an open mesh,
    /// and for a closed one each triangle of which crosses another, lies inside another part or
    /// faces inwards. False as well if the tree has winding numbers and repair did more than turn
    /// triangles. [Winding numbers](Bvh::signed_distance_by_winding) decide the sides of
    /// such a mesh.
    pub const fn has_sides(&self) -> bool {
        self.header.has_sides()
    }

    /// Triangles of the input file.
    pub const fn input_triangles(&self) -> u32 {
        self.input_triangles
    }

    /// Whether the tree was built for distances.
    pub const fn serves_distances(&self) -> bool {
        !self.frames.is_empty()
    }

    /// Whether the tree was built for segments and overlaps.
    pub const fn serves_segments(&self) -> bool {
        !self.boxes.is_empty()
    }

    /// Whether the tree was built for [`front_facing`](Bvh::front_facing).
    pub const fn serves_culling(&self) -> bool {
        !self.cones.is_empty()
    }

    /// Whether the tree was built for [`winding_number`](Bvh::winding_number).
    pub const fn serves_winding(&self) -> bool {
        !self.moments.is_empty()
    }
}

/// Where a triangle's number in the input file lies.
struct SourcePlace {
    /// Byte of its first bit.
    at: usize,
    /// That bit in the byte.
    bit: usize,
    /// Bits.
    width: usize,
}

/// The records, for the builder and the checker.
#[doc(hidden)]
impl<'a> Bvh<'a> {
    /// The tree, if some of its triangles are turned for sides or tell none.
    #[inline(always)]
    pub(crate) const fn if_marked(&self) -> Option<&Self> {
        if self.header.has_flag(BVH_TURNED | BVH_SIDELESS) { Some(self) } else { None }
    }

    /// The triangles that are turned for sides.
    #[inline(always)]
    pub(crate) const fn turned(&self) -> TriangleBits<'a> {
        TriangleBits::new(self.header.has_flag(BVH_TURNED), self.turned)
    }

    /// The triangles that tell no side.
    #[inline(always)]
    pub(crate) const fn sideless(&self) -> TriangleBits<'a> {
        TriangleBits::new(self.header.has_flag(BVH_SIDELESS), self.sideless)
    }

    /// The tree's header.
    pub fn header(&self) -> &BvhHeader {
        &self.header
    }

    /// Input coordinate = local coordinate × 2^this.
    pub fn scale_exponent(&self) -> i32 {
        self.scale_exponent
    }

    /// Whether a triangle of the tree tells no side.
    pub fn is_sideless(&self, triangle: u32) -> bool {
        self.sideless().contains(triangle)
    }

    /// The grid units.
    #[inline(always)]
    pub(crate) fn units(&self) -> Units {
        self.units
    }

    /// [`bounds`](Self::bounds) in grid units.
    #[inline(always)]
    pub(crate) fn grid_bounds(&self) -> (Vec3, Vec3) {
        self.grid_bounds
    }

    /// [`grid_bounds`](Self::grid_bounds) in place.
    #[inline(always)]
    pub(crate) fn grid_ends(&self) -> (&[f32; 3], &[f32; 3]) {
        let (low, high) = &self.grid_bounds;
        (low.as_ref(), high.as_ref())
    }

    /// Tells the tree from others: an address, and the blob's checksum. In Rust the address
    /// suffices. In C the caller may put another blob at the same place.
    #[inline(always)]
    pub(crate) fn identity(&self) -> (usize, u32) {
        (self.links.as_ptr().addr(), self.checksum)
    }

    /// No search opens more nodes: each has one parent. It ends searches in a tree whose links were
    /// not checked.
    #[inline(always)]
    pub(crate) fn most_steps(&self) -> u32 {
        self.links.len() as u32
    }

    /// Links of a node.
    #[inline(always)]
    pub fn links(&self, node: u32) -> Option<Links> {
        Links::read(self.links.get(node as usize)?)
    }

    /// Boxes of a node's children in the frame that they share, for distances.
    #[inline(always)]
    pub fn frame(&self, node: u32) -> Option<&'a [u8; FRAME_BYTES]> {
        self.frames.get(node as usize)
    }

    /// Axis-aligned boxes of a node's children.
    #[inline(always)]
    pub fn boxes(&self, node: u32) -> Option<&'a [u8; BOXES_BYTES]> {
        self.boxes.get(node as usize)
    }

    /// Normal cone of a leaf, leaves counted in the order of nodes.
    pub fn cone(&self, leaf: u32) -> Option<[u8; CONE_BYTES]> {
        self.cones.get(leaf as usize).copied()
    }

    /// Moments of the triangles below a node.
    pub fn moments(&self, node: u32) -> Option<NodeMoments> {
        self.moments.get(node as usize).map(NodeMoments::read)
    }

    /// Child number `index` of `node`.
    #[inline(always)]
    pub fn child(&self, node: u32, index: u32) -> Option<BvhChild> {
        Some(self.links(node)?.child(index))
    }

    /// Child number `index` of `node` if it is a leaf.
    #[cfg_attr(meshsweep_wide, inline(always))]
    pub fn leaf(&self, node: u32, index: u32) -> Option<FanLeaf<'a>> {
        let child = self.child(node, index)?;
        // The shape of a node is refused.
        self.leaf_at(child.at, child.shape)
    }

    /// The leaf whose vertices begin at `vertex`. Kernels rely on 1 to 8 triangles, also in a tree
    /// whose links were not checked.
    #[inline(always)]
    pub fn leaf_at(&self, vertex: u32, shape: LeafShape) -> Option<FanLeaf<'a>> {
        if shape.triangles().wrapping_sub(1) >= WIDTH {
            return None;
        }
        let is_f32 = self.header.is_f32();
        let at = (vertex as usize).wrapping_mul(if is_f32 { 12 } else { 6 });
        Some(FanLeaf {
            bytes: self.fans.get(at..)?,
            shape,
            is_f32,
            origin: self.header.grid_origin,
        })
    }

    /// Number in the input file of a triangle of the tree.
    pub fn source(&self, triangle: u32) -> Option<u32> {
        if triangle >= self.header.triangles {
            return None;
        }
        let SourcePlace { at, bit, width } = self.source_place(triangle)?;
        let least = self.source.u32(triangle as usize / SOURCE_BLOCK * SOURCE_ENTRY_BYTES)?;
        let chunk = u64::from_le_bytes(self.source.array::<8>(at)?);
        let value = (chunk >> bit) & !(u64::MAX << width);
        least.checked_add(value as u32)
    }

    #[inline(always)]
    fn source_place(&self, triangle: u32) -> Option<SourcePlace> {
        let (block, place) = (triangle as usize / SOURCE_BLOCK, triangle as usize % SOURCE_BLOCK);
        let word = self.source.u32(block * SOURCE_ENTRY_BYTES + 4)?;
        let (start, width) = ((word >> 5) as usize, (word & 31) as usize);
        let bit = place * width;
        Some(SourcePlace { at: start.checked_add(bit / 8)?, bit: bit % 8, width })
    }

    /// The bytes from a triangle's number in the input file on.
    #[cfg(meshsweep_avx2)]
    #[inline(always)]
    pub(crate) fn source_bytes(&self, triangle: u32) -> Option<&'a [u8]> {
        self.source.0.get(self.source_place(triangle)?.at..)
    }
}
