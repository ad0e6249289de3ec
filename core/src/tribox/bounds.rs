//! The eighteen parameters, and the questions that comparisons alone answer.

use super::directions::SLABS;
use crate::num::tolerance::U32;
use crate::num::{sum_down, sum_up};
use core::fmt;

/// The intersection of nine slabs `low ≤ direction · p ≤ high`, see
/// [`DIRECTIONS`](super::DIRECTIONS).
///
/// It holds its points in real arithmetic: sums of coordinates are rounded outward. A tribox of
/// points, unions and [translations](Tribox::translated) is tight up to this rounding: every plane
/// touches the points inside. After [`intersection`](Tribox::intersection) and
/// [`padded`](Tribox::padded) a plane may be idle. [`tightened`](Tribox::tightened) moves it
/// inward.
///
/// Coordinates have to be within [`Tribox::DOMAIN`], so that no sum overflows. The caller chooses
/// unit and frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tribox {
    /// Least values along the directions.
    pub low: [f32; SLABS],
    /// Greatest values along the directions.
    pub high: [f32; SLABS],
}

/// Why a tribox could not be made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum TriboxError {
    /// A coordinate is NaN or infinite.
    NotFinite,
    /// A coordinate is beyond [`Tribox::DOMAIN`].
    OutOfDomain,
}

impl fmt::Display for TriboxError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            TriboxError::NotFinite => "a coordinate is not a finite number",
            TriboxError::OutOfDomain => "a coordinate is beyond 2^120",
        })
    }
}

impl core::error::Error for TriboxError {}

/// A point's values along the directions, rounded down and rounded up.
#[inline(always)]
pub(crate) fn projections([x, y, z]: [f32; 3]) -> ([f32; SLABS], [f32; SLABS]) {
    let sums = [(x, y), (x, -y), (y, z), (y, -z), (z, x), (z, -x)];
    let [a, b, c, d, e, f] = sums.map(|(a, b)| sum_down(a, b));
    let low = [x, y, z, a, b, c, d, e, f];
    let [a, b, c, d, e, f] = sums.map(|(a, b)| sum_up(a, b));
    (low, [x, y, z, a, b, c, d, e, f])
}

/// The point, if it is finite and within the domain.
#[inline(always)]
pub(crate) fn checked(point: [f32; 3]) -> Result<[f32; 3], TriboxError> {
    let [x, y, z] = point.map(f32::abs);
    if !(x.is_finite() & y.is_finite() & z.is_finite()) {
        return Err(TriboxError::NotFinite);
    }
    let inside = (x <= Tribox::DOMAIN) & (y <= Tribox::DOMAIN) & (z <= Tribox::DOMAIN);
    if inside { Ok(point) } else { Err(TriboxError::OutOfDomain) }
}

impl Tribox {
    /// The empty tribox.
    pub const EMPTY: Tribox =
        Tribox { low: [f32::INFINITY; SLABS], high: [f32::NEG_INFINITY; SLABS] };

    /// Largest coordinate: 2^120.
    pub const DOMAIN: f32 = (1u128 << 120) as f32;

    /// The tribox of one point: a point, or as small as rounding allows.
    ///
    /// # Errors
    /// If a coordinate is not finite or beyond [`Tribox::DOMAIN`].
    pub fn of_point(point: [f32; 3]) -> Result<Tribox, TriboxError> {
        let (low, high) = projections(checked(point)?);
        Ok(Tribox { low, high })
    }

    /// The least tribox of all points; [`Tribox::EMPTY`] of none. Cost: 18 comparisons and 6 exact
    /// sums a point.
    ///
    /// # Errors
    /// As [`of_point`](Tribox::of_point), for the first point that is refused.
    pub fn of_points(points: impl IntoIterator<Item = [f32; 3]>) -> Result<Tribox, TriboxError> {
        points
            .into_iter()
            .try_fold(Tribox::EMPTY, |all, point| Ok(all.union(&Tribox::of_point(point)?)))
    }

    /// Whether a slab is empty: a proof that no point is inside. Other contradictions between
    /// parameters are found by [`tightened`](Tribox::tightened).
    pub fn is_empty(&self) -> bool {
        self.slabs().any(|(low, high)| low > high)
    }

    /// Least and greatest value along each direction.
    #[inline(always)]
    pub fn slabs(&self) -> impl Iterator<Item = (f32, f32)> + '_ {
        self.low.iter().copied().zip(self.high.iter().copied())
    }

    /// The least tribox of both. With an empty one it is the other.
    #[inline]
    #[must_use]
    pub fn union(&self, other: &Tribox) -> Tribox {
        Tribox { low: least(&self.low, &other.low), high: greatest(&self.high, &other.high) }
    }

    /// The exact intersection. Parameters may then be idle; see [`tightened`](Tribox::tightened).
    #[inline]
    #[must_use]
    pub fn intersection(&self, other: &Tribox) -> Tribox {
        Tribox { low: greatest(&self.low, &other.low), high: least(&self.high, &other.high) }
    }

    /// Whether the slabs of both overlap, in one frame. `false` is a proof that they have no common
    /// point.
    ///
    /// `true` is no proof, for the intersection may be [empty](Tribox::tightened) although all nine
    /// slabs overlap. Touching counts as overlapping; an empty tribox overlaps none. Cost: at
    /// most 18 comparisons, three times a box's.
    #[inline]
    #[must_use]
    pub fn overlaps(&self, other: &Tribox) -> bool {
        self.slabs()
            .zip(other.slabs())
            .all(|((low, high), (other_low, other_high))| (low <= other_high) & (other_low <= high))
    }

    /// Whether all of `other` is inside, by its parameters. An empty one is. Exact if `other` is
    /// tight.
    #[inline]
    #[must_use]
    pub fn contains(&self, other: &Tribox) -> bool {
        other.is_empty()
            || self.slabs().zip(other.slabs()).all(|((low, high), (other_low, other_high))| {
                (low <= other_low) & (other_high <= high)
            })
    }

    /// Whether a point may be inside. `false` is a proof that it is not, and is always given
    /// outside if f32 holds the point's sums. Otherwise `true` is possible up to one unit of
    /// rounding beyond a diagonal plane. `false` for NaN.
    #[inline]
    #[must_use]
    pub fn contains_point(&self, point: [f32; 3]) -> bool {
        let (low, high) = projections(point);
        self.slabs()
            .zip(low.into_iter().zip(high))
            .all(|((from, to), (low, high))| (from <= high) & (low <= to))
    }

    /// The tribox moved by `by`, rounded outward. Exact if f32 holds the sums.
    ///
    /// # Errors
    /// If a coordinate of `by`, or of the result, is not finite or beyond [`Tribox::DOMAIN`].
    pub fn translated(&self, by: [f32; 3]) -> Result<Tribox, TriboxError> {
        if self.is_empty() {
            checked(by)?;
            return Ok(Tribox::EMPTY);
        }
        let (low, high) = projections(checked(by)?);
        let mut moved = *self;
        moved.low.iter_mut().zip(low).for_each(|(value, by)| *value = sum_down(*value, by));
        moved.high.iter_mut().zip(high).for_each(|(value, by)| *value = sum_up(*value, by));
        let [x, y, z, ..] = moved.low;
        checked([x, y, z])?;
        let [x, y, z, ..] = moved.high;
        checked([x, y, z])?;
        Ok(moved)
    }

    /// A tribox that holds every point within `distance ≥ 0` of this one: planes move outward by
    /// it, rounded outward. An empty one stays empty.
    ///
    /// # Errors
    /// If `distance` is negative, not finite or beyond [`Tribox::DOMAIN`].
    pub fn padded(&self, distance: f32) -> Result<Tribox, TriboxError> {
        checked([distance; 3])?;
        if distance < 0.0 {
            return Err(TriboxError::OutOfDomain);
        }
        if self.is_empty() {
            return Ok(Tribox::EMPTY);
        }
        // Two roundings, and the constant is below √2.
        let diagonal = distance * (core::f32::consts::SQRT_2 * (1.0 + 4.0 * U32));
        // Below f32's normal range roundings are not relative.
        let diagonal = if diagonal > 0.0 && diagonal < f32::MIN_POSITIVE {
            diagonal.next_up()
        } else {
            diagonal
        };
        let mut padded = *self;
        let planes = padded.low.iter_mut().zip(padded.high.iter_mut()).enumerate();
        planes.for_each(|(slab, (low, high))| {
            let by = if slab < 3 { distance } else { diagonal };
            (*low, *high) = (sum_down(*low, -by), sum_up(*high, by));
        });
        Ok(padded)
    }
}

#[inline(always)]
fn least(a: &[f32; SLABS], b: &[f32; SLABS]) -> [f32; SLABS] {
    let mut least = *a;
    least.iter_mut().zip(b).for_each(|(a, b)| *a = if b < a { *b } else { *a });
    least
}

#[inline(always)]
fn greatest(a: &[f32; SLABS], b: &[f32; SLABS]) -> [f32; SLABS] {
    let mut greatest = *a;
    greatest.iter_mut().zip(b).for_each(|(a, b)| *a = if b > a { *b } else { *a });
    greatest
}
