//! Triangles that wait for the f32 kernel: see `waiting_search`.

use crate::bvh::point::leaf::plane::Residual;
use crate::bvh::tree::node::CHILD_MASK;
use crate::geom::fan::{Corner, IntBounds, IntLimit, IntLower, WIDTH};
use crate::num::SOFT_FLOAT;

/// Triangles that may wait. If there are more, all of them are looked at, and the next ones wait.
const ROOM: usize = if SOFT_FLOAT { 8 } else { 0 };

/// Triangles of a leaf that are bounded at a time.
const BOUNDED: usize = if SOFT_FLOAT { WIDTH } else { 0 };

#[derive(Clone, Copy)]
pub(crate) struct WaitingTriangle {
    pub(crate) node: u32,
    /// The leaf's number among the children of `node`, then the triangle's, then its nearest
    /// corner.
    pub(crate) place: u32,
    /// [`LeafVisit::key`].
    pub(crate) key: u32,
    /// [`IntBounds::upper`].
    pub(crate) upper: u32,
    pub(crate) lower: IntLower,
}

impl WaitingTriangle {
    pub(crate) fn leaf(&self) -> [u32; 2] {
        [self.node, self.place & CHILD_MASK]
    }

    pub(crate) fn lane(&self) -> usize {
        (self.place >> 3) as usize & (WIDTH - 1)
    }

    pub(crate) fn corner(&self) -> Corner {
        Corner { number: (self.place >> 6 & 3) as u8, is_certain: self.place >> 8 != 0 }
    }
}

/// Triangles that may be the nearest.
pub(crate) struct Waiting {
    pub(crate) triangles: heapless::Vec<WaitingTriangle, ROOM>,
    /// Least [`IntBounds::upper`].
    pub(crate) upper: u32,
    /// The offset to the point that `upper` is of.
    pub(crate) residual: Residual,
    /// The search's limit.
    pub(crate) limit: IntLimit,
    /// Those of the last leaf.
    pub(crate) bounds: [IntBounds; BOUNDED],
}

impl Waiting {
    /// None. Only the zeros are a constant: the whole would be copied by `memcpy`.
    #[inline(always)]
    pub(crate) fn none() -> Waiting {
        Waiting {
            triangles: heapless::Vec::new(),
            upper: u32::MAX,
            residual: Residual::NONE,
            limit: IntLimit::NONE,
            bounds: const { [IntBounds::ZERO; BOUNDED] },
        }
    }

    /// Drops those that are beyond the limit. Returns whether there is room for another one.
    #[allow(clippy::reversed_empty_ranges, reason = "nothing waits where floats are instructions")]
    pub(crate) fn makes_room(&mut self) -> bool {
        if self.triangles.is_full() {
            let mut left = 0;
            for at in 0..ROOM {
                // Field by field: else it would be a call of `memmove`, for which alone firmware
                // links it.
                let Some(here) = self.triangles.get(at) else { break };
                let &WaitingTriangle { node, place, key, upper, lower } = here;
                if !lower.is_beyond(self.limit)
                    && let Some(slot) = self.triangles.get_mut(left)
                {
                    (slot.node, slot.place, slot.key) = (node, place, key);
                    (slot.upper, slot.lower) = (upper, lower);
                    left += 1;
                }
            }
            self.triangles.truncate(left);
        }
        !self.triangles.is_full()
    }
}
