//! A box that holds the vertices of the input mesh.

use super::format::Bvh;
use crate::num::{exp2, greater, lesser};

/// Corners of the box, input units: those of the stored vertices' box, grown by the surface error.
/// In f64, because a grid may reach beyond f32.
pub(crate) fn corners_of_input(tree: &Bvh<'_>) -> impl Iterator<Item = [f64; 3]> {
    let (low, high) = tree.grid_bounds();
    let unit = exp2(tree.header().grid_exponent + tree.scale_exponent());
    let error = f64::from(tree.surface_error());
    (0..8u32).map(move |corner| {
        let mut point = [0.0; 3];
        let sides = low.to_array().into_iter().zip(high.to_array());
        for ((axis, slot), (low, high)) in (0u32..).zip(&mut point).zip(sides) {
            // Both products are exact.
            *slot = if corner >> axis & 1 == 0 {
                f64::from(low) * unit - error
            } else {
                f64::from(high) * unit + error
            };
        }
        point
    })
}

/// Least and greatest coordinates of points.
pub(crate) fn bounds_of(points: impl Iterator<Item = [f64; 3]>) -> [[f64; 3]; 2] {
    points.fold([[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]], |[mut low, mut high], point| {
        for ((low, high), x) in low.iter_mut().zip(&mut high).zip(point) {
            *low = lesser(*low, x);
            *high = greater(*high, x);
        }
        [low, high]
    })
}
