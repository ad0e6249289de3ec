//! On which side of a plane a point lies: a filter in `f64`, then integers.

use super::dyadic::Dyadic;
use super::vector::{cross, dot, minus};

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

/// The same without rounding.
fn side_in_integers(points: [[f64; 3]; 4]) -> i8 {
    let [a, b, c, d] = points.map(|p| p.map(Dyadic::from));
    dot(&minus(&d, &a), &cross(&minus(&b, &a), &minus(&c, &a))).sign()
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
    }
}
