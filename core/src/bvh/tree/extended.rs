//! A model's extent, for its pose in the frame of another or of a solid.

use super::format::Bvh;
use crate::num::greater;
use crate::query::Extended;

/// Input units of a grid unit are 2^this.
pub(crate) fn unit_exponent(tree: &Bvh<'_>) -> i32 {
    tree.scale_exponent().wrapping_add(tree.header().grid_exponent)
}

/// The tree in grid units, from the grid's origin: vertices are stored without the origin, f32
/// vertices with it. Each extent is one more, for boxes without extent.
pub(crate) fn extended(tree: &Bvh<'_>) -> Extended {
    let header = tree.header();
    let origin = if header.is_f32() { [0.0; 3] } else { header.grid_origin.map(f64::from) };
    let (low, high) = tree.grid_bounds();
    let along = |low: f32, high: f32, origin: f64| {
        let (low, high) = ((f64::from(low) - origin).abs(), (f64::from(high) - origin).abs());
        1.0 + greater(high, low)
    };
    let [x, y, z] = origin;
    Extended {
        exponent: unit_exponent(tree),
        origin,
        extent: [along(low.x, high.x, x), along(low.y, high.y, y), along(low.z, high.z, z)],
        error: f64::from(tree.units().surface_error),
    }
}
