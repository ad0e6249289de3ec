//! Vectors of whole numbers of 32 bits.

/// A vector of whole numbers.
pub type IntVector = [i32; 3];

#[inline(always)]
pub(super) fn largest([x, y, z]: IntVector) -> u32 {
    x.unsigned_abs().max(y.unsigned_abs()).max(z.unsigned_abs())
}

/// A number with as many bits as the largest component without its sign: of a negative one that is
/// its complement.
#[inline(always)]
pub(super) fn as_long_as([x, y, z]: IntVector) -> u32 {
    ((x ^ x >> 31) | (y ^ y >> 31) | (z ^ z >> 31)).cast_unsigned()
}

#[inline(always)]
pub(super) fn dot([a, b, c]: IntVector, [x, y, z]: IntVector) -> i32 {
    a.wrapping_mul(x).wrapping_add(b.wrapping_mul(y)).wrapping_add(c.wrapping_mul(z))
}

/// The difference. It wraps around.
#[inline(always)]
pub fn less([a, b, c]: IntVector, [x, y, z]: IntVector) -> IntVector {
    [a.wrapping_sub(x), b.wrapping_sub(y), c.wrapping_sub(z)]
}

#[inline(always)]
pub(super) fn norm_1([x, y, z]: IntVector) -> i32 {
    x.abs() + y.abs() + z.abs()
}
