//! Squared distances and lower bounds of a leaf's triangles, kept where computing them again is
//! dear: without floating point.

use crate::geom::fan::WIDTH;
use crate::num::SOFT_FLOAT;

const KEPT: usize = if SOFT_FLOAT { WIDTH } else { 0 };

/// Squared distances and squared lower bounds of triangles of the last leaf.
pub(crate) struct LeafSquares {
    squares: [[f32; 2]; KEPT],
    /// Bits of the triangles that are kept.
    lanes: u32,
}

impl LeafSquares {
    pub(crate) const NONE: LeafSquares = LeafSquares { squares: [[0.0; 2]; KEPT], lanes: 0 };

    /// Those of a triangle, if they are kept.
    #[inline(always)]
    pub(crate) fn of(&self, lane: usize) -> Option<[f32; 2]> {
        if self.lanes >> (lane & 31) & 1 == 0 { None } else { self.squares.get(lane).copied() }
    }
}

#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
impl LeafSquares {
    /// Forgets those of the leaf before.
    #[inline(always)]
    pub(crate) fn clear(&mut self) {
        if SOFT_FLOAT {
            self.lanes = 0;
        }
    }

    #[inline(always)]
    pub(crate) fn keep(&mut self, lane: usize, squares: [f32; 2]) {
        if let Some(slot) = self.squares.get_mut(lane) {
            *slot = squares;
            self.lanes |= 1 << (lane & 31);
        }
    }
}
