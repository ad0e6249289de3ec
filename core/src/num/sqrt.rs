//! A square root of additions and products.
//!
//! The root of `libm` is exact. It costs a Cortex-M4F some hundred instructions. On x86-64 it is an
//! SSE instruction between AVX ones, which stalls (measured: a tenth of a microsecond a query). For
//! a bound, two units of rounding do not matter.

use super::real::{exponent, mantissa, packed, rounded_product};
use super::tolerance::{GUESS_UP, ROOT_UP, SQUARE_FLOOR, U32};
use super::{Real, SOFT_FLOAT};

/// Square root of `x ≥ 0`, off by less than 2 units of f32 relative; 0 for 0, infinity for
/// infinity.
///
/// Newton's iteration for the reciprocal root from the well-known guess by bits (relative error
/// below 0.035, then 0.002, 5e-6, rounding), and one correction of the root itself. On targets
/// without vectors it is a call, to save code.
#[cfg_attr(meshsweep_wide, inline(always))]
#[cfg_attr(not(meshsweep_wide), inline(never))]
pub fn sqrt_approx(x: f32) -> f32 {
    const SMALL: f32 = 1.0 / (1u64 << 60) as f32;
    const UP: f32 = (1u128 << 64) as f32;
    const DOWN: f32 = 1.0 / (1u64 << 32) as f32;
    if Real(x).is_at_most_zero() {
        return 0.0;
    }
    if Real(x) > Real(f32::MAX) {
        return x;
    }
    let is_small = Real(x) < Real(SMALL);
    let (x, down) = if is_small { (scaled(x, UP), DOWN) } else { (x, 1.0) };
    let y = if SOFT_FLOAT { reciprocal_in_integers(x) } else { reciprocal(x) };
    let (x, y) = (Real(x), Real(y));
    let root = x * y;
    let root = root + (x - root * root) * y.times_power(0.5);
    if SOFT_FLOAT && !is_small { root.0 } else { scaled(root.0, down) }
}

/// `x` times a power of two. Without an FPU it is a call: else every number is multiplied.
#[cfg_attr(meshsweep_soft_float, cold, inline(never))]
#[cfg_attr(not(meshsweep_soft_float), inline(always))]
fn scaled(x: f32, power: f32) -> f32 {
    x * power
}

/// The guess of the reciprocal root, by bits.
#[inline(always)]
fn guess(x: f32) -> u32 {
    0x5F37_59DF_u32.wrapping_sub(x.to_bits() >> 1)
}

#[inline(always)]
fn reciprocal(x: f32) -> f32 {
    let half = 0.5 * x;
    let mut y = f32::from_bits(guess(x));
    y = y * (1.5 - half * y * y);
    y = y * (1.5 - half * y * y);
    y = y * (1.5 - half * y * y);
    y
}

/// [`reciprocal`] of a normal number, the same bits. Half of it times y times y is near one half.
#[inline(never)]
fn reciprocal_in_integers(x: f32) -> f32 {
    let half = mantissa(x.to_bits());
    // Twice the exponent of y, and that of half of x, are no more than these apart.
    let of_half = exponent(x.to_bits()).wrapping_sub(1).wrapping_sub(2 * 127);
    let y = guess(x);
    let (mut y, mut of_y) = (mantissa(y), exponent(y));
    for _ in 0..3 {
        let (first, carry) = normal_product(half, y);
        let (second, carry_2) = normal_product(first, y);
        // 2^-24 of a half, if the number is 1/2 or more; else half of that.
        let of_number = of_half.wrapping_add(2 * of_y).wrapping_add(carry + carry_2);
        let quarter = second >> 8 << (of_number.wrapping_sub(125) & 1);
        let rest = (3 << 24) - quarter;
        // In units of 2^-25. The last bit of a number from 1 on is 2^-23, below 2^-24.
        let cut = if rest >= 1 << 25 { 2 } else { 1 };
        let tie = rest & ((1 << cut) - 1) == 1 << (cut - 1);
        let mut whole = (rest + (1 << (cut - 1))) >> cut;
        if tie {
            whole &= !1;
        }
        let (whole, of_rest) = normal((whole, cut - 1));
        let (product, carry) = normal_product(y, whole);
        y = product;
        of_y = of_y.wrapping_add(of_rest + carry).wrapping_sub(1);
    }
    packed(0, of_y, y >> 8)
}

#[cfg_attr(meshsweep_small, inline(never))]
#[cfg_attr(not(meshsweep_small), inline(always))]
fn normal_product(x: u32, y: u32) -> (u32, u32) {
    normal(rounded_product(x, y))
}

/// A mantissa of 24 bits, or 2^24, to the upper 24 bits, and the exponent with it.
#[inline(always)]
fn normal((whole, exponent): (u32, u32)) -> (u32, u32) {
    if whole >> 24 == 0 { (whole << 8, exponent) } else { (1 << 31, exponent + 1) }
}

/// Upper bounds of the square roots of 0 ≤ `x` ≤ 2^60, at most 2^-15 of them and 2^-49 too large.
/// Several at once become a vector.
///
/// Two steps of the same iteration: they end below the reciprocal root, by less than 6e-6 of it.
#[inline(always)]
pub fn sqrt_up<const N: usize>(x: [f32; N]) -> [f32; N] {
    let x = x.map(|x| Real(x) + Real(SQUARE_FLOOR));
    let mut y = x.map(|x| Real(f32::from_bits(0x5F37_59DF_u32.wrapping_sub(x.0.to_bits() >> 1))));
    for _ in 0..2 {
        for (y, x) in y.iter_mut().zip(&x) {
            *y = *y * (Real(1.5) - Real(0.5) * *x * *y * *y);
        }
    }
    for (y, x) in y.iter_mut().zip(&x) {
        *y = *x * *y * Real(ROOT_UP);
    }
    y.map(|root| root.0)
}

/// An upper bound of the square root of 0 ≤ `x` ≤ 2^60, at most 0.076 of it and 2^-49 too large: the
/// guess by bits alone.
#[inline(always)]
pub fn sqrt_above(x: f32) -> f32 {
    let x = Real(x) + Real(SQUARE_FLOOR);
    (x * Real(f32::from_bits(guess(x.0))) * Real(GUESS_UP)).0
}

/// A lower bound of the square root of 0 ≤ `x` < 2^127, at most 0.0021 of it too small, and less of
/// a square below f32's normal range: one step of Newton's iteration.
#[inline(always)]
pub fn sqrt_below(x: f32) -> f32 {
    let (x, y) = (Real(x), Real(f32::from_bits(guess(x))));
    let y = y * (Real(1.5) - Real(0.5) * x * y * y);
    (x * y * Real(1.0 - 16.0 * U32)).0
}

#[cfg(test)]
mod tests {
    use super::{reciprocal, reciprocal_in_integers, sqrt_above, sqrt_approx, sqrt_below, sqrt_up};

    #[test]
    fn upper_bounds_of_roots_are_not_below_them_and_close() {
        let mut bits = 0u32;
        while f32::from_bits(bits) <= (1u64 << 60) as f32 {
            let x = f32::from_bits(bits);
            let (exact, up) = (libm::sqrt(f64::from(x)), f64::from(sqrt_up([x])[0]));
            assert!(exact <= up && up <= exact * (1.0 + 3.1e-5) + 1.8e-15, "{x:e}: {up:e}");
            let above = f64::from(sqrt_above(x));
            assert!(exact <= above && above <= exact * 1.076 + 1.8e-15, "{x:e}: {above:e}");
            bits += 9_973;
        }
    }

    #[test]
    fn lower_bounds_of_roots_are_not_above_them_and_close() {
        let mut bits = 0u32;
        while bits < (127 + 127) << 23 {
            let x = f32::from_bits(bits);
            let (exact, below) = (libm::sqrt(f64::from(x)), f64::from(sqrt_below(x)));
            assert!(below <= exact, "{x:e}: {below:e}");
            assert!(x < f32::MIN_POSITIVE || below >= exact * (1.0 - 0.0021), "{x:e}: {below:e}");
            bits += 9_973;
        }
    }

    #[test]
    fn a_reciprocal_in_integers_has_the_bits_of_the_one_in_f32() {
        for bits in 1f32.to_bits()..4f32.to_bits() {
            let x = f32::from_bits(bits);
            assert_eq!(reciprocal_in_integers(x).to_bits(), reciprocal(x).to_bits(), "{x:e}");
        }
        let mut bits = (1.0 / (1u64 << 60) as f32).to_bits();
        while bits < f32::INFINITY.to_bits() {
            let x = f32::from_bits(bits);
            assert_eq!(reciprocal_in_integers(x).to_bits(), reciprocal(x).to_bits(), "{x:e}");
            bits += 997;
        }
    }

    #[test]
    fn roots_are_within_two_units_over_all_of_f32() {
        let mut bits = 1u32;
        while bits < f32::INFINITY.to_bits() {
            let x = f32::from_bits(bits);
            let exact = libm::sqrt(f64::from(x));
            let error = (f64::from(sqrt_approx(x)) - exact).abs() / exact;
            assert!(error <= 2.0 * f64::from(f32::EPSILON) / 2.0, "{x:e}: {error:e}");
            bits += 9_973;
        }
        assert_eq!(sqrt_approx(0.0), 0.0);
        assert_eq!(sqrt_approx(f32::INFINITY), f32::INFINITY);
    }

    /// Two binades stand for all: a power of four scales the root exactly.
    #[test]
    fn roots_never_fall_where_squares_rise() {
        let mut last = 0.0;
        for bits in 1f32.to_bits()..=4f32.to_bits() {
            let root = sqrt_approx(f32::from_bits(bits));
            assert!(root >= last, "{:e}", f32::from_bits(bits));
            last = root;
        }
        let mut bits = 1u32;
        while bits < f32::INFINITY.to_bits() {
            let [x, next] = [bits, bits + 1].map(f32::from_bits);
            assert!(sqrt_approx(x) <= sqrt_approx(next), "{x:e}");
            bits += 9_973;
        }
    }
}
