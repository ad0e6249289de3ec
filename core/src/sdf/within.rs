//! Whether the surface is within a distance of a point: the distance asked about becomes whole
//! units, and the bounds of a look-up never become f32.

use super::format::{Sdf, SdfKind, SdfLayout};
use crate::num::lesser;
use crate::query::{Interval, QueryError, Undecided, Verdict};

/// Longer distances are asked about as this one, units: no bound of a field is as large.
const MOST_ASKED: i32 = 1 << 30;

/// A distance of 2^20 units may be off by one unit: the unit and a product lose less than a
/// quarter of that.
const OFF_BITS: u32 = 20;

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
    /// or ends within two units and 2^-20 of it. For collision avoidance, treat undecided as `Yes`.
    ///
    /// Cost: about that of [`distance`](Self::distance).
    ///
    /// # Errors
    /// Those of [`distance`](Self::distance); [`QueryError::Tolerance`] if `distance` is negative,
    /// NaN or infinite.
    #[inline(never)]
    pub fn within(&self, point: [f32; 3], distance: f32) -> Result<Verdict, QueryError> {
        if !(distance >= 0.0 && distance.is_finite()) {
            return Err(QueryError::Tolerance);
        }
        match self.within_field(point) {
            Some(place) => self.told(&place, distance, Near::Any).ok_or(QueryError::Unchecked),
            None => self.within_from_beyond(point, distance),
        }
    }

    /// Whether the surface is within a distance of a place, as the field tells it. The distance is
    /// finite and not negative. `None` only of bytes that were not checked.
    #[inline(never)]
    pub(crate) fn told(&self, &place: &[u32; 3], distance: f32, near: Near) -> Option<Verdict> {
        let asked = lesser((distance * self.per_unit) as i32, MOST_ASKED);
        let bounds = match self.layout {
            SdfLayout::Lattice => self.value(place),
            SdfLayout::Tree => self.tree_bounds(self.root_within(place), place),
        };
        Some(self.decided(bounds.ok()?, asked, near))
    }

    /// Compares bounds with a distance whose whole units are `asked`. The bounds are those of the
    /// nearest place: those of the point are a unit wider on each side.
    ///
    /// The distance is above `asked` − `off` − 1/4 and below `asked` + 1 + `off` + 1/4, for it was
    /// cut to whole units. So with the unit of the place both comparisons have 3/4 of a unit to
    /// spare.
    #[inline(always)]
    fn decided(&self, [lower, upper]: [i32; 2], asked: i32, near: Near) -> Verdict {
        let off = asked >> OFF_BITS;
        let (below, above) =
            (asked.wrapping_sub(1).wrapping_sub(off), asked.wrapping_add(2).wrapping_add(off));
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

    /// Whether the surface, or the solid, is within a distance of a point beyond the field. The
    /// distance is finite and not negative.
    #[cold]
    #[inline(never)]
    pub(crate) fn within_from_beyond(
        &self,
        point: [f32; 3],
        distance: f32,
    ) -> Result<Verdict, QueryError> {
        let Interval { lower, upper } = self.distance_beyond(point)?.distance;
        Ok(if lower > distance || upper < -distance {
            Verdict::No
        } else if upper <= distance && lower >= -distance {
            Verdict::Yes
        } else {
            Verdict::Undecided(Undecided::Resolution)
        })
    }
}
