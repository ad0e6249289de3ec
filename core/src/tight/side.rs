//! Distance of a point from a hull, and whether the point is certainly outside.

use super::crossings::{has_side, is_outside};
use crate::bvh::tree::format::Bvh;
use crate::num::tolerance::{LEAST_FAN_ROUNDING, TIGHT_BOX};
use crate::num::{Real, greater};
use crate::query::{Budget, ClosestPoint, QueryError, ScratchEntry};

/// Whether a point (input units) is outside the box of all stored vertices. Exact, except for
/// points that f32 in grid units puts on the box's planes. Those are too near for a distance above
/// 0.
pub(crate) fn is_outside_box(tree: &Bvh<'_>, point: [f32; 3]) -> bool {
    let (units, (low, high)) = (tree.units(), tree.grid_bounds());
    let corners = low.to_array().into_iter().zip(high.to_array());
    point.into_iter().zip(corners).any(|(x, (low, high))| {
        let x = units.inward(x);
        x < low || x > high
    })
}

/// Whether the hull's box, and the mesh before storing moved it, are certainly farther from a point
/// than a distance, both in input units. Never if the point is refused. `core/docs/rounding.md`
/// §12.
pub(crate) fn is_box_beyond(tree: &Bvh<'_>, point: [f32; 3], distance: f32) -> bool {
    let (units, (low, high)) = (tree.units(), tree.grid_ends());
    let mut sum = Real::ZERO;
    for axis in 0..3 {
        let x = Real(units.inward(point[axis]));
        let (below, above) = (Real(low[axis]) - x, x - Real(high[axis]));
        let gap = greater(greater(below, above), Real::ZERO);
        sum = sum + gap * gap;
    }
    let error = Real(units.surface_error) + Real(LEAST_FAN_ROUNDING);
    let limit = Real(units.inward(distance)) + error;
    sum * Real(TIGHT_BOX) > limit * limit
        && tree.serves_distances()
        && point.iter().all(|x| x.to_bits() << 1 < f32::INFINITY.to_bits() << 1)
}

/// The hull's distance as `steps` and `scratch` allow, and whether the point is certainly outside.
pub(crate) fn seen_from(
    tree: &Bvh<'_>,
    point: [f32; 3],
    steps: u32,
    scratch: &mut [ScratchEntry],
) -> Result<(ClosestPoint, bool), QueryError> {
    let near = tree.closest_point(point, Budget::EXACT.with_steps(steps), scratch)?;
    let lower = near.distance.lower;
    let is_outside = if is_outside_box(tree, point) {
        // Storing moved no vertex farther than a distance of 0 allows for.
        lower > 0.0
    } else {
        has_side(tree, lower) && is_outside(tree, point).ok_or(QueryError::Unchecked)?
    };
    Ok((near, is_outside))
}
