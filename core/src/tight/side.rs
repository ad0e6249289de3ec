//! Distance of a point from a hull, and whether the point is certainly outside.

use crate::bvh::tree::format::Bvh;
use crate::query::{Budget, ClosestPoint, QueryError, ScratchEntry, Side};

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

/// The hull's distance as `steps` and `scratch` allow, and whether the point is certainly outside.
pub(crate) fn seen_from(
    tree: &Bvh<'_>,
    point: [f32; 3],
    steps: u32,
    scratch: &mut [ScratchEntry],
) -> Result<(ClosestPoint, bool), QueryError> {
    let budget = Budget::EXACT.with_steps(steps);
    if is_outside_box(tree, point) {
        let near = tree.closest_point(point, budget, scratch)?;
        // Storing moved no vertex farther than a distance of 0 allows for.
        return Ok((near, near.distance.lower > 0.0));
    }
    let signed = tree.signed_distance(point, budget, scratch)?;
    Ok((signed.closest, signed.side == Side::Outside))
}
