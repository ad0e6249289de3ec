//! Distances and meetings in integers: no rounding, and no code that the library has.
//!
//! Coordinates are dyadic. A question takes them all as multiples of one power of two.

use num_bigint::BigInt;
use num_traits::{Signed, Zero};
use std::cmp::Ordering;

/// Corners in the input's own numbers.
pub type Corners = [[f64; 3]; 3];

pub(super) type Vector = [BigInt; 3];

/// A fraction with a positive denominator.
#[derive(Clone, Debug)]
pub struct Fraction {
    over: BigInt,
    under: BigInt,
}

impl Fraction {
    fn new(over: BigInt, under: BigInt) -> Self {
        if under.is_negative() { Self { over: -over, under: -under } } else { Self { over, under } }
    }

    fn whole(n: BigInt) -> Self {
        Self { over: n, under: BigInt::from(1) }
    }

    /// How it compares with a finite number.
    #[must_use]
    pub fn compared_with(&self, x: f64) -> Ordering {
        let (mantissa, exponent) = parts(x);
        if exponent >= 0 {
            self.over.cmp(&((mantissa << exponent.unsigned_abs()) * &self.under))
        } else {
            (&self.over << exponent.unsigned_abs()).cmp(&(mantissa * &self.under))
        }
    }

    fn least(self, other: Self) -> Self {
        if (&other.over * &self.under) < (&self.over * &other.under) { other } else { self }
    }

    fn is_at_most_one(&self) -> bool {
        self.over <= self.under
    }
}

/// `x = mantissa · 2^exponent`.
pub(super) fn parts(x: f64) -> (BigInt, i32) {
    assert!(x.is_finite(), "{x}");
    let (field, fraction) = ((x.to_bits() >> 52 & 0x7FF) as i32, x.to_bits() & ((1 << 52) - 1));
    let (mantissa, exponent) =
        if field == 0 { (fraction, -1074) } else { (fraction | 1 << 52, field - 1075) };
    let zeros = if mantissa == 0 { 0 } else { mantissa.trailing_zeros() };
    let odd = BigInt::from(mantissa >> zeros);
    let exponent = if mantissa == 0 { 0 } else { exponent + zeros.cast_signed() };
    (if x < 0.0 { -odd } else { odd }, exponent)
}

fn unit_of(points: &[[f64; 3]]) -> i32 {
    points.iter().flatten().map(|&x| parts(x).1).min().unwrap_or(0)
}

fn integers(p: [f64; 3], unit: i32) -> Vector {
    p.map(|x| {
        let (mantissa, exponent) = parts(x);
        mantissa << (exponent.max(unit) - unit).unsigned_abs()
    })
}

pub(super) fn minus([a, b, c]: &Vector, [x, y, z]: &Vector) -> Vector {
    [a - x, b - y, c - z]
}

pub(super) fn dot([a, b, c]: &Vector, [x, y, z]: &Vector) -> BigInt {
    a * x + b * y + c * z
}

pub(super) fn cross([a, b, c]: &Vector, [x, y, z]: &Vector) -> Vector {
    [b * z - c * y, c * x - a * z, a * y - b * x]
}

fn is_zero(v: &Vector) -> bool {
    v.iter().all(Zero::is_zero)
}

fn sides([a, b, c]: &[Vector; 3]) -> [[&Vector; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

fn normal([a, b, c]: &[Vector; 3]) -> Vector {
    cross(&minus(b, a), &minus(c, a))
}

/// Whether a point that is `p / q` lies in the prism upright on a triangle.
fn is_over(triangle: &[Vector; 3], normal: &Vector, p: &Vector, q: &BigInt) -> bool {
    sides(triangle).iter().all(|[from, to]| {
        let from_q = from.each_ref().map(|x| x * q);
        !dot(normal, &cross(&minus(to, from), &minus(p, &from_q))).is_negative()
    })
}

fn squared_to_side(p: &Vector, [from, to]: [&Vector; 2]) -> Fraction {
    let (d, s) = (minus(to, from), minus(p, from));
    let (along, length) = (dot(&d, &s), dot(&d, &d));
    if !along.is_positive() {
        Fraction::whole(dot(&s, &s))
    } else if along >= length {
        let s = minus(p, to);
        Fraction::whole(dot(&s, &s))
    } else {
        Fraction::new(dot(&s, &s) * &length - &along * &along, length)
    }
}

/// Whether the distance of a point and a triangle is less than, equal to or greater than `x ≥ 0`,
/// which may be infinite.
#[must_use]
pub fn distance_compared(p: [f64; 3], corners: &Corners, x: f64) -> Ordering {
    if x == f64::INFINITY {
        return Ordering::Less;
    }
    let unit = unit_of(&[*corners, [p, [x; 3], p]].concat());
    let triangle = corners.map(|p| integers(p, unit));
    let (p, [x, ..]) = (integers(p, unit), integers([x; 3], unit));
    let normal = normal(&triangle);
    let one = BigInt::from(1);
    let squared = if !is_zero(&normal) && is_over(&triangle, &normal, &p, &one) {
        let height = dot(&normal, &minus(&p, &triangle[0]));
        Fraction::new(&height * &height, dot(&normal, &normal))
    } else {
        let [a, b, c] = sides(&triangle).map(|side| squared_to_side(&p, side));
        a.least(b).least(c)
    };
    squared.over.cmp(&(&x * &x * &squared.under))
}

/// Whether all points of one set lie before all of another along an axis, by comparisons alone. Most
/// pairs do, and integers take a thousand times as long.
fn lie_apart(first: &[[f64; 3]], second: &[[f64; 3]]) -> bool {
    let lie_before = |k: usize, low: &[[f64; 3]], high: &[[f64; 3]]| {
        low.iter().all(|p| high.iter().all(|q| p[k] < q[k]))
    };
    (0..3).any(|k| lie_before(k, first, second) || lie_before(k, second, first))
}

/// The least parameter at which the closed segment from `a` to `b` has a point of a triangle.
#[must_use]
pub fn first_meeting(a: [f64; 3], b: [f64; 3], corners: &Corners) -> Option<Fraction> {
    if lie_apart(&[a, b], corners) {
        return None;
    }
    let unit = unit_of(&[*corners, [a, b, a]].concat());
    let triangle = corners.map(|p| integers(p, unit));
    first_exactly([&integers(a, unit), &integers(b, unit)], &triangle)
}

fn first_exactly([a, b]: [&Vector; 2], triangle: &[Vector; 3]) -> Option<Fraction> {
    let normal = normal(triangle);
    let height = |p: &Vector| dot(&normal, &minus(p, &triangle[0]));
    let (from, to) = (height(a), height(b));
    let one = BigInt::from(1);
    if from.is_zero() && to.is_zero() {
        if !is_zero(&normal) && is_over(triangle, &normal, a, &one) {
            return Some(Fraction::whole(BigInt::zero()));
        }
        let meetings = sides(triangle).map(|side| first_on_side([a, b], side));
        return meetings.into_iter().flatten().reduce(Fraction::least);
    }
    if (&from * &to).is_positive() {
        return None;
    }
    let t = Fraction::new(from.clone(), from - to);
    let way = minus(b, a);
    let place: Vector = std::array::from_fn(|k| &a[k] * &t.under + &way[k] * &t.over);
    is_over(triangle, &normal, &place, &t.under).then_some(t)
}

fn first_on_side([a, b]: [&Vector; 2], [u, v]: [&Vector; 2]) -> Option<Fraction> {
    let (d, e, w) = (minus(b, a), minus(v, u), minus(u, a));
    let across = cross(&d, &e);
    let is_part = |t: &Fraction| !t.over.is_negative() && t.is_at_most_one();
    if !is_zero(&across) {
        if !dot(&w, &across).is_zero() {
            return None;
        }
        let square = dot(&across, &across);
        let t = Fraction::new(dot(&cross(&w, &e), &across), square.clone());
        let s = Fraction::new(dot(&cross(&w, &d), &across), square);
        return (is_part(&t) && is_part(&s)).then_some(t);
    }
    if is_zero(&d) {
        return squared_to_side(a, [u, v]).over.is_zero().then(|| Fraction::whole(BigInt::zero()));
    }
    if !is_zero(&cross(&d, &w)) {
        return None;
    }
    let square = dot(&d, &d);
    let (s, t) = (dot(&w, &d), dot(&minus(v, a), &d));
    let (low, high) = if s < t { (s, t) } else { (t, s) };
    (!high.is_negative() && low <= square).then(|| Fraction::new(low.max(BigInt::zero()), square))
}

/// Whether two triangles have a common point.
#[must_use]
pub fn meet(first: &Corners, second: &Corners) -> bool {
    if lie_apart(first, second) {
        return false;
    }
    let edges_meet = |of: &Corners, with: &Corners| {
        (0..3).any(|k| first_meeting(of[k], of[(k + 1) % 3], with).is_some())
    };
    edges_meet(first, second) || edges_meet(second, first)
}

/// As [`meet`], of corners in integers of one unit.
pub(super) fn meet_exactly(first: &[Vector; 3], second: &[Vector; 3]) -> bool {
    let edges_meet = |of: &[Vector; 3], with: &[Vector; 3]| {
        sides(of).into_iter().any(|side| first_exactly(side, with).is_some())
    };
    edges_meet(first, second) || edges_meet(second, first)
}

/// About the distance of a point and a triangle, to 1e-7 of the lengths.
#[must_use]
pub fn about(p: [f64; 3], corners: &Corners) -> f64 {
    let sub = |x: [f64; 3], y: [f64; 3]| [x[0] - y[0], x[1] - y[1], x[2] - y[2]];
    let dot = |x: [f64; 3], y: [f64; 3]| x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
    let cross = |x: [f64; 3], y: [f64; 3]| {
        [x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]]
    };
    let [a, b, c] = *corners;
    let edges = [[a, b], [b, c], [c, a]];
    let squares = edges.map(|[from, to]| {
        let (d, s) = (sub(to, from), sub(p, from));
        let t = (dot(d, s) / dot(d, d)).clamp(0.0, 1.0);
        let gap = sub(s, d.map(|x| if t.is_nan() { 0.0 } else { x * t }));
        dot(gap, gap)
    });
    let nearest = squares.into_iter().fold(f64::INFINITY, f64::min).sqrt();
    let normal = cross(sub(b, a), sub(c, a));
    let is_over =
        |[from, to]: [[f64; 3]; 2]| dot(cross(sub(to, from), normal), sub(p, from)) <= 0.0;
    if dot(normal, normal) > 0.0 && edges.into_iter().all(is_over) {
        return nearest.min(dot(normal, sub(p, a)).abs() / dot(normal, normal).sqrt());
    }
    nearest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::Rng;

    #[test]
    fn the_oracle_knows_segments_points_and_triangles() {
        let o = [0.0; 3];
        let (x, y) = ([2.0, 0.0, 0.0], [0.0, 2.0, 0.0]);
        let wire = [o, [1.0, 0.0, 0.0], x];
        assert_eq!(distance_compared([1.5, 3.0, 4.0], &wire, 5.0), Ordering::Equal);
        assert_eq!(distance_compared([5.0, 0.0, 4.0], &wire, 5.0), Ordering::Equal);
        assert_eq!(distance_compared([0.5, 0.5, -1e-300], &[o, x, y], 1e-300), Ordering::Equal);
        assert_eq!(distance_compared([1e-300, 0.0, 3.0], &[o; 3], 3.0), Ordering::Greater);
        let at = |a, b, t: &Corners| first_meeting(a, b, t);
        let t = at([1.0, -1.0, 0.0], [1.0, 3.0, 0.0], &wire).expect("crosses");
        assert_eq!(t.compared_with(0.25), Ordering::Equal);
        assert!(at([1.0, -1.0, 1e-300], [1.0, 3.0, 0.0], &wire).is_none());
        let t = at([-1.0, 0.0, 0.0], [3.0, 0.0, 0.0], &wire).expect("runs along it");
        assert_eq!(t.compared_with(0.25), Ordering::Equal);
        assert!(at([3.0, 0.0, 0.0], [4.0, 0.0, 0.0], &wire).is_none());
        assert!(at([0.5, 0.5, 1.0], [0.5, 0.5, -1.0], &[o, x, y]).is_some());
        assert!(meet(&wire, &[o; 3]) && !meet(&wire, &[[0.0, 0.0, 1e-9]; 3]));
    }

    #[test]
    fn what_lies_apart_along_an_axis_does_not_meet_in_integers_either() {
        let mut rng = Rng::new(3);
        // Few places, so that many triangles touch.
        let mut corners = || [0; 3].map(|_| [0; 3].map(|_| rng.below(4) as f64));
        let (mut apart, mut together) = (0, 0);
        for _ in 0..2000 {
            let (s, t): (Corners, Corners) = (corners(), corners());
            let exactly = meet_exactly(&s.map(|p| integers(p, 0)), &t.map(|p| integers(p, 0)));
            assert_eq!(meet(&s, &t), exactly, "{s:?} {t:?}");
            apart += usize::from(lie_apart(&s, &t));
            together += usize::from(exactly);
        }
        assert!(apart > 250 && together > 250, "{apart} {together}");
    }
}
