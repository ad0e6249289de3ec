//! From f64 to f32 without losing a bound, and exact powers of two.

/// The greatest f32 that is not above `x`. It is `f32::MAX` where `x` exceeds f32's range, so that
/// a finite lower bound stays finite.
///
/// NaN gives NaN. Cost: one conversion, one comparison.
pub fn down_to_f32(x: f64) -> f32 {
    let nearest = x as f32;
    if f64::from(nearest) <= x { nearest } else { nearest.next_down() }
}

/// The least f32 that is not below `x`. It is infinite where `x` exceeds f32's range.
pub fn up_to_f32(x: f64) -> f32 {
    let nearest = x as f32;
    if f64::from(nearest) >= x { nearest } else { nearest.next_up() }
}

/// `2^exponent` exactly, for `-1022 ≤ exponent ≤ 1023`. Exponents outside are clamped to that
/// range.
pub fn exp2(exponent: i32) -> f64 {
    let clamped = exponent.clamp(-1022, 1023);
    f64::from_bits(u64::from((clamped + 1023).unsigned_abs()) << 52)
}

/// `2^exponent` exactly, for `-126 ≤ exponent ≤ 127`.
#[inline(always)]
pub(crate) const fn exp2_f32(exponent: i32) -> f32 {
    f32::from_bits((127 + exponent).cast_unsigned() << 23)
}

/// `a + b` and its rounding error, exactly (Knuth, TAOCP 4.2.2). Both numbers and the sum must be
/// finite.
#[inline(always)]
pub fn two_sum(a: f32, b: f32) -> (f32, f32) {
    let sum = a + b;
    let b_part = sum - a;
    (sum, (a - (sum - b_part)) + (b - b_part))
}

/// The greatest f32 that is not above `a + b`.
#[inline(always)]
pub fn sum_down(a: f32, b: f32) -> f32 {
    let (sum, rest) = two_sum(a, b);
    if rest < 0.0 { sum.next_down() } else { sum }
}

/// The least f32 that is not below `a + b`.
#[inline(always)]
pub fn sum_up(a: f32, b: f32) -> f32 {
    let (sum, rest) = two_sum(a, b);
    if rest > 0.0 { sum.next_up() } else { sum }
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
    fn sums_are_rounded_to_the_neighbours_of_the_exact_sum() {
        for (a, b) in [
            (1.0, 1e-9),
            (1.0, -1e-9),
            (16_777_216.0, 1.0),
            (0.1, 0.2),
            (-1e30, 1e-30),
            (0.5, 0.25),
            (1e-45, 1e-45),
        ] {
            let exact = f64::from(a) + f64::from(b);
            let (down, up) = (sum_down(a, b), sum_up(a, b));
            assert!(f64::from(down) <= exact && exact <= f64::from(up), "{a} + {b}");
            assert!(up == down || up == down.next_up(), "{a} + {b}");
        }
    }

    #[test]
    fn exp2_is_exact() {
        assert_eq!(exp2(0), 1.0);
        assert_eq!(exp2(-3), 0.125);
        assert_eq!(exp2(200), 2f64.powi(200));
    }
}
