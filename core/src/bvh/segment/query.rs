//! A segment in the tree's grid units, prepared for boxes and fans, and the rounding of its
//! answers.

use super::start::SegmentStart;
use crate::bvh::tree::descent::{NodeQuery, OpenedNode};
use crate::bvh::tree::format::{Bvh, Units};
#[cfg(meshsweep_soft_float)]
use crate::bvh::tree::node::GridLine;
use crate::bvh::tree::node::SlabRay;
use crate::bvh::tree::node::box_entries;
#[cfg(meshsweep_avx2)]
use crate::bvh::tree::node::box_entries_avx2;
#[cfg(not(meshsweep_wide))]
use crate::bvh::tree::node::{Pushed, push_entries};
use crate::geom::fan::FanRay;
use crate::geom::fan::WIDTH;
use crate::geom::norm_1;
use crate::num::tolerance::{BOX_ENTRY, STILL, U32};
#[cfg(not(meshsweep_wide))]
use crate::query::ScratchEntry;
use crate::query::{Hit, QueryError};
use glam::Vec3;

/// A segment, and the conversion of its parameters to the caller's.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SegmentQuery {
    pub(crate) ray: FanRay,
    pub(crate) slab_ray: SlabRay,
    /// For targets without an FPU.
    #[cfg(meshsweep_soft_float)]
    pub(crate) line: GridLine,
    units: Units,
    /// The line's origin and direction, grid units.
    origin: Vec3,
    direction: Vec3,
    /// The caller's parameter of `origin`.
    start: f32,
    /// The segment has no length: all parameters are the same point.
    still: bool,
}

impl SegmentQuery {
    /// The query along the line from its start.
    #[inline(always)]
    pub(crate) fn new(tree: &Bvh<'_>, from: &SegmentStart) -> Self {
        let &SegmentStart { origin, direction, far, start, off } = from;
        let units = tree.units();
        let surface = units.surface_error + off;
        let inverse = |d: f32| 1.0 / if d.abs() > STILL { d } else { STILL.copysign(d) };
        let inverse = [inverse(direction.x), inverse(direction.y), inverse(direction.z)];
        // One grid unit is added to the distance: the origin of a node that is flat, or thinner
        // than a grid unit, is an integer.
        let margin = |far: f32| surface + (BOX_ENTRY * U32 * far + BOX_ENTRY * U32);
        let margin = [margin(far.x), margin(far.y), margin(far.z)];
        let end = if start > 0.0 { (1.0 - start) * (1.0 + 4.0 * U32) } else { 1.0 };
        let from = origin.to_array();
        let ray = FanRay::new(from, direction.to_array(), inverse, end, surface, norm_1(far))
            .turning(units.has_place_error);
        SegmentQuery {
            ray,
            #[cfg(meshsweep_soft_float)]
            line: GridLine::new(&ray, tree.header.grid_origin),
            slab_ray: SlabRay::new(from, inverse, margin, far.to_array()),
            units,
            origin,
            direction,
            start,
            still: direction.abs().max_element() <= STILL,
        }
    }

    /// A lower bound of the caller's parameter for `t`.
    #[inline(always)]
    pub(crate) fn lower(&self, t: f32) -> f32 {
        if t == f32::INFINITY {
            t
        } else if self.still {
            0.0
        } else if self.start > 0.0 {
            (self.start + t) * (1.0 - 4.0 * U32)
        } else {
            t
        }
    }

    /// An upper bound of the caller's parameter for `t`.
    #[inline(always)]
    pub(crate) fn upper(&self, t: f32) -> f32 {
        let up = if self.start > 0.0 { (self.start + t) * (1.0 + 4.0 * U32) } else { t };
        if up < 1.0 { up } else { 1.0 }
    }

    /// The caller's hit for a triangle that is met at `t`.
    #[inline(always)]
    pub(crate) fn hit(&self, t: f32, triangle: Option<u32>) -> Hit {
        let point = self.units.point(self.origin + self.direction * t);
        let whole = self.start + t;
        let whole = if whole < 1.0 { whole } else { 1.0 };
        Hit { t: if self.still { 0.0 } else { whole }, point, triangle }
    }
}

impl SegmentQuery {
    /// Keys of a node's children.
    #[inline(always)]
    pub(crate) fn keys_in_register(
        &self,
        tree: &Bvh<'_>,
        opened: &OpenedNode,
    ) -> Option<[u32; WIDTH]> {
        let &OpenedNode { node, count, bound, limit } = opened;
        let (bound, limit) = (f32::from_bits(bound), f32::from_bits(limit));
        Some(box_entries(tree.boxes(node)?, &self.slab_ray, count, bound, limit))
    }

    /// The same in registers of 256 bits, whatever the crate is compiled for.
    #[cfg(meshsweep_avx2)]
    #[target_feature(enable = "avx2")]
    #[inline]
    pub(crate) fn keys_avx2(&self, tree: &Bvh<'_>, opened: &OpenedNode) -> Option<[u32; WIDTH]> {
        let &OpenedNode { node, count, bound, limit } = opened;
        let (bound, limit) = (f32::from_bits(bound), f32::from_bits(limit));
        box_entries_avx2(tree.boxes(node)?, &self.slab_ray, count, bound, limit)
    }
}

impl NodeQuery for SegmentQuery {
    #[inline(always)]
    fn check_served(tree: &Bvh<'_>) -> Result<(), QueryError> {
        if tree.serves_segments() { Ok(()) } else { Err(QueryError::NO_SEGMENTS) }
    }

    #[inline(always)]
    fn keys(&self, tree: &Bvh<'_>, opened: &OpenedNode, keys: &mut [u32; WIDTH]) -> Option<()> {
        *keys = self.keys_in_register(tree, opened)?;
        Some(())
    }

    #[cfg(not(meshsweep_wide))]
    #[inline(always)]
    fn push(
        &self,
        tree: &Bvh<'_>,
        opened: &OpenedNode,
        slots: &mut [ScratchEntry; WIDTH],
    ) -> Option<Pushed> {
        push_entries(tree.boxes(opened.node)?, &self.slab_ray, opened, slots)
    }
}
