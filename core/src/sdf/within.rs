//! Whether the surface is within a distance of a point: the distance asked about becomes whole
//! units, and the bounds of a look-up never become f32.

use super::format::{Sdf, SdfKind, SdfLayout};
use crate::query::{Interval, QueryError, Undecided, Verdict};

/// From this many units on, the bounds are compared in f32. Fewer are rounded by at most a quarter
/// of a unit: the unit and a product lose less than 2^-22 of them.
const MOST_ASKED: f32 = (1u32 << 20) as f32;

/// What must be within the distance.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Near {
    /// What the field's distances are to: of kind [`Solid`](SdfKind::Solid) the solid.
    Any,
    /// The surface. A field of kind solid tells of points outside alone.
    Surface,
}

impl Sdf<'_> {
    /// Whether the surface is at most `distance` from `point`, both in input units. Of a field of
    /// kind [`Solid`](SdfKind::Solid) whether the solid is: a point inside is never `No`. Of the
    /// others a point deep inside is `No`, for the sign is not looked at: a guard takes a field of
    /// kind solid.
    ///
    /// Undecided for [`Resolution`](Undecided::Resolution) if the interval of
    /// [`distance`](Self::distance) holds lengths on both sides of `distance`, without their sign,
    /// or ends within two units of it. For collision avoidance, treat undecided as `Yes`.
    ///
    /// Cost: less than that of [`distance`](Self::distance), for the bounds stay integers.
    ///
    /// # Errors
    /// Those of [`distance`](Self::distance); [`QueryError::Tolerance`] if `distance` is negative,
    /// NaN or infinite.
    #[inline(never)]
    pub fn within(&self, point: [f32; 3], distance: f32) -> Result<Verdict, QueryError> {
        if !(distance >= 0.0 && distance.is_finite()) {
            return Err(QueryError::Tolerance);
        }
        match self.told(point, distance, Near::Any) {
            Some(verdict) => Ok(verdict),
            None => self.within_from_beyond(point, distance),
        }
    }

    /// Whether the surface is within a distance, as the field tells it; `None` of a point beyond
    /// the field, or one that is not finite, and of a distance of very many units. The distance is
    /// finite and not negative.
    #[inline(never)]
    pub(crate) fn told(&self, point: [f32; 3], distance: f32, near: Near) -> Option<Verdict> {
        let place = self.within_field(point)?;
        let asked = distance * self.per_unit;
        if asked >= MOST_ASKED {
            return None;
        }
        let asked = asked as i32;
        let bounds = match self.layout {
            SdfLayout::Lattice => self.value(place),
            SdfLayout::Tree => self.tree_bounds(self.root_within(place), place),
        };
        Some(self.decided(bounds.ok()?, asked, near))
    }

    /// Compares bounds of the nearest place, which are a unit off, with a distance whose whole
    /// units are `asked`.
    #[inline(always)]
    fn decided(&self, [lower, upper]: [i32; 2], asked: i32, near: Near) -> Verdict {
        let (below, above) = (asked.wrapping_sub(1), asked.wrapping_add(2));
        let is_solid = near == Near::Surface && self.kind == SdfKind::Solid;
        let least = if is_solid { 1 } else { below.wrapping_neg() };
        if lower > above || upper < above.wrapping_neg() {
            Verdict::No
        } else if upper < below && lower > least {
            Verdict::Yes
        } else {
            Verdict::Undecided(Undecided::Resolution)
        }
    }

    #[cold]
    #[inline(never)]
    fn within_from_beyond(&self, point: [f32; 3], distance: f32) -> Result<Verdict, QueryError> {
        let Interval { lower, upper } = self.distance(point)?.distance;
        Ok(if lower > distance || upper < -distance {
            Verdict::No
        } else if upper <= distance && lower >= -distance {
            Verdict::Yes
        } else {
            Verdict::Undecided(Undecided::Resolution)
        })
    }
}
