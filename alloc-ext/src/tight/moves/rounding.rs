//! Rounding to the coordinates in which a hull is stored.

use crate::surface::Grid;
use glam::DVec3;
use meshsweep_core::internal::num::exp2;

/// Rounding of points in the mesh's own frame to a grid of the local frame, or to single precision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rounding {
    grid: Grid,
    /// Mesh coordinate = local coordinate × 2^this.
    exponent: i32,
}

impl Rounding {
    pub fn new(grid: Grid, exponent: i32) -> Self {
        Self { grid, exponent }
    }

    /// The nearest stored point, an `f32` in the mesh's frame; `None` where there is none.
    pub fn round(&self, p: DVec3) -> Option<DVec3> {
        // Below the least normal f32, numbers are farther apart in the mesh's frame than in the
        // local frame.
        let single = p.as_vec3().as_dvec3();
        let stored = self.grid.round(single * exp2(-self.exponent))? * exp2(self.exponent);
        (stored.is_finite() && stored == stored.as_vec3().as_dvec3()).then_some(stored)
    }

    /// Largest distance from a coordinate of magnitude `size` to the nearest stored one.
    pub fn half_step(&self, size: f64) -> f64 {
        let local = self.grid.half_step(size * exp2(-self.exponent)) * exp2(self.exponent);
        local.max(f64::from(f32::from_bits(1)))
    }
}
