//! On which side of a plane a point lies: a filter in `f64`, then integers.

use num_bigint::BigInt;
use num_traits::Signed;

/// Sign of `(d − a) · ((b − a) × (c − a))`: positive in front of the plane of a counter-clockwise
/// triangle; and whether integers had to decide.
#[must_use]
pub fn side([a, b, c]: [[f64; 3]; 3], d: [f64; 3]) -> (i8, bool) {
    let sub = |p: [f64; 3]| [p[0] - a[0], p[1] - a[1], p[2] - a[2]];
    let (u, v, w) = (sub(b), sub(c), sub(d));
    let minors = [(1, 2), (2, 0), (0, 1)]
        .map(|(i, j)| (u[i] * v[j] - u[j] * v[i], (u[i] * v[j]).abs() + (u[j] * v[i]).abs()));
    let det: f64 = minors.iter().zip(w).map(|(m, x)| m.0 * x).sum();
    let size: f64 = minors.iter().zip(w).map(|(m, x)| m.1 * x.abs()).sum();
    // Six roundings on the longest path, each at most half a unit; twice that to spare. A product
    // that underflows is not trusted.
    if det.abs() > 16.0 * f64::EPSILON * size && size > 1e-250 {
        return (if det > 0.0 { 1 } else { -1 }, false);
    }
    (side_in_integers([a, b, c, d]), true)
}

/// All coordinates as multiples of one power of two.
fn side_in_integers(points: [[f64; 3]; 4]) -> i8 {
    let parts = points.map(|p| p.map(decompose));
    let used = || parts.iter().flatten().filter(|(m, _)| *m != 0);
    let Some(least) = used().map(|(_, e)| *e).min() else { return 0 };
    let bits = used()
        .map(|(m, e)| i64::from(64 - m.unsigned_abs().leading_zeros()) + i64::from(e - least))
        .max();
    // Differences of 39-bit numbers have 40 bits, products of three 120, and six of these fit in
    // 127.
    if bits.unwrap_or(0) <= 39 {
        let at =
            parts.map(|p| p.map(|(m, e)| if m == 0 { 0 } else { i128::from(m) << (e - least) }));
        let [a, b, c, d] = at;
        let sub = |p: [i128; 3]| [p[0] - a[0], p[1] - a[1], p[2] - a[2]];
        let (u, v, w) = (sub(b), sub(c), sub(d));
        let det = w[0] * (u[1] * v[2] - u[2] * v[1])
            + w[1] * (u[2] * v[0] - u[0] * v[2])
            + w[2] * (u[0] * v[1] - u[1] * v[0]);
        return det.signum() as i8;
    }
    let at = parts.map(|p| {
        p.map(|(m, e)| BigInt::from(m) << (if m == 0 { 0 } else { (e - least).unsigned_abs() }))
    });
    let [a, b, c, d] = &at;
    let sub = |p: &[BigInt; 3]| [&p[0] - &a[0], &p[1] - &a[1], &p[2] - &a[2]];
    let (u, v, w) = (sub(b), sub(c), sub(d));
    let det = &w[0] * (&u[1] * &v[2] - &u[2] * &v[1])
        + &w[1] * (&u[2] * &v[0] - &u[0] * &v[2])
        + &w[2] * (&u[0] * &v[1] - &u[1] * &v[0]);
    i8::from(det.is_positive()) - i8::from(det.is_negative())
}

/// `x = m · 2^e` with an odd `m`, or zero.
fn decompose(x: f64) -> (i64, i32) {
    if x == 0.0 {
        return (0, 0);
    }
    let bits = x.to_bits();
    let (exponent, fraction) =
        ((bits >> 52 & 0x7FF) as i32, (bits & ((1 << 52) - 1)).cast_signed());
    let (mantissa, exponent) =
        if exponent == 0 { (fraction, -1074) } else { (fraction | 1 << 52, exponent - 1075) };
    let shift = mantissa.trailing_zeros();
    let odd = mantissa >> shift;
    (if x < 0.0 { -odd } else { odd }, exponent + shift.cast_signed())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_unit_in_the_last_place_decides() {
        let t = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 1e-20]];
        assert_eq!(side(t, [0.25, 0.5, 0.5e-20]).0, 0);
        assert_eq!(side(t, [0.25, 0.5, 0.5e-20f64.next_up()]).0, 1);
        assert_eq!(side(t, [0.25, 0.5, 0.5e-20f64.next_down()]).0, -1);
        assert_eq!(
            side([[0.5, 0.25, 0.1], [0.75, 0.25, 0.1], [0.5, 0.5, 0.1]], [0.3, 0.3, 0.1]),
            (0, true)
        );
        assert_eq!(decompose(-6.0), (-3, 1));
        assert_eq!(decompose(f64::MIN_POSITIVE / 2.0), (1, -1023));
    }
}
