//! The lesser and the greater of two numbers, by one instruction where the target has one.
//! `f32::min` and `f32::max` spend more on NaN. Of two equal numbers the first is taken: −0 and 0
//! are equal. A second number that is NaN is not taken.

use super::SOFT_FLOAT;

/// The lesser of two numbers.
#[inline(always)]
pub fn lesser<T: PartialOrd>(a: T, b: T) -> T {
    if b < a { b } else { a }
}

/// A number above 0, else 0. A comparison costs a board with a float unit four instructions. Of NaN
/// targets differ: a gap that overflows has an infinite limit, so it proves nothing.
#[inline(always)]
pub fn above_zero(x: f32) -> f32 {
    if SOFT_FLOAT || cfg!(meshsweep_wide) { greater(0.0, x) } else { 0.5 * (x + x.abs()) }
}

/// The greater of two numbers.
#[inline(always)]
pub fn greater<T: PartialOrd>(a: T, b: T) -> T {
    if b > a { b } else { a }
}
