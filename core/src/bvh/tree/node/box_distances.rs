//! Squared distances of a point from eight boxes, in integers.
//!
//! The wide form (`box_lanes`) has eight 16-bit lanes, which fit one register of the smallest
//! vector units. Other processors take two children in a word (`two_in_word`). Both give the same
//! keys.

use super::frame::KeyPoint;
#[cfg(not(meshsweep_wide))]
use super::opened_node::{OpenedNode, Pushed};
use crate::bvh::tree::format::layout::FRAME_BYTES;
use crate::geom::fan::WIDTH;
#[cfg(not(meshsweep_wide))]
use crate::query::ScratchEntry;

/// Keys of a node's children: half the squared distances from the point, in squares of key units.
/// No key is below the parent's, and the low three bits hold the number of the child. Keys from
/// `count` on are [`NO_CHILD`](super::NO_CHILD) or more.
///
/// The key without its low bits is a lower bound.
#[inline(always)]
pub fn box_distances(
    record: &[u8; FRAME_BYTES],
    p: &KeyPoint,
    count: u32,
    parent: u32,
    keys: &mut [u32; WIDTH],
) {
    #[cfg(meshsweep_wide)]
    super::box_lanes::keys(record, p, count, parent, keys);
    #[cfg(not(meshsweep_wide))]
    super::two_in_word::keys(record, p, count, parent, keys);
}

/// Pushes the wanted children of a node.
#[cfg(not(meshsweep_wide))]
#[inline(always)]
pub(crate) fn push_boxes(
    record: &[u8; FRAME_BYTES],
    p: &KeyPoint,
    opened: &OpenedNode,
    slots: &mut [ScratchEntry; WIDTH],
) -> Pushed {
    super::two_in_word::push(record, p, opened, slots)
}
