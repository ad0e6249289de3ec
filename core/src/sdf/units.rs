//! The questions of the distance field in whole units, for processors without floating point.

use super::format::layout::MOST_BASE;
use super::format::{Sdf, SdfLayout};
use super::place::are_below;
use crate::num::each;
use crate::query::QueryError;

/// Bounds of the distance of a place, in units of the field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct UnitDistance {
    /// Not above the distance.
    pub lower: i32,
    /// Not below the distance.
    pub upper: i32,
}

impl Sdf<'_> {
    /// Bounds of the distance of a place, both in [units](Sdf::unit). Places count from corner 0 of
    /// the field, half a unit above [`bounds`](Sdf::bounds)`()[0]` along each axis.
    ///
    /// The bounds hold of the place itself: if a point was rounded to it, add a unit on each side.
    /// The distances mean the same as those of [`distance`](Sdf::distance), and no rounding of f32
    /// is added. Of a field of kind signed a place is outside if `lower` is above 0, and inside if
    /// `upper` is below 0; of kind solid only outside is told.
    ///
    /// Outside of the field, `lower` is the greater of two bounds: that of the field's nearest
    /// place, less 2, and the largest distance of a coordinate from that place's, less 1. `upper`
    /// is that of the nearest place, at least 0, plus the sum of the coordinates' distances from
    /// it.
    ///
    /// Cost: one look-up in integers, the same for every place of a lattice, and
    /// [`steps`](Sdf::steps) entries at most of a tree; no scratch memory.
    ///
    /// # Errors
    /// [`QueryError::OutOfDomain`] if a coordinate is beyond 2^28.
    #[inline(never)]
    pub fn distance_in_units(&self, place: [i32; 3]) -> Result<UnitDistance, QueryError> {
        let whole = each(place, i32::cast_unsigned);
        if are_below(whole, self.lattice) {
            let [lower, upper] = self.value(whole)?;
            return Ok(UnitDistance { lower, upper });
        }
        match self.layout {
            SdfLayout::Lattice => self.distance_beyond_in_units(&place),
            SdfLayout::Tree => self.distance_of_tree_in_units(&place),
        }
    }

    #[cold]
    #[inline(never)]
    fn distance_beyond_in_units(&self, place: &[i32; 3]) -> Result<UnitDistance, QueryError> {
        let (nearest, beyond) = nearest(place, self.lattice)?;
        Ok(outside(self.value(nearest)?, beyond))
    }

    /// The distance of any place of a tree.
    #[inline(never)]
    pub(super) fn distance_of_tree_in_units(
        &self,
        place: &[i32; 3],
    ) -> Result<UnitDistance, QueryError> {
        let whole = each(*place, i32::cast_unsigned);
        let (root, whole, beyond) = match self.root(whole) {
            Some(root) => (root, whole, [0; 2]),
            None => {
                let (nearest, beyond) = nearest(place, self.units())?;
                (self.root(nearest).ok_or(QueryError::Unchecked)?, nearest, beyond)
            }
        };
        let bounds @ [lower, upper] = self.tree_bounds(root, whole)?;
        let [_, sum] = beyond;
        Ok(if sum == 0 { UnitDistance { lower, upper } } else { outside(bounds, beyond) })
    }

    /// The gradient at a place, 32,768 for 1: the direction in which the distance rises the most.
    /// See [`distance_and_gradient`](Sdf::distance_and_gradient). Outside of the field there is
    /// none.
    ///
    /// Cost: about that of [`distance_in_units`](Self::distance_in_units).
    ///
    /// # Errors
    /// [`QueryError::OutOfDomain`] outside of the field.
    #[inline(never)]
    pub fn gradient_in_units(&self, place: [i32; 3]) -> Result<[i32; 3], QueryError> {
        let whole = each(place, i32::cast_unsigned);
        if are_below(whole, self.lattice) {
            return self.slopes(whole);
        }
        match self.root(whole) {
            Some(root) if self.layout == SdfLayout::Tree => {
                Ok(self.tree_bounds_and_slopes(root, whole)?.1)
            }
            _ => Err(QueryError::OutOfDomain),
        }
    }
}

/// The nearest place of a field of so many units, and how far the place is beyond: the greatest of
/// the coordinates' distances, and their sum.
#[inline(always)]
fn nearest(place: &[i32; 3], units: [u32; 3]) -> Result<([u32; 3], [i32; 2]), QueryError> {
    let (mut nearest, mut greatest, mut sum) = ([0; 3], 0, 0);
    for ((near, &at), units) in nearest.iter_mut().zip(place).zip(units) {
        if at.unsigned_abs() > MOST_BASE.unsigned_abs() {
            return Err(QueryError::OutOfDomain);
        }
        let last = units.wrapping_sub(1).cast_signed();
        let within = at.max(0).min(last);
        let beyond = at.wrapping_sub(within).wrapping_abs();
        *near = within.cast_unsigned();
        greatest = beyond.max(greatest);
        sum = beyond.wrapping_add(sum);
    }
    Ok((nearest, [greatest, sum]))
}

/// Bounds of the distance of a place outside of the field, from those at the nearest place of it.
///
/// Outside of the field no distance is negative. The nearest place may be a unit within the field
/// along each axis: a diagonal below 2.
#[inline(always)]
fn outside([lower, upper]: [i32; 2], [greatest, sum]: [i32; 2]) -> UnitDistance {
    let lower = lower.wrapping_sub(2).max(greatest.wrapping_sub(1));
    UnitDistance { lower, upper: upper.max(0).wrapping_add(sum) }
}
