//! The tree's grid: vertices in grid units, and how far they moved.

use crate::mesh::{Input, Mesh};
use crate::surface::{scale_exponent, split_exponent};
use glam::DVec3;
use meshsweep_core::internal::num::exp2;

/// A mesh in grid units.
#[derive(Clone, Debug)]
pub(super) struct OnGrid {
    /// Input coordinate = local coordinate × 2^this.
    pub(super) scale_exponent: i32,
    /// Local coordinate = grid coordinate × 2^this.
    pub(super) exponent: i32,
    /// Grid coordinate = stored u16 + origin.
    pub(super) origin: [i32; 3],
    /// Vertices as stored, grid units.
    pub(super) positions: Vec<DVec3>,
    /// Largest distance of a vertex from its place in the input, local frame, rounded up.
    pub(super) surface_error: f64,
    /// The part of it that storing added.
    moved: f64,
}

impl OnGrid {
    /// Whether vertices moved farther than a 32,768th of the longest side.
    pub(super) fn is_coarse(&self) -> bool {
        let fold = |f: fn(DVec3, DVec3) -> DVec3| self.positions.iter().copied().reduce(f);
        let side = match (fold(DVec3::min), fold(DVec3::max)) {
            (Some(low), Some(high)) => (high - low).max_element() * exp2(self.exponent),
            _ => 0.0,
        };
        self.moved > side * MOST_MOVED
    }
}

/// Finest exponent for which every coordinate on the grid is an integer below 2^24. Their sums are
/// exact in f32.
const FINEST: i32 = -24;

/// Most steps of the mesh's longest axis. Vertices are rounded to the nearest step, up or down.
const STEPS: f64 = 65_534.0;

/// Part of the mesh's longest side by which a grid of 16 bits moves vertices at most, where it is
/// not too far from the origin.
const MOST_MOVED: f64 = 1.0 / 32_768.0;

/// Whether the mesh is so far from its origin that the grid moves vertices farther than a 32,768th
/// of its longest side. Then [f32 vertices](super::TreeOptions::with_f32) keep them in their place.
#[must_use]
pub fn is_too_far_for_grid(mesh: &Mesh) -> bool {
    store(mesh.as_input(), false).is_coarse()
}

/// Moves a mesh to the finest power-of-two grid of 16 bits that holds it. With `single`, only its
/// units change.
pub(super) fn store(input: Input<'_>, single: bool) -> OnGrid {
    let mesh = input.mesh;
    let scale = scale_exponent(mesh);
    let local: Vec<DVec3> = mesh
        .positions
        .iter()
        .map(|&[x, y, z]| DVec3::new(f64::from(x), f64::from(y), f64::from(z)) * exp2(-scale))
        .collect();
    let (low, high) = local
        .iter()
        .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(l, h), &p| (l.min(p), h.max(p)));
    let extent = (high - low).max_element();
    let (mantissa, fitting) = split_exponent(extent / STEPS);
    // `split_exponent` gives the power above; a power itself fits as it is.
    let fitting = if mantissa == 0.5 { fitting - 1 } else { fitting };
    let exponent = if extent > 0.0 { fitting.clamp(FINEST, 0) } else { FINEST };
    let step = exp2(exponent);
    let floor = (low / step).floor();
    // Coordinates are below 2^24: the last u16 of that range begins here.
    let origin = [floor.x, floor.y, floor.z].map(|low| (low as i32).min((1 << 24) - 0xFFFF));
    let mut error = 0f64;
    let positions = local
        .iter()
        .map(|&p| {
            let units = p / step;
            let stored = if single { units.as_vec3().as_dvec3() } else { units.round() };
            error = error.max((stored - units).length() * step * (1.0 + 1e-15));
            stored
        })
        .collect();
    let before = input.error() * exp2(-scale);
    OnGrid {
        scale_exponent: scale,
        exponent,
        origin,
        positions,
        // Room for its rounding to f32 in a query (`core/docs/rounding.md` §9).
        surface_error: (error + before) * (1.0 + 1e-6),
        moved: error * (1.0 + 1e-6),
    }
}
