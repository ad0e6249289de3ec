//! From a point to whole units of the field.

use super::format::Sdf;
use crate::num::{each, greater, lesser};
use crate::query::QueryError;

/// A point farther than this many units from the field's origin is refused: its square, times
/// three, is an f32.
const FARTHEST: f32 = (1u64 << 60) as f32;

/// Whether each coordinate is below a size.
#[inline(always)]
pub(super) fn are_below([x, y, z]: [u32; 3], [width, depth, height]: [u32; 3]) -> bool {
    x < width && y < depth && z < height
}

impl Sdf<'_> {
    /// Whole units nearest to a point of the field: within half a unit along each axis, and a
    /// sixteenth for rounding. A difference and a product lose at most two parts in 2^24 of fewer
    /// than 2^19 units.
    ///
    /// `None` of a point outside. Also of -0 units, of a point -0 at an origin of 0 or of a small
    /// negative offset that underflows: the path beyond the field answers it.
    #[inline(always)]
    pub(crate) fn within_field(&self, point: [f32; 3]) -> Option<[u32; 3]> {
        let units @ [x, y, z] = self.unrounded(point);
        // The bits of numbers that are not negative rise with the numbers. Those of negative ones
        // and of NaN are above those of any number.
        if !are_below(each(units, f32::to_bits), self.ends) {
            return None;
        }
        Some([x as u32, y as u32, z as u32])
    }

    /// The point in units from the origin, f32. Truncation rounds it to the nearest unit from
    /// corner 0.
    #[inline(always)]
    fn unrounded(&self, [x, y, z]: [f32; 3]) -> [f32; 3] {
        let [a, b, c] = self.origin;
        [(x - a) * self.per_unit, (y - b) * self.per_unit, (z - c) * self.per_unit]
    }

    /// The nearest place of the field, and how far along each axis the point is beyond it, units:
    /// below 0 on the lower side.
    #[cold]
    #[inline(never)]
    pub(super) fn beyond(
        &self,
        point @ [x, y, z]: [f32; 3],
    ) -> Result<([u32; 3], [f32; 3]), QueryError> {
        if !point.iter().all(|x| x.is_finite()) {
            return Err(QueryError::NotFinite);
        }
        let [a, b, c] = self.origin;
        // A difference of halves does not overflow.
        let units = |x: f32, a: f32| (0.5 * x - 0.5 * a) * self.per_unit * 2.0;
        let units = [units(x, a), units(y, b), units(z, c)];
        if units.iter().any(|x| x.abs() > FARTHEST) {
            return Err(QueryError::OutOfDomain);
        }
        let ([x, y, z], [width, depth, height]) = (units, self.units());
        let clamped = |x: f32, size: u32| (x as u32).min(size.wrapping_sub(1));
        let beyond = |x: f32, size: u32| lesser(x, greater(x - size as f32, 0.0));
        Ok((
            [clamped(x, width), clamped(y, depth), clamped(z, height)],
            [beyond(x, width), beyond(y, depth), beyond(z, height)],
        ))
    }

    /// Whole units nearest to a point, for [`distance_in_units`](Self::distance_in_units): within
    /// 9/16 of a unit along each axis. Units count from corner 0 of the first cell, of a tree
    /// the first root cell.
    ///
    /// Firmware without floating point computes its points in units from the start; this function
    /// shows how they lie.
    ///
    /// # Errors
    /// [`QueryError::NotFinite`]; [`QueryError::OutOfDomain`] outside of the field.
    pub fn units_of(&self, point: [f32; 3]) -> Result<[i32; 3], QueryError> {
        match self.within_field(point) {
            Some(whole) => Ok(each(whole, u32::cast_signed)),
            // The refusal of a point that is not finite.
            None => self.beyond(point).and(Err(QueryError::OutOfDomain)),
        }
    }
}
