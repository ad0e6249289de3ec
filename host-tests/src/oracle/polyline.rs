//! Distance of a point and polylines, every segment looked at, in 106 bits; and winding numbers of
//! closed ones by exact signs.

use super::distance::{Bounded, squared_to_segment};
use super::double::{Double, Vector};
use robust::{Coord, orient2d};

/// Distance of `p` and the nearest of the segments `from to`; infinite if there is none.
#[must_use]
pub fn distance_to_segments(
    p: [f32; 3],
    segments: impl IntoIterator<Item = [[f64; 3]; 2]>,
) -> Bounded {
    let p = Vector::new(p);
    let mut best = Bounded { lower: f64::INFINITY, upper: f64::INFINITY };
    for ends in segments {
        let [from, to] = ends.map(|end| Vector(end.map(Double::new)));
        let distance = squared_to_segment(&p, &from, &to).sqrt();
        let found = Bounded::about(distance, p.minus(&from).norm_1() + to.minus(&from).norm_1());
        best.lower = best.lower.min(found.lower);
        best.upper = best.upper.min(found.upper);
    }
    best
}

/// How often a closed polyline winds around a point of the plane, by the quadrants that it goes
/// through. `None`: the polyline touches the point. z is not looked at.
///
/// Coordinates are compared as they are; `robust` decides signs of determinants exactly.
#[must_use]
pub fn winding_about(p: [f32; 2], points: &[[f64; 3]]) -> Option<i32> {
    let p = p.map(f64::from);
    let quadrant = |v: &[f64; 3]| match (v[0] >= p[0], v[1] >= p[1]) {
        (true, true) => 0i32,
        (false, true) => 1,
        (false, false) => 2,
        (true, false) => 3,
    };
    let coord = |v: &[f64; 3]| Coord { x: v[0], y: v[1] };
    let mut quarters = 0;
    for (a, b) in points.iter().zip(points.iter().cycle().skip(1)) {
        let turn = orient2d(coord(a), coord(b), Coord { x: p[0], y: p[1] });
        let holds =
            |axis: usize| a[axis].min(b[axis]) <= p[axis] && p[axis] <= a[axis].max(b[axis]);
        if turn == 0.0 && holds(0) && holds(1) {
            return None;
        }
        quarters += match (quadrant(b) - quadrant(a)).rem_euclid(4) {
            3 => -1,
            2 if turn > 0.0 => 2,
            2 => -2,
            other => other,
        };
    }
    Some(quarters / 4)
}
