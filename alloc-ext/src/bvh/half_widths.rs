//! How wide exact answers of a box tree are.

use meshsweep_core::Bvh;
use meshsweep_core::internal::num::exp2;
use meshsweep_core::internal::num::tolerance::{
    CERTIFIED_PART, FAN_DISTANCE, FAN_RELATIVE, LEAST_FAN_ROUNDING, U32,
};

/// The approximate half-width of an exact answer, in the mesh's unit: next to the surface, and one
/// diagonal of the mesh away (`core/docs/rounding.md` §8). Wider where slivers are near.
#[must_use]
pub fn half_widths(tree: &Bvh<'_>, diagonal: f64) -> [f64; 2] {
    let h = tree.header();
    let unit = exp2(h.grid_exponent + tree.scale_exponent());
    let u = f64::from(U32);
    let near = f64::from(tree.surface_error())
        + (f64::from(FAN_DISTANCE) * u * f64::from(h.star_radius))
            .max(f64::from(LEAST_FAN_ROUNDING))
            * unit;
    // Triangles that are no slivers are certified to that fraction of the squared distance. So the
    // distance is certified to half of it: a quarter at either end.
    let relative = f64::from(FAN_RELATIVE) * u + (1.0 - f64::from(CERTIFIED_PART)) / 4.0;
    [near, near + relative * diagonal]
}
