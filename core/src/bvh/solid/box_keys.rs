//! Lower bounds of the distance of a solid from the boxes of a node's children, and of the time at
//! which it first comes near them.
//!
//! Gaps along the tree's three axes are the components of a vector that no way from the solid to a
//! box is shorter than. So are those along the solid's axes. The longer of the two vectors counts.
//! Derivation: `core/docs/rounding.md` §19.

use super::placed::{FIRST_AXIS, PlacedSolid};
use crate::bvh::descent::{NodeQuery, OpenedNode};
use crate::bvh::format::Bvh;
use crate::bvh::node::{CHILD_MASK, NO_CHILD};
use crate::bvh::overlap::AxisIntervals;
use crate::geom::fan::WIDTH;
use crate::num::tolerance::{GAP_SLACK, LEAST_GAP_SQ, SOLID_AXES, U32};
use crate::num::{greater, up_to_f32};
use crate::query::{DIRECTIONS, QueryError};

/// A solid's squared distances as keys.
pub(super) struct ByDistance<'a>(pub(super) &'a PlacedSolid);

/// A solid's times as keys.
pub(super) struct ByTime<'a> {
    placed: &'a PlacedSolid,
    /// Boxes with a greater squared bound are never near.
    reach_sq: f32,
    /// Along the first axis, the place that a box must reach to be near at the start.
    start: f32,
    /// Time for a unit of length along the first axis, rounded down.
    per_length: f32,
}

impl<'a> ByTime<'a> {
    /// Boxes within `reach` of the solid are wanted.
    pub(super) fn new(placed: &'a PlacedSolid, reach: f64) -> ByTime<'a> {
        // The axis is longer than 1 by its rounding.
        let slack = 1.0 + 8.0 * f64::from(U32);
        let start = placed.start + reach * slack;
        let far = greater(start.abs(), reach);
        let quick = up_to_f32(placed.speed);
        ByTime {
            placed,
            reach_sq: square_limit(reach),
            start: up_to_f32(start + far * (8.0 * f64::from(U32))),
            per_length: if quick > 0.0 { 1.0 / quick * (1.0 - 8.0 * U32) } else { 0.0 },
        }
    }
}

/// The limit of squared bounds for a distance.
pub(super) fn square_limit(distance: f64) -> f32 {
    let limit = up_to_f32(distance);
    limit * limit * GAP_SLACK + LEAST_GAP_SQ
}

/// The greatest key of a bound that is not above a limit.
#[inline(always)]
pub(super) fn key_limit(limit: f32) -> u32 {
    limit.to_bits() | CHILD_MASK
}

/// The bound in a key.
#[inline(always)]
pub(super) fn bound_of(key: u32) -> f32 {
    f32::from_bits(key & !CHILD_MASK)
}

/// A lower bound of the distance, from the key of a box.
pub(super) fn distance_of(key: u32) -> f64 {
    let bound_sq = bound_of(key);
    if bound_sq < LEAST_GAP_SQ {
        return 0.0;
    }
    libm::sqrt(f64::from(bound_sq)) * (1.0 - 16.0 * f64::from(U32))
}

/// Squared bounds of the first `WIDTH` intervals along all directions.
#[inline(always)]
pub(super) fn bounds_sq(
    placed: &PlacedSolid,
    low: &[[f32; WIDTH]; DIRECTIONS],
    high: &[[f32; WIDTH]; DIRECTIONS],
) -> [f32; WIDTH] {
    let mut sums = [[0f32; WIDTH]; 2];
    let solid = placed.low.iter().zip(&placed.high);
    for (direction, ((from, to), (low, high))) in solid.zip(low.iter().zip(high)).enumerate() {
        let [grid, own] = &mut sums;
        let sum = if direction < FIRST_AXIS { grid } else { own };
        for (sum, (low, high)) in sum.iter_mut().zip(low.iter().zip(high)) {
            let gap = greater(0.0, greater(low - to, from - high));
            *sum += gap * gap;
        }
    }
    let [grid, own] = &sums;
    let mut bounds = *grid;
    for (bound, own) in bounds.iter_mut().zip(own) {
        *bound = greater(*bound, own * SOLID_AXES);
    }
    bounds
}

fn intervals(placed: &PlacedSolid, tree: &Bvh<'_>, opened: &OpenedNode) -> Option<AxisIntervals> {
    AxisIntervals::of(&placed.frame, tree.boxes(opened.node)?, opened.count)
}

impl NodeQuery for ByDistance<'_> {
    fn check_served(tree: &Bvh<'_>) -> Result<(), QueryError> {
        if tree.serves_segments() { Ok(()) } else { Err(QueryError::NO_SEGMENTS) }
    }

    #[inline(always)]
    fn keys(&self, tree: &Bvh<'_>, opened: &OpenedNode, keys: &mut [u32; WIDTH]) -> Option<()> {
        let boxes = intervals(self.0, tree, opened)?;
        let bounds = bounds_sq(self.0, &boxes.low, &boxes.high);
        for (child, (key, bound)) in (0u32..opened.count).zip(keys.iter_mut().zip(bounds)) {
            *key = bound.to_bits().max(opened.bound) & !CHILD_MASK | child;
        }
        Some(())
    }
}

impl NodeQuery for ByTime<'_> {
    fn check_served(tree: &Bvh<'_>) -> Result<(), QueryError> {
        ByDistance::check_served(tree)
    }

    #[inline(always)]
    fn keys(&self, tree: &Bvh<'_>, opened: &OpenedNode, keys: &mut [u32; WIDTH]) -> Option<()> {
        let boxes = intervals(self.placed, tree, opened)?;
        let bounds = bounds_sq(self.placed, &boxes.low, &boxes.high);
        let places = boxes.low.get(FIRST_AXIS)?;
        let children = keys.iter_mut().zip(bounds).zip(places);
        for (child, ((key, bound), place)) in (0u32..opened.count).zip(children) {
            let time = greater(0.0, (place - self.start) * self.per_length);
            let time = time.to_bits().max(opened.bound) & !CHILD_MASK | child;
            *key = if bound <= self.reach_sq { time } else { NO_CHILD };
        }
        Some(())
    }
}
