//! Lower bounds of the distance of a solid from the boxes of a node's children, and of the time at
//! which it first comes near them.
//!
//! The gaps along three orthogonal axes form a vector, and its length is a lower bound of the
//! distance. The tree's axes give one bound, the solid's axes another. The greater one counts.
//! Derivation: `core/docs/rounding.md` §19.

use super::placed_solid::{FIRST_AXIS, PlacedSolid};
use crate::bvh::tree::axis_intervals::AxisIntervals;
use crate::bvh::tree::descent::{NodeQuery, OpenedNode};
use crate::bvh::tree::format::Bvh;
use crate::bvh::tree::node::{CHILD_MASK, NO_CHILD};
use crate::bvh::tree::stored_lengths::{root_of_bound, square_limit};
use crate::geom::fan::WIDTH;
use crate::num::tolerance::{EVERYTHING_SQ, SOLID_AXES, U32};
use crate::num::{greater, lesser, up_to_f32};
use crate::query::{DIRECTIONS, QueryError};

/// A solid's squared distances as keys.
pub(super) struct ByDistance<'a>(pub(super) &'a PlacedSolid);

/// A solid's times as keys.
pub(super) struct ByTime<'a> {
    placed: &'a PlacedSolid,
    /// Boxes with a greater squared bound are never near.
    kept_distance_sq: f32,
    /// Boxes that reach down to this coordinate along the first axis may be near at the start.
    start: f32,
    /// Time for a unit of length along the first axis, rounded down.
    per_length: f32,
}

impl<'a> ByTime<'a> {
    /// Boxes within `kept_distance` of the solid are wanted.
    pub(super) fn new(placed: &'a PlacedSolid, kept_distance: f64) -> ByTime<'a> {
        // Rounded to f32, the axis may be longer than 1.
        let slack = 1.0 + 8.0 * f64::from(U32);
        let start = placed.start + kept_distance * slack;
        let far = greater(start.abs(), kept_distance);
        let speed = up_to_f32(placed.speed);
        ByTime {
            placed,
            kept_distance_sq: square_limit(kept_distance),
            start: up_to_f32(start + far * (8.0 * f64::from(U32))),
            per_length: if speed > 0.0 { 1.0 / speed * (1.0 - 8.0 * U32) } else { 0.0 },
        }
    }
}

/// The greatest key of a bound that is not above a limit.
#[inline(always)]
pub(super) fn key_limit(limit: f32) -> u32 {
    // Below the key of no child.
    lesser(limit, EVERYTHING_SQ).to_bits() | CHILD_MASK
}

/// The bound in a key.
#[inline(always)]
pub(super) fn bound_of(key: u32) -> f32 {
    f32::from_bits(key & !CHILD_MASK)
}

/// A lower bound of the distance, from the key of a box.
pub(super) fn distance_of(key: u32) -> f64 {
    root_of_bound(bound_of(key))
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
    AxisIntervals::of(&placed.directions, tree.boxes(opened.node)?, opened.count)
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
        let lows = boxes.low.get(FIRST_AXIS)?;
        let children = keys.iter_mut().zip(bounds).zip(lows);
        for (child, ((key, bound), low)) in (0u32..opened.count).zip(children) {
            let time = greater(0.0, (low - self.start) * self.per_length);
            let time = time.to_bits().max(opened.bound) & !CHILD_MASK | child;
            *key = if bound <= self.kept_distance_sq { time } else { NO_CHILD };
        }
        Some(())
    }
}
