//! The lesser and the greater of two numbers, by one instruction where the target has one.
//! `f32::min` and `f32::max` spend more on NaN. Of two equal numbers the first is taken: −0 and 0
//! are equal. A second number that is NaN is not taken.

/// The lesser of two numbers.
#[inline(always)]
pub fn lesser<T: PartialOrd>(a: T, b: T) -> T {
    if b < a { b } else { a }
}

/// The greater of two numbers.
#[inline(always)]
pub fn greater<T: PartialOrd>(a: T, b: T) -> T {
    if b > a { b } else { a }
}
