//! About the closest point of a triangle, in integers of 32 bits: its weights.

use super::integer_vector::{IntVector, as_long_as, dot};
use crate::num::{bit_length as bits, each};

/// Bits of a barycentric weight.
pub(super) const WEIGHT_BITS: u32 = 12;
/// The weight of a whole.
pub(super) const ONE: i32 = 1 << WEIGHT_BITS;

/// Weights of the second and third corner at a point near the closest one, of twelve bits;
/// their sum is at most one. Regions after Ericson, *Real-Time Collision Detection* (2005), 5.1.5.
#[inline(always)]
pub(super) fn weights(s: IntVector, e: IntVector, g: IntVector) -> (i32, i32) {
    // Products of 14 bits and 15 bits have a sum below 2^31.
    let size = bits(as_long_as(e) | as_long_as(g));
    let down = size.saturating_sub(14);
    let (e, g, size) = (each(e, |x| x >> down), each(g, |x| x >> down), size - down);
    let more = (bits(as_long_as(s)) + size).saturating_sub(29);
    let s = each(s, |x| x >> more);
    // The spokes' own products are coarser by the same power.
    let scaled = |x: i32| if more >= down { x >> (more - down) } else { x };
    let along = |x: i32| if more < down { x >> (down - more) } else { x };
    let (d1, d2) = (along(dot(e, s)), along(dot(g, s)));
    if d1 <= 0 && d2 <= 0 {
        return (0, 0);
    }
    let (aa, bb, cc) = (scaled(dot(e, e)), scaled(dot(e, g)), scaled(dot(g, g)));
    if d1 >= aa && d2.wrapping_sub(bb) <= d1 - aa {
        return (ONE, 0);
    }
    if d2 >= cc && d1.wrapping_sub(bb) <= d2 - cc {
        return (0, ONE);
    }
    let cut = bits(as_long_as([d1, d2, aa]) | cc.cast_unsigned()).saturating_sub(13);
    let (d1, d2, aa, bb, cc) = (d1 >> cut, d2 >> cut, aa >> cut, bb >> cut, cc >> cut);
    let (d3, d4, d5, d6) = (d1 - aa, d2 - bb, d1 - bb, d2 - cc);
    let vc = d1.wrapping_mul(d4).wrapping_sub(d3.wrapping_mul(d2));
    let vb = d5.wrapping_mul(d2).wrapping_sub(d1.wrapping_mul(d6));
    let (nv, nw, whole);
    if vc <= 0 && d1 >= 0 && d3 <= 0 {
        (nv, nw, whole) = (d1, 0, aa);
    } else if vb <= 0 && d2 >= 0 && d6 <= 0 {
        (nv, nw, whole) = (0, d2, cc);
    } else {
        let va = d3.wrapping_mul(d6).wrapping_sub(d5.wrapping_mul(d4));
        let (x, y) = (d4 - d3, d5 - d6);
        if va <= 0 && x >= 0 && y >= 0 {
            (nv, nw, whole) = (y, x, x + y);
        } else {
            // Halved, so that their sum stays within 32 bits.
            let [pa, pb, pc] = each([va, vb, vc], |x| x.max(0) >> 1);
            (nv, nw, whole) = (pb, pc, pa + pb + pc);
        }
    }
    // A divisor of 16 bits, so that one reciprocal serves both weights.
    let whole = whole.max(1).cast_unsigned();
    let size = bits(whole);
    let (mut up, cut) = (0, size.saturating_sub(16));
    let inverse = if cfg!(meshsweep_short_products) {
        up = 16u32.saturating_sub(size);
        reciprocal(whole << up >> cut)
    } else {
        (1 << 31) / (whole >> cut).max(1)
    };
    let whole = whole << up >> cut;
    let weight = |x: i32| {
        let x = (x.max(0).cast_unsigned() << up >> cut).min(whole);
        ((x * inverse) >> (31 - WEIGHT_BITS)).cast_signed().min(ONE)
    };
    let v = weight(nv);
    (v, weight(nw).min(ONE - v))
}

/// About 2^31 / `x` of a number of 16 bits, not more than 2^16: a line, and two of Newton's steps.
/// The smallest processors divide ten times as long.
#[inline(always)]
fn reciprocal(x: u32) -> u32 {
    // Of 1 / x between 1/2 and 1 the line 48/17 - 32/17·x is off by a seventeenth at most.
    let about = 92_521 - ((x * 61_681) >> 16);
    let rest = |about: u32| (1u32 << 31).wrapping_sub(x.wrapping_mul(about)).cast_signed();
    let about = about.cast_signed();
    let about = about + ((about * (rest(about.cast_unsigned()) >> 15)) >> 16);
    let about = about + ((about * (rest(about.cast_unsigned()) >> 8)) >> 23);
    about.cast_unsigned().min(1 << 16)
}

#[cfg(test)]
mod tests {
    use super::reciprocal;

    #[test]
    fn a_reciprocal_is_close() {
        for x in 1u32 << 15..1 << 16 {
            let exact = f64::from(1u32 << 31) / f64::from(x);
            let about = f64::from(reciprocal(x));
            assert!((about - exact).abs() < 3.0, "{x}: {about}");
        }
    }
}
