//! From f64 to f32 without losing a bound, and exact powers of two.

/// The greatest f32 that is not above `x`; `f32::MAX` where `x` exceeds it, so that a finite lower bound stays finite.
///
/// NaN gives NaN. Cost: one conversion, one comparison.
pub fn down_to_f32(x: f64) -> f32 {
    let nearest = x as f32;
    if f64::from(nearest) <= x { nearest } else { nearest.next_down() }
}

/// The least f32 that is not below `x`; infinity where none is.
pub fn up_to_f32(x: f64) -> f32 {
    let nearest = x as f32;
    if f64::from(nearest) >= x { nearest } else { nearest.next_up() }
}

/// `2^exponent` exactly, for `-1022 ≤ exponent ≤ 1023`; exponents outside are clamped to that range.
pub fn exp2(exponent: i32) -> f64 {
    let clamped = exponent.clamp(-1022, 1023);
    f64::from_bits(u64::from((clamped + 1023).unsigned_abs()) << 52)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directed_rounding_brackets_the_value() {
        for x in [0.0, 1.0 + 1e-9, -1.0 - 1e-9, 1e-46, -1e-46, 1e39, 3.4e38, f64::from(f32::MAX)] {
            assert!(f64::from(down_to_f32(x)) <= x && x <= f64::from(up_to_f32(x)), "{x}");
        }
        assert_eq!(down_to_f32(1e39), f32::MAX);
        assert_eq!(up_to_f32(1e39), f32::INFINITY);
        assert_eq!(down_to_f32(0.5).to_bits(), 0.5f32.to_bits());
    }

    #[test]
    fn exp2_is_exact() {
        assert_eq!(exp2(0), 1.0);
        assert_eq!(exp2(-3), 0.125);
        assert_eq!(exp2(200), 2f64.powi(200));
    }
}
