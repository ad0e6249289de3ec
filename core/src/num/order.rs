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

/// One of eight numbers, `pick` being [`lesser`] or [`greater`]: in three steps, so that a vector
/// target takes whole registers.
#[inline(always)]
pub fn of_eight<T>([a, b, c, d, e, f, g, h]: [T; 8], pick: impl Fn(T, T) -> T) -> T {
    pick(pick(pick(a, e), pick(b, f)), pick(pick(c, g), pick(d, h)))
}
