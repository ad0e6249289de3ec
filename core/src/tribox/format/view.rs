//! Checked views of the tribox hierarchy (Crosnier & Rossignac 1999, section 4).
//!
//! If [`Triboxes::open`] returned `Ok`, then every node but the root is the child of exactly one
//! node, which has a lesser number and whose parameters hold the child's, no node is more than
//! [`MAX_TRIBOX_DEPTH`](super::layout::MAX_TRIBOX_DEPTH) splits deep, and every plane of a node
//! touches the node's tribox, so that its [boundary](Tribox::boundary) is exact. Accessors return
//! `Option` all the same. No path can panic.

use super::layout::{
    TRIBOX_BYTES, TRIBOX_LEVEL_BYTES, TRIBOX_SPLIT_BYTES, TRIBOX_TURN_BYTES, TRIBOXES_BYTES,
    TRIBOXES_SOLID, TRIBOXES_TURNED, field, level,
};
use crate::format::layout::SectionKind;
use crate::format::{Bytes, OpenError};
use crate::geom::Pose;
use crate::num::Radius16;
use crate::tribox::bounds::Tribox;
use crate::tribox::directions::{DIRECTIONS, FACES};

/// Mark of a node that no split splits.
pub(crate) const UNSPLIT: u16 = u16::MAX;

/// The hierarchy's header.
///
/// *Units* are units of the triboxes' grid: local frame divided by `2^grid_exponent`. Parameter k
/// of a node is its stored i16 plus direction k · `grid_origin`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TriboxesHeader {
    /// [`TRIBOXES_SOLID`], [`TRIBOXES_TURNED`].
    pub flags: u32,
    /// Local coordinate = coordinate in units × 2^this.
    pub grid_exponent: i32,
    /// The point that parameters are counted from, units.
    pub grid_origin: [i32; 3],
    /// Nodes: one, and two for each split.
    pub nodes: u32,
    /// Records of the level table.
    pub levels: u32,
    /// Most splits above a node, or more.
    pub depth: u32,
}

impl TriboxesHeader {
    pub(crate) fn read(bytes: Bytes<'_>) -> Result<TriboxesHeader, OpenError> {
        let short = OpenError::Record { section: SectionKind::Triboxes, index: 0 };
        let word = |at: usize| bytes.u32(at).ok_or(short);
        let flags = word(field::FLAGS)?;
        if flags & !(TRIBOXES_SOLID | TRIBOXES_TURNED) != 0 {
            return Err(OpenError::Reserved);
        }
        Ok(TriboxesHeader {
            flags,
            grid_exponent: word(field::GRID_EXPONENT)?.cast_signed(),
            grid_origin: bytes.u32x3(field::GRID_ORIGIN).ok_or(short)?.map(u32::cast_signed),
            nodes: word(field::NODES)?,
            levels: word(field::LEVELS)?,
            depth: word(field::DEPTH)?,
        })
    }

    /// Writes the header.
    pub fn write(&self) -> [u8; TRIBOXES_BYTES] {
        let [x, y, z] = self.grid_origin.map(i32::cast_unsigned);
        let words = [
            self.flags,
            self.grid_exponent.cast_unsigned(),
            x,
            y,
            z,
            self.nodes,
            self.levels,
            self.depth,
        ];
        let mut out = [0u8; TRIBOXES_BYTES];
        out.iter_mut()
            .zip(words.into_iter().flat_map(u32::to_le_bytes))
            .for_each(|(slot, byte)| *slot = byte);
        out
    }
}

/// A level of detail: a union of triboxes that holds the mesh. Lengths are in input units.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct TriboxLevel {
    /// How many.
    pub triboxes: u32,
    /// No point of the union's boundary is farther than this from the mesh.
    pub distance: f32,
    /// Formula (10) of the paper: no point of a tribox is farther than this from the convex hull
    /// of what it holds.
    pub error: f32,
    /// The triboxes' volume divided by the solid's, less 1. 0 if the mesh bounds no solid. May be
    /// negative if parts of the mesh overlap.
    pub void_ratio: f32,
}

/// The tribox hierarchy of a blob, or a coarser level of it. Copies are cheap: it borrows the bytes
/// and holds the header.
///
/// Node 0 is all of the mesh. Split s makes nodes 2s + 1 and 2s + 2 of another node, so that the
/// first 2s + 1 nodes are the hierarchy of s splits.
///
/// The triboxes may be [turned](Self::is_turned). Then nodes are in a frame of their own. Questions
/// take places and poses in the mesh's frame all the same.
#[derive(Clone, Copy, Debug)]
pub struct Triboxes<'a> {
    pub(crate) header: TriboxesHeader,
    pub(crate) scale_exponent: i32,
    /// Input units of a unit, and of a local unit: powers of two.
    pub(crate) unit: f32,
    pub(crate) local: f32,
    pub(crate) turn: Option<&'a [u8; TRIBOX_TURN_BYTES]>,
    pub(crate) levels: &'a [[u8; TRIBOX_LEVEL_BYTES]],
    pub(crate) splits: &'a [[u8; TRIBOX_SPLIT_BYTES]],
    pub(crate) nodes: &'a [[u8; TRIBOX_BYTES]],
}

/// Direction · point.
#[inline(always)]
fn along(direction: [i8; 3], point: [i32; 3]) -> i32 {
    let terms = direction.into_iter().zip(point).map(|(d, x)| i32::from(d).wrapping_mul(x));
    terms.fold(0, i32::wrapping_add)
}

impl<'a> Triboxes<'a> {
    /// The hierarchy's header.
    #[doc(hidden)]
    pub fn header(&self) -> &TriboxesHeader {
        &self.header
    }

    /// Input coordinate = local coordinate × 2^this.
    pub fn scale_exponent(&self) -> i32 {
        self.scale_exponent
    }

    /// Whether the triboxes hold the inside of a solid, not only a surface.
    pub fn is_solid(&self) -> bool {
        self.header.flags & TRIBOXES_SOLID != 0
    }

    /// Whether the triboxes' directions are turned against those of the mesh's frame.
    #[inline(always)]
    pub fn is_turned(&self) -> bool {
        self.turn.is_some()
    }

    /// Rows of the matrix that takes the mesh's frame to the triboxes': a rotation up to 2^-19, the
    /// identity unless they are [turned](Self::is_turned). The numbers are exact: a tribox holds
    /// the places that this matrix gives in real arithmetic.
    pub fn orientation(&self) -> [[f32; 3]; 3] {
        let Some(bytes) = self.turn else { return Pose::IDENTITY.rotation };
        let mut rows = [[0f32; 3]; 3];
        let numbers = bytes.as_chunks::<4>().0.iter().map(|word| f32::from_le_bytes(*word));
        rows.iter_mut().flatten().zip(numbers).for_each(|(entry, number)| *entry = number);
        rows
    }

    /// Number of nodes.
    #[inline(always)]
    pub fn node_count(&self) -> u32 {
        self.nodes.len() as u32
    }

    /// Number of nodes that are not split.
    pub fn leaf_count(&self) -> u32 {
        self.node_count() / 2 + 1
    }

    /// Most splits above a node, or more.
    pub fn depth(&self) -> u32 {
        self.header.depth
    }

    /// Planes of a node in units, outward: those of slab k at 2k (least value, negated) and 2k + 1
    /// (greatest).
    #[inline(always)]
    pub(crate) fn planes_in_units(&self, node: u32) -> Option<[i32; FACES]> {
        let record = self.nodes.get(node as usize)?;
        let (shorts, _) = record.as_chunks::<2>();
        let mut planes = [0i32; FACES];
        let stored = shorts.iter().map(|bytes| i32::from(i16::from_le_bytes(*bytes)));
        planes.iter_mut().zip(stored).for_each(|(plane, stored)| *plane = stored);
        let (slabs, _) = planes.as_chunks_mut::<2>();
        for ([low, high], direction) in slabs.iter_mut().zip(DIRECTIONS) {
            let offset = along(direction, self.header.grid_origin);
            (*low, *high) = (low.wrapping_add(offset).wrapping_neg(), high.wrapping_add(offset));
        }
        Some(planes)
    }

    /// Planes of a node, input units: of slab k the least value, negated, at 2k and the greatest at
    /// 2k + 1.
    #[inline(always)]
    pub(crate) fn planes(&self, node: u32) -> Option<[f32; FACES]> {
        // Exact: integers of 21 bits and a power of two.
        self.planes_in_units(node).map(|planes| planes.map(|plane| plane as f32 * self.unit))
    }

    /// A node's tribox, input units, in the triboxes' [frame](Self::orientation), exactly as stored
    /// and tight. In real arithmetic it holds the node's part of the mesh and of the solid.
    #[inline]
    pub fn node(&self, node: u32) -> Option<Tribox> {
        let planes = self.planes(node)?;
        let (slabs, _) = planes.as_chunks::<2>();
        let mut tribox = Tribox::EMPTY;
        let parameters = tribox.low.iter_mut().zip(tribox.high.iter_mut());
        parameters
            .zip(slabs)
            .for_each(|((low, high), [minus, plus])| (*low, *high) = (-*minus, *plus));
        Some(tribox)
    }

    /// The split that splits a node, whether or not it is one of this level's.
    #[inline(always)]
    pub(crate) fn split_of(&self, node: u32) -> Option<u16> {
        let (_, rest) = self.nodes.get(node as usize)?.split_first_chunk::<{ 2 * FACES }>()?;
        rest.first_chunk::<2>().map(|bytes| u16::from_le_bytes(*bytes))
    }

    /// Children of a node; `None` of a leaf.
    #[inline(always)]
    pub fn children(&self, node: u32) -> Option<[u32; 2]> {
        let split = u32::from(self.split_of(node)?);
        let children = [2 * split + 1, 2 * split + 2];
        // "None" is beyond all nodes.
        if 2 * split + 2 < self.node_count() { Some(children) } else { None }
    }

    /// Parent of a node; `None` of the root.
    pub fn parent(&self, node: u32) -> Option<u32> {
        let split = node.checked_sub(1)? / 2;
        self.splits.get(split as usize).map(|bytes| u32::from(u16::from_le_bytes(*bytes)))
    }

    /// Formula (10) of the paper, input units: no point of a node's tribox is farther than this
    /// from the convex hull of what it holds.
    pub fn error(&self, node: u32) -> Option<f32> {
        self.local_error(node).map(|error| self.in_input_units(error))
    }

    pub(crate) fn local_error(&self, node: u32) -> Option<f32> {
        let (_, bytes) = self.nodes.get(node as usize)?.split_last_chunk::<2>()?;
        Some(Radius16(u16::from_le_bytes(*bytes)).get())
    }

    /// A length, rounded up at the end of f32's range.
    fn in_input_units(&self, local: f32) -> f32 {
        let length = local * self.local;
        // Below f32's normal range the product may have been rounded down.
        if local > 0.0 && length < f32::MIN_POSITIVE { length.next_up() } else { length }
    }

    /// Nodes that are not split, with their triboxes, by rising number. Together they hold the
    /// mesh. Cost: in proportion to all nodes.
    pub fn leaves(self) -> impl Iterator<Item = (u32, Tribox)> + 'a {
        (0..self.node_count())
            .filter(move |&node| self.children(node).is_none())
            .filter_map(move |node| self.node(node).map(|tribox| (node, tribox)))
    }

    /// The same hierarchy with at most `leaves` leaves, at least one, as if no more splits were
    /// stored.
    #[must_use]
    pub fn coarser(&self, leaves: u32) -> Triboxes<'a> {
        let splits = (self.splits.len() as u32).min(leaves.saturating_sub(1)) as usize;
        let mut coarser = *self;
        coarser.splits = self.splits.get(..splits).unwrap_or(self.splits);
        coarser.nodes = self.nodes.get(..2 * splits + 1).unwrap_or(self.nodes);
        coarser
    }

    /// Number of levels of detail that the table lists; one at least.
    pub fn level_count(&self) -> u32 {
        self.levels.len() as u32
    }

    /// A record of the level table, 0 being the coarsest; [`coarser`](Self::coarser) with its count
    /// gives the triboxes.
    pub fn level(&self, index: u32) -> Option<TriboxLevel> {
        let record = Bytes(self.levels.get(index as usize)?);
        Some(TriboxLevel {
            triboxes: record.u32(level::TRIBOXES)?,
            distance: self.in_input_units(record.f32(level::DISTANCE)?),
            error: self.in_input_units(record.f32(level::ERROR)?),
            void_ratio: record.f32(level::VOID_RATIO)?,
        })
    }

    /// Levels, coarse to fine.
    pub fn levels(self) -> impl Iterator<Item = TriboxLevel> + 'a {
        (0..self.level_count()).map_while(move |index| self.level(index))
    }
}
