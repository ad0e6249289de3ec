//! The questions of the distance field in input units.

use super::format::{Sdf, SdfKind, SdfLayout};
use super::units::UnitDistance;
use super::value::SLOPE_BITS;
use crate::num::{each, greater, lesser, sqrt_approx};
use crate::query::{Interval, QueryError, Side, Undecided};

/// Bounds of the distance of a point.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct FieldDistance {
    /// The distance to the input mesh, input units: of the kind that [`Sdf::kind`] tells.
    pub distance: Interval,
    /// The side of the point, where the interval tells it.
    pub side: Side,
}

/// Units that a distance may change while a point goes to the nearest place: half a unit and a
/// sixteenth along each axis are less than 1.
const PLACE: i32 = 1;

/// The same of a point outside: its place may be a unit within the field, and how far beyond the
/// field it is, is known to 9/16 of a unit. Both along three axes: less than 2.71. No upper end is
/// smaller, so a mesh that stands half a unit above the field is always within it.
const BEYOND: f32 = 3.0;

/// Part of a length that is lost in f32: the unit and two products.
const ROUNDED: f32 = 4.0 * f32::EPSILON;

/// Part of the length of a vector beyond the field that is lost in f32: its entries, their squares,
/// two sums, the root.
const ROUNDED_BEYOND: f32 = 8.0 * f32::EPSILON;

/// One of a gradient's component, 2^-15.
const SLOPE: f32 = 1.0 / (1u32 << SLOPE_BITS) as f32;

impl Sdf<'_> {
    /// Bounds of the distance of `point` (input units), and its side.
    ///
    /// The interval contains the distance to the input mesh in real arithmetic, of the field's
    /// [`kind`](Sdf::kind): signed distances are negative inside, and the distance to a solid is 0
    /// inside. If the side of a point of a signed field is not certain, the interval contains the
    /// distance with both signs. Side: `Outside` if the lower end is above 0, `Inside` if the upper
    /// end is below 0; else undecided for [`OnSurface`](Undecided::OnSurface), also far from the
    /// surface where the winding number is neither 0 nor 1. A field of kind
    /// [`Solid`](SdfKind::Solid) never says `Inside`. One of kind [`Surface`](SdfKind::Surface)
    /// tells no side: [`OpenMesh`](Undecided::OpenMesh).
    ///
    /// Outside of the field, let e be the distance from the field, and a to b the interval at the
    /// nearest place of it. The interval is √(e² + a²) to e + b, from e if a is below 0. Its upper
    /// end may be infinite.
    ///
    /// Cost: one look-up, the same for every point of a lattice, and [`steps`](Sdf::steps) entries
    /// at most of a tree; no scratch memory. Without
    /// floating point the conversions cost several times the look-up:
    /// [`distance_in_units`](Self::distance_in_units) needs none. Source: no paper; the module's
    /// text tells why cells have errors of their own.
    ///
    /// # Errors
    /// [`QueryError::NotFinite`]; [`QueryError::OutOfDomain`] farther than 2^60 units along an axis
    /// from the field's least corner.
    #[inline(never)]
    pub fn distance(&self, point: [f32; 3]) -> Result<FieldDistance, QueryError> {
        let Some(place) = self.within_field(point) else { return self.distance_beyond(point) };
        match self.layout {
            SdfLayout::Lattice => Ok(self.answer(self.in_input_units(self.value(place)?))),
            SdfLayout::Tree => self.distance_of_tree(place),
        }
    }

    #[inline(never)]
    fn distance_of_tree(&self, place: [u32; 3]) -> Result<FieldDistance, QueryError> {
        let bounds = self.tree_bounds(self.root_within(place), place)?;
        Ok(self.answer(self.in_input_units(bounds)))
    }

    #[cold]
    #[inline(never)]
    pub(crate) fn distance_beyond(&self, point: [f32; 3]) -> Result<FieldDistance, QueryError> {
        let (place, beyond) = self.beyond(point)?;
        let bounds = match self.layout {
            SdfLayout::Lattice => self.value(place)?,
            SdfLayout::Tree => {
                let place = each(place, u32::cast_signed);
                let UnitDistance { lower, upper } = self.distance_of_tree_in_units(&place)?;
                [lower, upper]
            }
        };
        Ok(self.answer(self.outside_field(bounds_beyond(bounds, beyond))))
    }

    /// [`distance`](Self::distance), and the gradient at the point: the direction in which the
    /// distance rises the most, of a length near 1.
    ///
    /// The gradient is that of the cell's function. It jumps between cells and carries no
    /// guarantee: use it as a direction, of a force or of a step. It is short, or zero, where
    /// nearest points lie on opposite sides, and means nothing inside of a field of kind
    /// [`Solid`](SdfKind::Solid). Outside of the field it leads from about the nearest point of the
    /// surface to `point`, with length 1 at most.
    ///
    /// Cost: a quarter more than [`distance`](Self::distance) on a Cortex-M4F (*historical*).
    ///
    /// # Errors
    /// Those of [`distance`](Self::distance).
    #[inline(never)]
    pub fn distance_and_gradient(
        &self,
        point: [f32; 3],
    ) -> Result<(FieldDistance, [f32; 3]), QueryError> {
        let Some(place) = self.within_field(point) else {
            return self.distance_and_gradient_beyond(point);
        };
        match self.layout {
            SdfLayout::Lattice => {
                let (bounds, gradient) = self.value_and_slopes(place)?;
                Ok((self.answer(self.in_input_units(bounds)), as_gradient(gradient)))
            }
            SdfLayout::Tree => self.distance_and_gradient_of_tree(place),
        }
    }

    #[inline(never)]
    fn distance_and_gradient_of_tree(
        &self,
        place: [u32; 3],
    ) -> Result<(FieldDistance, [f32; 3]), QueryError> {
        let (bounds, gradient) = self.tree_bounds_and_slopes(self.root_within(place), place)?;
        Ok((self.answer(self.in_input_units(bounds)), as_gradient(gradient)))
    }

    #[cold]
    #[inline(never)]
    fn distance_and_gradient_beyond(
        &self,
        point: [f32; 3],
    ) -> Result<(FieldDistance, [f32; 3]), QueryError> {
        let (place, beyond) = self.beyond(point)?;
        let (bounds @ [_, far], gradient) = match self.layout {
            SdfLayout::Lattice => self.value_and_slopes(place)?,
            SdfLayout::Tree => self.tree_bounds_and_slopes(self.root_within(place), place)?,
        };
        let found = self.answer(self.outside_field(bounds_beyond(bounds, beyond)));
        Ok((found, away(beyond, far as f32, as_gradient(gradient))))
    }

    /// Bounds of the distance in input units, from those at the nearest place. `Sdf::open` made
    /// sure that no product overflows.
    #[inline(always)]
    fn in_input_units(&self, [lower, upper]: [i32; 2]) -> [f32; 2] {
        let lower = lower.wrapping_sub(PLACE) as f32 * self.unit;
        let upper = upper.wrapping_add(PLACE) as f32 * self.unit;
        [lower - lower.abs() * ROUNDED, upper + upper.abs() * ROUNDED]
    }

    /// The same from bounds outside of the field, which are not below -3 units.
    #[inline(always)]
    fn outside_field(&self, [lower, upper]: [f32; 2]) -> [f32; 2] {
        let (lower, upper) = (lesser(lower * self.unit, f32::MAX), upper * self.unit);
        [lower - lower.abs() * ROUNDED, upper + upper * ROUNDED]
    }

    #[inline(always)]
    fn answer(&self, [lower, upper]: [f32; 2]) -> FieldDistance {
        let lower = if self.kind == SdfKind::Signed { lower } else { greater(0.0, lower) };
        FieldDistance { distance: Interval { lower, upper }, side: self.side(lower, upper) }
    }

    #[inline(always)]
    fn side(&self, lower: f32, upper: f32) -> Side {
        if self.kind == SdfKind::Surface {
            Side::Undecided(Undecided::OpenMesh)
        } else if lower > 0.0 {
            Side::Outside
        } else if upper < 0.0 {
            Side::Inside
        } else {
            Side::Undecided(Undecided::OnSurface)
        }
    }
}

#[inline(always)]
fn as_gradient(slopes: [i32; 3]) -> [f32; 3] {
    each(slopes, |slope| slope as f32 * SLOPE)
}

/// Bounds of the distance of a point outside of the field, from those at the nearest place of the
/// field and from how far it is beyond.
///
/// The mesh lies in the field, and the field is convex. So at the nearest place the directions to
/// the point and to any point of the mesh are a right angle or more apart: the squared distance is
/// at least the sum of both squares. The distance is at most the sum of both.
#[cold]
#[inline(never)]
fn bounds_beyond([lower, upper]: [i32; 2], [x, y, z]: [f32; 3]) -> [f32; 2] {
    // Outside of the field no distance is negative.
    let [near, upper] = [lower.max(0) as f32, upper.max(0) as f32];
    let square = x * x + y * y + z * z;
    let [far, way] = [sqrt_approx(square + near * near), sqrt_approx(square)];
    [far - (far * ROUNDED_BEYOND + BEYOND), way + (upper + (way * ROUNDED_BEYOND + BEYOND))]
}

/// The direction from a surface that lies `far` below the nearest place of the field along its
/// gradient, to a point that is so far beyond that place.
#[cold]
#[inline(never)]
fn away(beyond: [f32; 3], far: f32, [a, b, c]: [f32; 3]) -> [f32; 3] {
    let [x, y, z] = beyond;
    let [x, y, z] = [x + far * a, y + far * b, z + far * c];
    let length = greater(sqrt_approx(x * x + y * y + z * z), 1.0);
    [x / length, y / length, z / length]
}
