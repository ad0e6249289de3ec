//! Triangles that wait for the f32 kernel: see `waiting_search`.

use crate::bvh::leaf_plane::Way;
use crate::bvh::node::CHILD_MASK;
use crate::geom::fan::{Corner, WIDTH, WholeLimit, WholeLower};
use crate::num::SOFT_FLOAT;

/// Triangles that may wait. If there are more, all of them are looked at, and the next ones wait.
const ROOM: usize = if SOFT_FLOAT { 8 } else { 0 };

#[derive(Clone, Copy)]
pub(super) struct WaitingTriangle {
    pub(super) node: u32,
    /// The leaf's number among the children of `node`, then the triangle's, then its nearest corner.
    pub(super) place: u32,
    /// [`LeafVisit::key`].
    pub(super) key: u32,
    /// [`WholeBounds::upper`].
    pub(super) upper: u32,
    pub(super) lower: WholeLower,
}

impl WaitingTriangle {
    const NONE: WaitingTriangle =
        WaitingTriangle { node: 0, place: 0, key: 0, upper: 0, lower: WholeLower::NONE };

    pub(super) fn leaf(&self) -> [u32; 2] {
        [self.node, self.place & CHILD_MASK]
    }

    pub(super) fn lane(&self) -> usize {
        (self.place >> 3) as usize & (WIDTH - 1)
    }

    pub(super) fn corner(&self) -> Corner {
        Corner { number: (self.place >> 6 & 3) as u8, is_certain: self.place >> 8 != 0 }
    }
}

/// Triangles that may be the nearest.
pub(super) struct Waiting {
    pub(super) triangles: [WaitingTriangle; ROOM],
    pub(super) count: usize,
    /// Least [`WholeBounds::upper`].
    pub(super) upper: u32,
    /// The way to the point that `upper` is of.
    pub(super) way: Way,
    /// The search's limit.
    pub(super) limit: WholeLimit,
}

impl Waiting {
    /// None. Only the zeros are a constant: the whole would be copied by `memcpy`.
    #[inline(always)]
    pub(super) fn none() -> Waiting {
        Waiting {
            triangles: const { [WaitingTriangle::NONE; ROOM] },
            count: 0,
            upper: u32::MAX,
            way: Way::NONE,
            limit: WholeLimit::NONE,
        }
    }

    /// Drops those that are beyond the limit. Returns whether there is room for another one.
    pub(super) fn makes_room(&mut self) -> bool {
        if self.count == ROOM {
            let mut left = 0;
            for at in 0..ROOM {
                // Field by field: else it would be a call of `memmove`, for which alone firmware
                // links it.
                let WaitingTriangle { node, place, key, upper, lower } = self.triangles[at];
                if !lower.is_beyond(self.limit)
                    && let Some(slot) = self.triangles.get_mut(left)
                {
                    (slot.node, slot.place, slot.key) = (node, place, key);
                    (slot.upper, slot.lower) = (upper, lower);
                    left += 1;
                }
            }
            self.count = left;
        }
        self.count < ROOM
    }
}
