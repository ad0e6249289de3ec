//! Squared limits in integers, and lower bounds that are compared with them.
//!
//! Proof: `core/docs/rounding.md` §8, "Whole numbers".

use crate::num::bit_length as bits;

/// A squared limit, square grid units: `mantissa · 2^exponent`.
#[derive(Clone, Copy, Debug)]
pub struct IntLimit {
    /// 15 bits, or 2^15.
    mantissa: u32,
    exponent: i32,
}

impl IntLimit {
    /// Nothing is beyond it.
    pub const NONE: IntLimit = IntLimit { mantissa: 1 << 15, exponent: 128 };

    /// `square` or a little more, for a positive number. Nothing is beyond an infinite one.
    #[inline(always)]
    pub fn of(square: f32) -> IntLimit {
        let bits = square.to_bits();
        // The upper 15 bits of 24, rounded up.
        IntLimit {
            mantissa: ((bits & 0x007F_FFFF | 0x0080_0000) >> 9) + 1,
            exponent: (bits >> 23).cast_signed() - 127 - 14,
        }
    }
}

impl IntLimit {
    /// The root of the limit times a number, rounded up; no more than `i32::MAX`. The number is not
    /// negative.
    pub fn root_of_product(&self, number: i32) -> i32 {
        let number = number.cast_unsigned();
        let cut = bits(number).saturating_sub(15);
        let exponent = self.exponent + cut.cast_signed();
        // At most 2^31. An odd exponent leaves a two.
        let product = (((number >> cut) + 1) * self.mantissa) << (exponent & 1);
        let root = root_up(product).cast_signed();
        match exponent >> 1 {
            by @ ..0 => (root >> by.wrapping_neg().min(31)) + 1,
            by @ 0..16 => root << by,
            _ => i32::MAX,
        }
    }
}

/// The square root of a positive number below 2^32, rounded up, or at most 0.0005 of it more.
///
/// Two of Newton's steps for the reciprocal root of its upper 16 bits, from a line that is off by a
/// tenth. They end below it, by less than 2^-12 of it.
fn root_up(x: u32) -> u32 {
    let half = (32 - bits(x)) >> 1;
    // A fourth of 2^16 or more.
    let part = (x << (2 * half)) >> 16;
    let mut inverse = 34_520 - ((part * 19_450) >> 16);
    for _ in 0..2 {
        let square = (inverse * inverse) >> 14;
        inverse = (inverse * ((3 << 14) - ((square * part) >> 16))) >> 15;
    }
    let root = ((part + 1) * (inverse + (inverse >> 12))) >> 14;
    (root >> half) + 1
}

/// A lower bound of the distance of a point and a triangle: by a plane across a direction.
#[derive(Clone, Copy, Debug)]
pub struct IntLower {
    /// Along the direction the query is at least this far from the triangle, in products of
    /// direction and grid units.
    along: i32,
    /// The square of the direction.
    direction_sq: u32,
}

impl IntLower {
    /// A plane that the query is `along` from, in products of a direction whose square is
    /// `direction_sq`.
    #[inline(always)]
    pub(super) fn new(along: i32, direction_sq: u32) -> IntLower {
        IntLower { along, direction_sq }
    }

    /// Nothing is known.
    pub const NONE: IntLower = IntLower { along: 0, direction_sq: 0 };

    /// Whether the triangle is certainly farther than the root of `limit`.
    #[cfg_attr(meshsweep_small, inline(never))]
    #[cfg_attr(not(meshsweep_small), inline(always))]
    pub fn is_beyond(&self, limit: IntLimit) -> bool {
        if self.along <= 0 {
            return false;
        }
        // along² > direction² · limit, the left side cut to 30 bits, the right side rounded up.
        let along = self.along.cast_unsigned();
        let down = bits(along).saturating_sub(15);
        let left = (along >> down) * (along >> down);
        let cut = bits(self.direction_sq).saturating_sub(15);
        let right = ((self.direction_sq >> cut) + 1) * limit.mantissa;
        let exponent = limit.exponent + cut.cast_signed() - 2 * down.cast_signed();
        let by = exponent.unsigned_abs();
        if exponent >= 0 {
            by < 31 && left >> by > right
        } else {
            by >= 31 || left > (right >> by) + 1
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// No other bits of a number are looked at, but the even number of zeros before them.
    #[test]
    fn a_root_of_sixteen_bits_is_not_below_it_and_close() {
        for part in 1u32 << 14..1 << 16 {
            let root = f64::from(root_up(part << 16));
            let (least, most) = (f64::from(part), f64::from(part + 1));
            assert!(root >= 256.0 * libm::sqrt(most), "{part}");
            assert!(root <= 256.0 * libm::sqrt(least) * 1.000_5, "{part}");
        }
    }

    #[test]
    fn a_root_of_a_product_is_not_below_it_and_close() {
        let mut bits = 1e-6f32.to_bits();
        while bits < 1e12f32.to_bits() {
            let (limit, number) = (f32::from_bits(bits), (bits % 50_000_000).cast_signed());
            let root = f64::from(IntLimit::of(limit).root_of_product(number));
            let exact = libm::sqrt(f64::from(limit) * f64::from(number));
            assert!(root >= exact.min(f64::from(i32::MAX)), "{limit:e} {number}: {root}");
            assert!(root <= exact * 1.001 + 2.0 || exact > 1e9, "{limit:e} {number}: {root}");
            bits += 99_971;
        }
    }
}
