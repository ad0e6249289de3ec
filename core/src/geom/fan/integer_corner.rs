//! Whether a corner is certainly the closest point of a triangle, in integers of 32 bits.
//!
//! Proof: `core/docs/rounding.md` §8, "Certain corners".

use super::integer::{FRACTION_BITS, IntPoint};
use super::integer_vector::{IntVector, dot, largest, norm_1};
use crate::num::bit_length as bits;

/// The way from a corner of triangles to a query, for [`is_certain`](Self::is_certain).
#[derive(Clone, Copy, Debug)]
pub struct CornerWay {
    /// Eighths, cut down to [`WAY_BITS`] bits.
    offset: IntVector,
    cut: u32,
    /// Its 1-norm, rounded down, grid units.
    size: i32,
}

/// An edge from a corner, seen from a query.
#[derive(Clone, Copy, Debug)]
pub struct EdgeWay {
    /// Not below the product of edge and [`CornerWay::offset`], were that not cut.
    along: i32,
    /// The edge's 1-norm.
    size: i32,
}

impl EdgeWay {
    /// No edge.
    pub const NONE: EdgeWay = EdgeWay { along: 0, size: 0 };
}

/// Bits of a way from a corner: its product with an edge on the grid, of 16 bits, is below 2^31.
const WAY_BITS: u32 = 13;

impl CornerWay {
    /// The way from `vertex` to `p`.
    #[inline(always)]
    pub fn new(p: &IntPoint, vertex: IntVector) -> CornerWay {
        let offset = p.eighths_from(vertex);
        let cut = bits(largest(offset)).saturating_sub(WAY_BITS);
        let [x, y, z] = offset;
        let size = norm_1(offset) >> FRACTION_BITS;
        CornerWay { offset: [x >> cut, y >> cut, z >> cut], cut, size }
    }

    /// An edge that leads from the corner to another one.
    #[inline(always)]
    pub fn edge(&self, edge: IntVector) -> EdgeWay {
        let size = norm_1(edge);
        EdgeWay { along: dot(self.offset, edge).wrapping_add(size), size }
    }

    /// Whether the f32 kernel certainly takes the corner for the closest point of the triangle with
    /// these edges.
    ///
    /// Both make an obtuse angle with the way to the query, by more than all roundings: those of
    /// the point here, and those of the kernel. Then no other region of the kernel applies, and its
    /// lower bound is the distance.
    #[inline(always)]
    pub fn is_certain(&self, one: EdgeWay, other: EdgeWay) -> bool {
        let edges = 2 * (one.size + other.size);
        let room = edges * (3 + ((self.size + edges) >> 17));
        one.along.max(other.along) < -(room >> self.cut)
    }
}
