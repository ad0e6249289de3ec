//! A box that holds the vertices of the input mesh.

use crate::bvh::format::Bvh;
use crate::num::tolerance::U32;

/// Corners of the box, input units: those of the stored vertices' box, grown by the surface error and by
/// the rounding of the box.
pub(super) fn corners_of_input(tree: &Bvh<'_>) -> impl Iterator<Item = [f64; 3]> {
    let [low, high] = tree.bounds();
    let error = f64::from(tree.surface_error());
    let grown = move |x: f32| error + f64::from(x).abs() * f64::from(U32);
    (0..8u32).map(move |corner| {
        let mut point = [0.0; 3];
        for ((axis, slot), (low, high)) in (0u32..).zip(&mut point).zip(low.iter().zip(&high)) {
            *slot = if corner >> axis & 1 == 0 {
                f64::from(*low) - grown(*low)
            } else {
                f64::from(*high) + grown(*high)
            };
        }
        point
    })
}
