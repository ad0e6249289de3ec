//! The interval at a place of a lattice, in integers.
//!
//! Codes have 8 bits. Interpolation along x and then y adds 11 bits each and loses nothing: 30
//! bits. Along z the difference first drops its last 11 bits, so that the product fits 32. The
//! upper 18 bits, ten of them below a code, are multiplied by the step. All shifts round down, so
//! the value is at most [`value_loss`](super::format::layout::value_loss) units too small. The
//! builder adds these to the errors above.

use super::format::Sdf;
use super::format::layout::{BOOK, CELL_UNITS, FRACTION_BITS, VALUE_BITS};
use crate::num::{each, greater};
use crate::query::QueryError;

/// Bits of a gradient below 1.
pub(super) const SLOPE_BITS: u32 = 15;

/// A cell and a place in it.
struct Corners {
    /// Codes by z, by y, by x.
    rows: [[[i32; 2]; 2]; 2],
    /// Number of the cell.
    cell: u32,
    /// The place in the cell, units along each axis.
    place: [i32; 3],
}

impl Corners {
    /// The codes on the cell's lower and upper side along z, interpolated: 30 bits, 22 of them
    /// below a code.
    #[inline(always)]
    fn layers(&self) -> [i32; 2] {
        let [a, b, _] = self.place;
        both(self.rows, |rows| lerp(both(rows, |row| lerp(row, a)), b))
    }

    /// How codes rise along each axis at the place, with 22 bits below a code.
    #[inline(always)]
    fn differences(&self) -> [i32; 3] {
        let [a, b, c] = self.place;
        let rise = |[s, t]: [i32; 2]| t.wrapping_sub(s);
        let along_x = both(self.rows, |rows| lerp(both(rows, rise), b));
        let along_y = both(self.rows, |rows| rise(both(rows, |row| lerp(row, a))));
        [lerp(along_x, c), lerp(along_y, c), rise(self.layers())]
    }
}

#[inline(always)]
fn both<T, U>([s, t]: [T; 2], f: impl Fn(T) -> U) -> [U; 2] {
    [f(s), f(t)]
}

/// Codes at both ends of a cell's edge along x.
#[inline(always)]
fn pair(codes: &[u8], at: usize) -> Option<[i32; 2]> {
    let [s, t] = *codes.get(at..)?.first_chunk::<2>()?;
    Some([i32::from(s), i32::from(t)])
}

/// Number of a place's cell along an axis, and the place within it.
#[inline(always)]
fn split(units: u32) -> (u32, i32) {
    (units >> FRACTION_BITS, (units & (CELL_UNITS.unsigned_abs() - 1)).cast_signed())
}

/// From `s` to `t` at `place` of 2048, times 2048.
#[inline(always)]
fn lerp([s, t]: [i32; 2], place: i32) -> i32 {
    (s << FRACTION_BITS).wrapping_add(t.wrapping_sub(s).wrapping_mul(place))
}

impl Sdf<'_> {
    /// Lower and upper bound of the distance at a place of a lattice, units.
    #[inline(always)]
    pub(super) fn value(&self, place: [u32; 3]) -> Result<[i32; 2], QueryError> {
        self.bounds_at(place).ok_or(QueryError::Unchecked)
    }

    #[inline(always)]
    fn bounds_at(&self, place: [u32; 3]) -> Option<[i32; 2]> {
        self.interval_at(&self.corners(place)?)
    }

    /// The bounds and the gradient, in 2^-15.
    #[inline(always)]
    pub(super) fn value_and_slopes(
        &self,
        place: [u32; 3],
    ) -> Result<([i32; 2], [i32; 3]), QueryError> {
        let corners = self.corners(place).ok_or(QueryError::Unchecked)?;
        let bounds = self.interval_at(&corners).ok_or(QueryError::Unchecked)?;
        Ok((bounds, self.slopes_at(&corners)))
    }

    #[inline(always)]
    fn interval_at(&self, corners: &Corners) -> Option<[i32; 2]> {
        let ([low, high], [_, _, c]) = (corners.layers(), corners.place);
        let value = low.wrapping_add((high.wrapping_sub(low) >> FRACTION_BITS).wrapping_mul(c));
        let steps = (value >> (2 * FRACTION_BITS - VALUE_BITS)).wrapping_mul(self.step);
        let distance = self.base.wrapping_add(steps >> VALUE_BITS);
        let errors = *self.errors.get(corners.cell as usize)?;
        let below = u16::from_le_bytes(*self.books.get(usize::from(errors & 15))?);
        let above = u16::from_le_bytes(*self.books.get(usize::from(errors >> 4) | BOOK)?);
        Some([
            greater(distance.wrapping_sub(i32::from(below)), self.least),
            greater(distance.wrapping_add(i32::from(above)), self.least),
        ])
    }

    #[inline(always)]
    fn corners(&self, [x, y, z]: [u32; 3]) -> Option<Corners> {
        let ((x, a), (y, b), (z, c)) = (split(x), split(y), split(z));
        let (row, layer) = (self.row, self.layer);
        let at = x.wrapping_add(y.wrapping_mul(row)).wrapping_add(z.wrapping_mul(layer));
        let cells =
            y.wrapping_mul(row.wrapping_sub(1)).wrapping_add(z.wrapping_mul(self.cell_layer));
        let (row, layer) = (row as usize, layer as usize);
        let codes = self.codes.get(at as usize..)?;
        Some(Corners {
            rows: [
                [pair(codes, 0)?, pair(codes, row)?],
                [pair(codes, layer)?, pair(codes, layer.wrapping_add(row))?],
            ],
            cell: x.wrapping_add(cells),
            place: [a, b, c],
        })
    }

    /// The gradient of the trilinear function at a place, in 2^-15: about 1 in length where the
    /// distance is nearly linear in the cell.
    #[inline(always)]
    pub(super) fn slopes(&self, place: [u32; 3]) -> Result<[i32; 3], QueryError> {
        Ok(self.slopes_at(&self.corners(place).ok_or(QueryError::Unchecked)?))
    }

    #[inline(always)]
    fn slopes_at(&self, corners: &Corners) -> [i32; 3] {
        // One code along a cell is a step in 2048 units. Differences have 22 bits below the code.
        let slope = |difference: i32| {
            let steps = (difference >> (2 * FRACTION_BITS - VALUE_BITS)).wrapping_mul(self.step);
            steps >> (VALUE_BITS + FRACTION_BITS - SLOPE_BITS)
        };
        each(corners.differences(), slope)
    }
}
