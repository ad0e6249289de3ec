//! The target's own arithmetic, before any of the core's: a canary.
//!
//! If an image differs from the host in these blocks too, then the compiler, its runtime library or
//! the machine computes another `+ − × ÷ √` (flushed subnormals, a fused multiply-add, a sloppy
//! software float), and the core is not to blame.

use crate::{fold::Fold, rng::Rng};

/// Folds the results of one chain of operations on numbers of all magnitudes, subnormal ones among
/// them.
///
/// No result is a NaN: IEEE 754 leaves a NaN's payload to the machine, so it is folded as one fixed
/// word.
pub fn chain(rng: &mut Rng, fold: &mut Fold) {
    let (a, b) = (any_finite_f32(rng), any_finite_f32(rng));
    let c = subnormal_f32(rng);
    for value in [
        a + b,
        a - b,
        a * b,
        a / b,
        b / a,
        a * c,
        c - b,
        c + c * 0.5,
        c / 3.0,
        a * 1.0e-30 * 1.0e-12,
    ] {
        f32_or_nan(fold, value);
    }
    // Would round differently if the product and the sum became one operation.
    f32_or_nan(fold, a * b + c * a + b * b);
    f32_or_nan(fold, libm::sqrtf(a.abs()));
    f32_or_nan(fold, libm::sqrtf(c.abs()));
    f32_or_nan(fold, libm::sqrtf(a * a + b * b));

    let (d, e) = (f64::from(a), any_finite_f64(rng));
    let s = f64::from_bits(rng.next_u64() >> 12);
    for value in [
        d + e,
        d - e,
        d * e,
        d / e,
        e / d,
        s * d,
        s + s * 0.5,
        s / 3.0,
        libm::sqrt(e.abs()),
        libm::sqrt(s),
    ] {
        f64_or_nan(fold, value);
    }
    // Narrowing rounds; it meets the subnormal f32 numbers from above.
    f32_or_nan(fold, (d * 0.1) as f32);
    f32_or_nan(fold, (f64::from(c) * 0.7) as f32);
    f32_or_nan(fold, e as f32);
    // Comparisons and conversions that saturate.
    fold.word(
        u32::from(a < b) | u32::from(a <= b) << 1 | u32::from(d > e) << 2 | u32::from(c > 0.0) << 3,
    );
    fold.word(a as u32);
    fold.word((b as i32).cast_unsigned());
    f32_or_nan(fold, rng.next_u32() as f32);
    f32_or_nan(fold, rng.next_u64() as f32);
}

fn any_finite_f32(rng: &mut Rng) -> f32 {
    let bits = rng.next_u32();
    // The all-ones exponent (infinity, NaN) loses its lowest bit.
    f32::from_bits(if bits & 0x7f80_0000 == 0x7f80_0000 { bits & !0x0080_0000 } else { bits })
}

fn any_finite_f64(rng: &mut Rng) -> f64 {
    const EXPONENT: u64 = 0x7ff0_0000_0000_0000;
    let bits = rng.next_u64();
    f64::from_bits(if bits & EXPONENT == EXPONENT { bits & !0x0010_0000_0000_0000 } else { bits })
}

fn subnormal_f32(rng: &mut Rng) -> f32 {
    f32::from_bits(rng.next_u32() & 0x807f_ffff)
}

fn f32_or_nan(fold: &mut Fold, value: f32) {
    if value.is_nan() { fold.word(0x7fc0_0000) } else { fold.f32(value) }
}

fn f64_or_nan(fold: &mut Fold, value: f64) {
    if value.is_nan() { fold.word(0x7ff8_0000) } else { fold.f64(value) }
}
