//! Checked views of the box tree.
//!
//! If [`Bvh::open`] returned `Ok`, then every node below the root is a child of exactly one node
//! with a lesser number, every leaf lies within the fans, and every coordinate is finite and within
//! the tree's box. Accessors still return `Option`, and no path can panic.

use super::header::BvhHeader;
use super::layout::{
    BOXES_BYTES, CONE_BYTES, FRAME_BYTES, LINK_BYTES, SOURCE_BLOCK, SOURCE_ENTRY_BYTES,
};
use super::leaf::{FanLeaf, LeafShape};
use crate::format::Bytes;
use glam::Vec3;

/// The box tree of a blob: a static 8-wide tree over triangle fans. Copies are cheap: it borrows
/// the bytes and holds the header.
#[derive(Clone, Copy, Debug)]
pub struct Bvh<'a> {
    pub(crate) header: BvhHeader,
    pub(crate) scale_exponent: i32,
    pub(crate) input_triangles: u32,
    pub(crate) scale: GridScale,
    pub(crate) links: &'a [[u8; LINK_BYTES]],
    pub(crate) frames: &'a [[u8; FRAME_BYTES]],
    pub(crate) boxes: &'a [[u8; BOXES_BYTES]],
    pub(crate) fans: &'a [u8],
    pub(crate) source: Bytes<'a>,
    pub(crate) cones: &'a [[u8; CONE_BYTES]],
}

/// What every query needs of the header, worked out once.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GridScale {
    /// Grid units of an input unit: a power of two, in two factors within f32's range.
    pub(crate) inward: [f32; 2],
    /// The inverse.
    pub(crate) outward: [f32; 2],
    /// Surface error, grid units.
    pub(crate) surface_error: f32,
    /// Corners of the tree's box, grid units.
    pub(crate) low: Vec3,
    /// See [`low`](Self::low).
    pub(crate) high: Vec3,
}

/// `2^exponent`, exactly, within f32's range.
fn power(exponent: i32) -> f32 {
    f32::from_bits(((127 + exponent.clamp(-126, 127)).cast_unsigned()) << 23)
}

impl GridScale {
    pub(crate) fn of(header: &BvhHeader, scale_exponent: i32) -> GridScale {
        let exponent = scale_exponent.wrapping_add(header.grid_exponent);
        let half = exponent / 2;
        let rest = exponent.wrapping_sub(half);
        let [ox, oy, oz] = header.grid_origin;
        let corner = |[x, y, z]: [u16; 3]| {
            let sum = |stored: u16, origin: i32| i32::from(stored).wrapping_add(origin) as f32;
            Vec3::new(sum(x, ox), sum(y, oy), sum(z, oz))
        };
        GridScale {
            inward: [power(half.wrapping_neg()), power(rest.wrapping_neg())],
            outward: [power(half), power(rest)],
            surface_error: header.surface_error * power(header.grid_exponent.wrapping_neg()),
            low: corner(header.low),
            high: corner(header.high),
        }
    }
}

/// Where the children of a node are: inner nodes first, then leaves.
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
    /// Shapes of the leaves, a byte for each child; 0 for a node. Two words: a Cortex-M has no
    /// 64-bit shifts.
    tags: [u32; 2],
}

/// A child of a node: another node, or a leaf. Plain numbers rather than an enum of views: the
/// descent decides by the tag when it has to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BvhChild {
    /// Number of the node, or first vertex of the leaf.
    pub at: u32,
    /// Shape of the leaf; 0 for a node.
    pub tag: LeafShape,
}

impl BvhChild {
    /// Whether it is a leaf.
    #[inline(always)]
    pub fn is_leaf(self) -> bool {
        self.tag.0 != 0
    }
}

/// Sum of the low nibbles of four tags.
#[inline(always)]
fn nibbles(tags: u32) -> u32 {
    (tags & 0x0F0F_0F0F).wrapping_mul(0x0101_0101) >> 24
}

/// The tags of the children before `lane`.
#[inline(always)]
fn before(tags: [u32; 2], lane: u32) -> [u32; 2] {
    let below = !(u32::MAX << (8 * (lane & 3)));
    let [low, high] = tags;
    if lane < 4 { [low & below, 0] } else { [low, high & below] }
}

impl Links {
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
            tags: [low, high],
        })
    }

    /// The record's bytes.
    pub fn write(
        first_node: u32,
        inner: usize,
        first_vertex: u32,
        first_triangle: u32,
        tags: &[LeafShape],
    ) -> [u8; LINK_BYTES] {
        let mut out = [0u8; LINK_BYTES];
        let count = inner + tags.len();
        let node = first_node & 0xFF_FFFF | (inner as u32 & 0xF) << 24 | (count as u32) << 28;
        let words = [node, first_vertex, first_triangle].into_iter().flat_map(u32::to_le_bytes);
        let tags = core::iter::repeat_n(0, inner).chain(tags.iter().map(|tag| tag.0));
        out.iter_mut().zip(words.chain(tags)).for_each(|(slot, byte)| *slot = byte);
        out
    }

    /// Shape of child `lane`; 0 for a node.
    #[inline(always)]
    pub fn tag(&self, lane: u32) -> LeafShape {
        let [low, high] = self.tags;
        let word = if lane < 4 { low } else { high };
        LeafShape((word >> (8 * (lane & 3))) as u8)
    }

    /// Child `lane`.
    #[inline(always)]
    pub fn child(&self, lane: u32) -> BvhChild {
        let (node, vertex) = (self.first_node.wrapping_add(lane), self.vertex(lane));
        BvhChild { at: if lane < self.inner { node } else { vertex }, tag: self.tag(lane) }
    }

    /// First triangle of leaf `lane`.
    pub fn triangle(&self, lane: u32) -> u32 {
        // Vertices less two for each leaf and less one for each second fan.
        let [low, high] = before(self.tags, lane);
        let turns = |tags: u32| {
            ((tags >> 4 | tags >> 5 | tags >> 6) & 0x0101_0101).wrapping_mul(0x0101_0101) >> 24
        };
        let leaves = lane.saturating_sub(self.inner);
        let less = 2 * leaves + turns(low) + turns(high);
        self.first_triangle.wrapping_add(nibbles(low) + nibbles(high)).wrapping_sub(less)
    }

    /// First vertex of leaf `lane`.
    #[inline(always)]
    pub fn vertex(&self, lane: u32) -> u32 {
        let [low, high] = before(self.tags, lane);
        self.first_vertex.wrapping_add(nibbles(low) + nibbles(high))
    }
}

impl<'a> Bvh<'a> {
    /// The tree's header.
    pub fn header(&self) -> &BvhHeader {
        &self.header
    }

    /// Input coordinate = local coordinate × 2^this.
    pub fn scale_exponent(&self) -> i32 {
        self.scale_exponent
    }

    /// Units and box, for queries.
    #[inline(always)]
    pub(crate) fn scale(&self) -> &GridScale {
        &self.scale
    }

    /// Triangles of the input file.
    pub fn input_triangles(&self) -> u32 {
        self.input_triangles
    }

    /// Whether there are boxes in shared frames, which distances need.
    pub fn serves_distances(&self) -> bool {
        !self.frames.is_empty()
    }

    /// Whether there are axis-aligned boxes, which segments need.
    pub fn serves_segments(&self) -> bool {
        !self.boxes.is_empty()
    }

    /// Whether there are normal cones.
    pub fn serves_culling(&self) -> bool {
        !self.cones.is_empty()
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

    /// Child `lane` of `node`.
    #[inline(always)]
    pub fn child(&self, node: u32, lane: u32) -> Option<BvhChild> {
        Some(self.links(node)?.child(lane))
    }

    /// Child `lane` of `node` if it is a leaf.
    #[inline(always)]
    pub fn leaf(&self, node: u32, lane: u32) -> Option<FanLeaf<'a>> {
        let child = self.child(node, lane)?;
        if child.is_leaf() { self.patch(child.at, child.tag) } else { None }
    }

    /// The leaf whose vertices begin at `vertex`.
    #[inline(always)]
    pub fn patch(&self, vertex: u32, tag: LeafShape) -> Option<FanLeaf<'a>> {
        let is_f32 = self.header.is_f32();
        let at = (vertex as usize).wrapping_mul(if is_f32 { 12 } else { 6 });
        Some(FanLeaf { bytes: self.fans.get(at..)?, tag, is_f32, origin: self.header.grid_origin })
    }

    /// Number in the input file of a triangle of the tree.
    pub fn source(&self, triangle: u32) -> Option<u32> {
        if triangle >= self.header.triangles {
            return None;
        }
        let (block, place) = (triangle as usize / SOURCE_BLOCK, triangle as usize % SOURCE_BLOCK);
        let least = self.source.u32(block * SOURCE_ENTRY_BYTES)?;
        let word = self.source.u32(block * SOURCE_ENTRY_BYTES + 4)?;
        let (start, width) = ((word >> 5) as usize, (word & 31) as usize);
        let bit = place * width;
        let chunk = u64::from_le_bytes(self.source.array::<8>(start.checked_add(bit / 8)?)?);
        let value = (chunk >> (bit % 8)) & !(u64::MAX << width);
        least.checked_add(value as u32)
    }
}
