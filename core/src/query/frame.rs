//! Conversion between input units and the local frame, for the structures whose queries compute in
//! f64. The two differ by a power of two.

use super::error::QueryError;
use crate::format::Header;
use crate::geom::Aabb;
use crate::num::tolerance::{F32_BOUNDS, HULL_FAR, U64};
use crate::num::{down_to_f32, exp2, up_to_f32};
use glam::{DVec3, Vec3};

/// Conversion of one model's frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    scale: f64,
    inverse: f64,
    surface_error: f64,
}

impl Frame {
    pub(crate) fn of(header: &Header) -> Self {
        let exponent = header.scale_exponent;
        Frame {
            scale: exp2(exponent),
            inverse: exp2(-exponent),
            surface_error: f64::from(header.surface_error),
        }
    }

    /// The same conversion with another surface error, local frame.
    pub(crate) fn with_surface_error(self, surface_error: f64) -> Self {
        Frame { surface_error, ..self }
    }

    /// A query coordinate in the local frame, exactly: f32 times a power of two fits an f64.
    pub(crate) fn local(&self, point: [f32; 3]) -> Result<DVec3, QueryError> {
        if !point.iter().all(|x| x.is_finite()) {
            return Err(QueryError::NotFinite);
        }
        Ok(Vec3::from_array(point).as_dvec3() * self.inverse)
    }

    /// An end of a segment in the local frame.
    pub(crate) fn local_end(&self, point: [f32; 3]) -> Result<DVec3, QueryError> {
        let local = self.local(point)?;
        if local.abs().max_element() > HULL_FAR { Err(QueryError::OutOfDomain) } else { Ok(local) }
    }

    /// Whether f32 tells that a segment misses a box of the local frame. Most do, and on boards f64
    /// costs ten times as much. `false` of ends that are far away, or not finite.
    #[cfg_attr(meshsweep_wide, inline(always))]
    #[cfg_attr(not(meshsweep_wide), inline(never))]
    pub(crate) fn is_missed(&self, ends: [[f32; 3]; 2], bounds: &Aabb) -> bool {
        let inverse = self.inverse as f32;
        let [start, end] = ends.map(|point| Vec3::from_array(point) * inverse);
        let is_near =
            |local: Vec3| local.to_array().into_iter().all(|x| x.abs() <= F32_BOUNDS as f32);
        inverse.is_normal() && is_near(start) && is_near(end) && bounds.is_missed(start, end)
    }

    /// A point in input units, rounded to nearest, kept finite.
    pub(crate) fn point(&self, local: DVec3) -> [f32; 3] {
        (local * self.scale).to_array().map(|x| (x as f32).clamp(-f32::MAX, f32::MAX))
    }

    /// Lower bound of the distance to the input surface, input units, from a lower bound of the
    /// distance to the stored surface.
    pub(crate) fn lower(&self, local: f64) -> f32 {
        let bound = (local - self.surface_error) * self.scale;
        down_to_f32((bound - 2.0 * U64 * bound.abs()).max(0.0))
    }

    /// Upper bound of the distance to the input surface, input units, from an upper bound of the
    /// distance to the stored surface.
    pub(crate) fn upper(&self, local: f64) -> f32 {
        let bound = (local + self.surface_error) * self.scale;
        up_to_f32(bound + 2.0 * U64 * bound.abs())
    }

    /// Bound of the distance of stored and input surface, local frame.
    pub(crate) fn surface_error(&self) -> f64 {
        self.surface_error
    }

    /// A length in input units. Exact but below f64's normal range.
    pub(crate) fn input_length(&self, local: f64) -> f64 {
        local * self.scale
    }

    /// A length in the local frame.
    pub(crate) fn length(&self, input: f32) -> f64 {
        f64::from(input) * self.inverse
    }
}
