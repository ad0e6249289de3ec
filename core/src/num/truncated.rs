//! Floats to whole numbers of a unit that is a power of two.

/// `x · 2^exponent`, rounded towards 0. `None` if that is 2^30 or more or `x` is not finite, or of
/// a subnormal `x` that may not round to 0.
///
/// A shift: without an FPU a product and a conversion would be two calls.
#[inline(always)]
pub fn truncated(x: f32, exponent: i32) -> Option<i32> {
    let bits = x.to_bits();
    let biased = (bits >> 23 & 0xFF).cast_signed();
    if biased == 0 || biased == 0xFF {
        // A subnormal number is below 2^-126.
        let is_none = bits << 1 == 0 || (biased == 0 && exponent <= 126);
        return if is_none { Some(0) } else { None };
    }
    // The number is a mantissa of 24 bits, shifted by this.
    let shift = biased.wrapping_add(exponent).wrapping_sub(150);
    let mantissa = bits & 0x7F_FFFF | 0x80_0000;
    let size = match shift {
        ..=-24 => 0,
        -23..=-1 => mantissa >> shift.unsigned_abs(),
        0..=6 => mantissa << shift.unsigned_abs(),
        _ => return None,
    };
    let sign = bits.cast_signed() >> 31;
    Some((size.cast_signed() ^ sign).wrapping_sub(sign))
}
