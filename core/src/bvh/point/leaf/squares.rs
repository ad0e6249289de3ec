//! Squared distances and lower bounds of a leaf's triangles, kept where computing them again is
//! dear: without floating point.

use crate::bvh::tree::format::lanes_of;
use crate::geom::fan::WIDTH;
use crate::num::{Real, SOFT_FLOAT};

/// Triangles of one leaf.
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

/// Triangles of several leaves.
const LATEST: usize = 16;
const ROOM: usize = if SOFT_FLOAT { LATEST } else { 0 };

/// Those of the latest triangles of leaves that are looked at again.
pub(crate) struct LatestSquares {
    squares: [[f32; 2]; ROOM],
    /// All triangles that were kept.
    count: usize,
}

impl LatestSquares {
    pub(crate) const NONE: LatestSquares = LatestSquares { squares: [[0.0; 2]; ROOM], count: 0 };

    /// Keeps those of a leaf's triangles whose bits in `lanes` are ones, if the squared lower bound
    /// is not above `low_sq`; only these are left in `lanes`. Returns a number by which
    /// [`Self::of`] finds them.
    #[inline(always)]
    pub(crate) fn keep(&mut self, of: &LeafSquares, lanes: &mut u32, low_sq: f32) -> usize {
        let begin = self.count;
        if SOFT_FLOAT {
            for lane in lanes_of(*lanes) {
                match of.of(lane) {
                    Some([_, lower_bound_sq]) if Real(lower_bound_sq) > Real(low_sq) => {
                        *lanes &= !(1 << lane)
                    }
                    squares => {
                        if let Some(slot) = self.squares.get_mut(self.count % LATEST) {
                            *slot = squares.unwrap_or([0.0, f32::NEG_INFINITY]);
                        }
                        self.count += 1;
                    }
                }
            }
        }
        begin
    }

    /// Those of the triangles that were kept at `begin`; `None` if later ones took their place.
    #[inline(always)]
    pub(crate) fn of(&self, begin: usize, lanes: u32) -> Option<LeafSquares> {
        if !SOFT_FLOAT || self.count - begin > LATEST {
            return None;
        }
        let mut of = LeafSquares { lanes, ..LeafSquares::NONE };
        for (at, lane) in lanes_of(lanes).enumerate() {
            let squares = self.squares.get((begin + at) % LATEST)?;
            *of.squares.get_mut(lane)? = *squares;
        }
        Some(of)
    }
}

#[cfg(not(meshsweep_wide))]
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
