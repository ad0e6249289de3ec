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
    /// Whether they are f32, and not integers of 16 bits from the origin.
    pub(super) is_f32: bool,
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

    /// The vertices' places before storing, grid units.
    pub(super) fn places(&self, mesh: &Mesh) -> Vec<DVec3> {
        let step = exp2(self.exponent);
        local(mesh, self.scale_exponent).map(|p| p / step).collect()
    }

    /// The same grid with other vertices.
    pub(super) fn with_positions(&self, input: Input<'_>, positions: Vec<DVec3>) -> Self {
        let step = exp2(self.exponent);
        let error = (self.places(input.mesh).into_iter().zip(&positions))
            .fold(0f64, |error, (place, &stored)| error.max(distance(stored, place, step)));
        let (surface_error, moved) = errors(error, input, self.scale_exponent);
        Self { positions, surface_error, moved, ..self.clone() }
    }
}

/// The vertices in the local frame.
fn local(mesh: &Mesh, scale_exponent: i32) -> impl Iterator<Item = DVec3> {
    let wide = |&[x, y, z]: &[f32; 3]| DVec3::new(f64::from(x), f64::from(y), f64::from(z));
    mesh.positions.iter().map(wide).map(move |p| p * exp2(-scale_exponent))
}

/// Distance of two points in grid units, local frame, rounded up.
fn distance(stored: DVec3, place: DVec3, step: f64) -> f64 {
    (stored - place).length() * step * (1.0 + 1e-15)
}

/// The surface error, and the part of it that storing added.
fn errors(added: f64, input: Input<'_>, scale_exponent: i32) -> (f64, f64) {
    let before = input.error() * exp2(-scale_exponent);
    // Room for its rounding to f32 in a query (`core/docs/rounding.md` §9).
    ((added + before) * (1.0 + 1e-6), added * (1.0 + 1e-6))
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
    let local: Vec<DVec3> = local(mesh, scale).collect();
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
            error = error.max(distance(stored, units, step));
            stored
        })
        .collect();
    let (surface_error, moved) = errors(error, input, scale);
    OnGrid {
        scale_exponent: scale,
        exponent,
        origin,
        positions,
        is_f32: single,
        surface_error,
        moved,
    }
}
