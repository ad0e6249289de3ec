//! The shape of a leaf, in one byte.

use crate::geom::fan::WIDTH;

/// Shape of a leaf in one byte: number of vertices, first triangle of the second fan, whether the
/// second fan's winding is opposite.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LeafShape(pub u8);

impl LeafShape {
    /// The shape of a leaf of `triangles` with the second fan beginning at triangle `turn` (0: one
    /// fan).
    pub fn new(triangles: usize, turn: usize, reversed: bool) -> Self {
        let vertices = triangles + 2 + usize::from(turn > 0);
        LeafShape(vertices as u8 & 0x0F | (turn as u8 & 7) << 4 | u8::from(reversed) << 7)
    }

    /// Vertices stored.
    #[inline(always)]
    pub fn vertices(self) -> usize {
        usize::from(self.0 & 0x0F)
    }

    /// First triangle of the second fan; 8 if there is none.
    #[inline(always)]
    pub fn turn(self) -> usize {
        match usize::from(self.0 >> 4 & 7) {
            0 => WIDTH,
            turn => turn,
        }
    }

    /// Centres stored.
    #[inline(always)]
    pub fn centres(self) -> usize {
        1 + usize::from(self.0 & 0x70 != 0)
    }

    /// Triangles.
    #[inline(always)]
    pub fn triangles(self) -> usize {
        self.vertices().wrapping_sub(1 + self.centres())
    }

    /// Whether the triangles of the second fan run the other way round than those of the first.
    pub fn second_reversed(self) -> bool {
        self.0 & 0x80 != 0
    }

    /// Whether a leaf can have this shape.
    pub(crate) fn is_sound(self) -> bool {
        let triangles = self.vertices().checked_sub(1 + self.centres());
        let turns = self.turn() == WIDTH || triangles.is_some_and(|count| self.turn() < count);
        triangles.is_some_and(|count| (1..=WIDTH).contains(&count))
            && turns
            && (self.centres() == 2 || !self.second_reversed())
    }
}

/// What the vector kernels read of a shape, prepared.
#[cfg(meshsweep_avx2)]
#[derive(Clone, Copy)]
pub(super) struct ShapeOffsets {
    /// Bytes of a leaf on the grid at which the three rings begin.
    pub(super) rings: [u8; 3],
    /// First triangle of the second fan; 8 if there is none.
    pub(super) turn: u8,
    /// Triangles, 1 to 8; 0 of what is no shape of a leaf.
    pub(super) triangles: u8,
}

/// For each shape.
#[cfg(meshsweep_avx2)]
pub(super) const SHAPE_OFFSETS: [ShapeOffsets; 256] = {
    let mut table = [ShapeOffsets { rings: [0; 3], turn: 0, triangles: 0 }; 256];
    let mut shape = 0;
    while shape < 256 {
        let (vertices, turn) = (shape as u8 & 15, shape as u8 >> 4 & 7);
        let centres = if turn == 0 { 1 } else { 2 };
        if vertices > centres + 1 && vertices <= centres + 1 + WIDTH as u8 {
            let triangles = vertices - 1 - centres;
            let (ring, step) = (6 * centres, 2 * (triangles + 1));
            table[shape] = ShapeOffsets {
                rings: [ring, ring + step, ring + 2 * step],
                turn: if turn == 0 { WIDTH as u8 } else { turn },
                triangles,
            };
        }
        shape += 1;
    }
    table
};
