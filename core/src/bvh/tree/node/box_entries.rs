//! A segment against the eight boxes of a node: the choice between `entry_lanes`,
//! `integer_entries` and one box after the other.

use super::keys::NO_CHILD;
#[cfg(not(meshsweep_wide))]
use super::opened_node::{OpenedNode, Pushed};
#[cfg(not(meshsweep_wide))]
use super::slab_planes::SlabPlanes;
use super::slab_ray::SlabRay;
use crate::bvh::tree::format::layout::BOXES_BYTES;
use crate::geom::fan::WIDTH;
#[cfg(not(meshsweep_wide))]
use crate::query::ScratchEntry;

/// Keys of a node's children: the parameters at which the segment enters their boxes. No key is
/// below `parent_bound`, and the low three bits hold the number of the child. Boxes that the
/// segment does not enter up to `limit`, and keys from `count` on, have [`NO_CHILD`] or more.
#[inline(always)]
pub fn box_entries(
    record: &[u8; BOXES_BYTES],
    ray: &SlabRay,
    count: u32,
    parent_bound: f32,
    limit: f32,
) -> [u32; WIDTH] {
    #[cfg(meshsweep_wide)]
    let keys = super::entry_lanes::keys(record, ray, count, parent_bound, limit);
    #[cfg(not(meshsweep_wide))]
    let keys = SlabPlanes::of(record, ray)
        .map(|planes| planes.keys(count, [parent_bound.to_bits(), limit.to_bits()]));
    keys.unwrap_or([NO_CHILD; WIDTH])
}

/// Pushes the children of a node whose boxes the segment enters.
#[cfg(not(meshsweep_wide))]
#[inline(always)]
pub(crate) fn push_entries(
    record: &[u8; BOXES_BYTES],
    ray: &SlabRay,
    opened: &OpenedNode,
    slots: &mut [ScratchEntry; WIDTH],
) -> Option<Pushed> {
    let planes = SlabPlanes::of(record, ray)?;
    #[cfg(meshsweep_soft_float)]
    let pushed = super::integer_entries::push(&planes, ray, opened, slots);
    #[cfg(not(meshsweep_soft_float))]
    let pushed = planes.push(opened, slots);
    Some(pushed)
}
