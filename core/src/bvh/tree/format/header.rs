//! The box tree's own header: counts, grid, error bound.

use super::layout::{
    BVH_BYTES, BVH_CLOSED, BVH_F32, BVH_SIDELESS, BVH_SIDES_LOST, BVH_TURNED, field,
};
use crate::format::layout::SectionKind;
use crate::format::{Bytes, OpenError, ok};
use glam::Vec3;

/// The box tree's header.
///
/// *Grid units* are units of the tree's grid: local frame divided by `2^grid_exponent`. A
/// coordinate on the grid is a u16 plus `grid_origin`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BvhHeader {
    /// [`BVH_CLOSED`], [`BVH_F32`], [`BVH_SIDES_LOST`], [`BVH_TURNED`] and [`BVH_SIDELESS`].
    pub flags: u8,
    /// Local coordinate = grid coordinate × 2^this.
    pub grid_exponent: i32,
    /// Added to the stored integers.
    pub grid_origin: [i32; 3],
    /// Nodes; node 0 is the root.
    pub nodes: u32,
    /// Leaves, each of one or two fans.
    pub leaves: u32,
    /// Vertices that the leaves store.
    pub vertices: u32,
    /// Triangles.
    pub triangles: u32,
    /// Scratch entries with which no query can overflow.
    pub stack_entries: u32,
    /// No point of the input surface is farther than this from the stored surface, nor the other
    /// way round. Local frame.
    pub surface_error: f32,
    /// The largest sum of the 1-norms of the two spokes of a triangle, grid units, rounded up.
    pub star_radius: f32,
    /// Box of the leaves' vertices, as u16 on the grid, rounded outward.
    pub low: [u16; 3],
    /// See [`low`](Self::low).
    pub high: [u16; 3],
}

impl BvhHeader {
    /// Whether the nearest triangle of the stored surface shows the side of the input.
    pub const fn has_sides(&self) -> bool {
        self.flags & (BVH_CLOSED | BVH_SIDES_LOST) == BVH_CLOSED
    }

    /// Whether the mesh is closed.
    pub const fn is_closed(&self) -> bool {
        self.flags & BVH_CLOSED != 0
    }

    /// Whether a flag is set.
    pub(super) const fn has_flag(&self, flag: u8) -> bool {
        self.flags & flag != 0
    }

    /// Whether leaf vertices are f32.
    pub const fn is_f32(&self) -> bool {
        self.flags & BVH_F32 != 0
    }

    /// Bytes of one leaf vertex.
    pub const fn vertex_bytes(&self) -> usize {
        if self.is_f32() { 12 } else { 6 }
    }

    /// Corners of the box of the stored vertices, grid units.
    pub(super) const fn grid_bounds(&self) -> (Vec3, Vec3) {
        (self.grid_corner(self.low), self.grid_corner(self.high))
    }

    const fn grid_corner(&self, [x, y, z]: [u16; 3]) -> Vec3 {
        let [ox, oy, oz] = self.grid_origin;
        Vec3::new(
            (x as i32).wrapping_add(ox) as f32,
            (y as i32).wrapping_add(oy) as f32,
            (z as i32).wrapping_add(oz) as f32,
        )
    }

    pub(crate) const fn read(bytes: Bytes<'_>) -> Result<BvhHeader, OpenError> {
        let short = OpenError::Record { section: SectionKind::Bvh, index: 0 };
        let head = Bytes(ok!(bytes.slice(0, BVH_BYTES), short));
        let flags = ok!(head.u8(field::FLAGS), short);
        let reserved = head.is_zero(field::RESERVED, 1)
            && head.is_zero(field::RESERVED_BESIDE_FLAGS, 2)
            && head.is_zero(field::RESERVED_AT_END, 4);
        let known = BVH_CLOSED | BVH_F32 | BVH_SIDES_LOST | BVH_TURNED | BVH_SIDELESS;
        if !reserved || flags & !known != 0 {
            return Err(OpenError::Reserved);
        }
        Ok(BvhHeader {
            flags,
            grid_exponent: head.word(field::GRID_EXPONENT).cast_signed(),
            grid_origin: head.i32x3(field::GRID_ORIGIN),
            nodes: head.word(field::NODES),
            leaves: head.word(field::LEAVES),
            vertices: head.word(field::VERTICES),
            triangles: head.word(field::TRIANGLES),
            stack_entries: head.word(field::STACK_ENTRIES),
            surface_error: f32::from_bits(head.word(field::SURFACE_ERROR)),
            star_radius: f32::from_bits(head.word(field::STAR_RADIUS)),
            low: head.u16x3(field::LOW),
            high: head.u16x3(field::HIGH),
        })
    }

    /// Writes the header.
    pub fn write(&self) -> [u8; BVH_BYTES] {
        let mut out = [0u8; BVH_BYTES];
        let mut put = |at: usize, bytes: &[u8]| {
            for (slot, byte) in out.iter_mut().skip(at).zip(bytes) {
                *slot = *byte;
            }
        };
        put(field::FLAGS, &[self.flags]);
        let [x, y, z] = self.grid_origin.map(i32::cast_unsigned);
        let words = [
            (field::GRID_EXPONENT, self.grid_exponent.cast_unsigned()),
            (field::GRID_ORIGIN, x),
            (field::GRID_ORIGIN + 4, y),
            (field::GRID_ORIGIN + 8, z),
            (field::NODES, self.nodes),
            (field::LEAVES, self.leaves),
            (field::VERTICES, self.vertices),
            (field::TRIANGLES, self.triangles),
            (field::STACK_ENTRIES, self.stack_entries),
            (field::SURFACE_ERROR, self.surface_error.to_bits()),
            (field::STAR_RADIUS, self.star_radius.to_bits()),
        ];
        for (at, word) in words {
            put(at, &word.to_le_bytes());
        }
        for (at, corner) in [(field::LOW, self.low), (field::HIGH, self.high)] {
            for (axis, short) in corner.into_iter().enumerate() {
                put(at + 2 * axis, &short.to_le_bytes());
            }
        }
        out
    }
}
