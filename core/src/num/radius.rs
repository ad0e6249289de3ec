//! Radii stored in one or two bytes, rounded up.
//!
//! Both are the top bits of an f32, so that decoding is a shift: no table, no multiplication.

/// A radius in two bytes: sign, exponent and seven bits of mantissa of an f32, rounded up (at most
/// 0.8 % too large).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Radius16(pub u16);

impl Radius16 {
    /// The least stored radius not below `x ≥ 0`; infinity where `x` exceeds f32's range.
    pub fn round_up(x: f64) -> Self {
        Self::round_up_f32(super::up_to_f32(x))
    }

    /// The same of an f32.
    #[inline(always)]
    pub fn round_up_f32(x: f32) -> Self {
        let up = x.to_bits().saturating_add(0xFFFF) >> 16;
        Radius16(up.min(0x7F80) as u16)
    }

    /// The stored radius.
    #[inline(always)]
    pub fn get(self) -> f32 {
        f32::from_bits(u32::from(self.0) << 16)
    }
}

/// A radius in one byte: five bits of exponent and three of mantissa, rounded up (at most 12.5 %
/// too large).
///
/// 0 is exactly zero, 1 to 254 run from 2^-29 to 3.5, 255 is infinity. In the blob's local frame
/// the mesh lies within one unit of the origin, so that the range covers everything from a
/// ten-millionth of the part to the part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Radius8(pub u8);

/// Top twelve bits of the f32 2^-29, less one: code 1 decodes to 2^-29.
const BIAS: u32 = ((127 - 29) << 3) - 1;

impl Radius8 {
    /// The code of infinity.
    pub const INFINITE: Self = Radius8(255);

    /// The least stored radius not below `x ≥ 0`.
    pub fn round_up(x: f64) -> Self {
        if x <= 0.0 {
            return Radius8(0);
        }
        let bits = super::up_to_f32(x).to_bits();
        let up = bits.saturating_add((1 << 20) - 1) >> 20;
        Radius8(up.saturating_sub(BIAS).clamp(1, 255) as u8)
    }

    /// The stored radius.
    #[inline]
    pub fn get(self) -> f32 {
        match self.0 {
            0 => 0.0,
            255 => f32::INFINITY,
            code => f32::from_bits((u32::from(code) + BIAS) << 20),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stored_radii_never_shrink_and_stay_close() {
        let mut x = 1e-8f64;
        while x < 3.0 {
            let (r8, r16) =
                (f64::from(Radius8::round_up(x).get()), f64::from(Radius16::round_up(x).get()));
            assert!(r8 >= x && r8 <= x * 1.1251, "{x} {r8}");
            assert!(r16 >= x && r16 <= x * 1.0079, "{x} {r16}");
            x *= 1.000_37;
        }
        assert_eq!(Radius8::round_up(0.0).get(), 0.0);
        assert_eq!(Radius16::round_up(0.0).get(), 0.0);
        assert!(Radius8::round_up(1e-30).get() > 0.0);
        assert_eq!(Radius8::round_up(100.0).get(), f32::INFINITY);
        assert_eq!(Radius16::round_up(1e39).get(), f32::INFINITY);
    }

    #[test]
    fn every_code_is_a_fixed_point_of_rounding_up() {
        for code in 0..=255u8 {
            let radius = Radius8(code);
            assert_eq!(Radius8::round_up(f64::from(radius.get())), radius);
        }
    }
}
