//! Whether a face and a triangle that have no point in common are farther apart than a margin, in
//! exact arithmetic.
//!
//! Two triangles apart are nearest to each other at a corner of one and a point inside the other,
//! or at points of two edges. So the distance is more than `d` if it is for each corner above the
//! other triangle's inside, and for each pair of edges. Lengths are compared by their squares, and
//! divisors are moved to the other side.

use super::surface::Corners;
use crate::check::dyadic::Dyadic;
use crate::check::vector::{cross, dot, minus};

pub(crate) type Vector = [Dyadic; 3];

/// A margin.
pub(super) struct Margin {
    length: f64,
}

impl Margin {
    pub(super) fn new(length: f64) -> Self {
        Self { length }
    }

    /// Whether the triangles, which are apart, are farther apart.
    pub(super) fn is_kept(&self, s: &Corners, t: &Corners) -> bool {
        let exact = |t: &Corners| t.map(|p| p.map(Dyadic::from));
        let (s, t) = (exact(s), exact(t));
        let length = Dyadic::from(self.length);
        let most = &length * &length;
        let above = |t: &[Vector; 3], s: &[Vector; 3]| s.iter().all(|p| corner_is_far(p, t, &most));
        above(&s, &t)
            && above(&t, &s)
            && (0..3).all(|i| {
                (0..3).all(|k| {
                    edges_are_far([&s[i], &s[(i + 1) % 3]], [&t[k], &t[(k + 1) % 3]], &most)
                })
            })
    }
}

/// Whether a plane parallel to the face has the face in front of it and the triangle farther behind
/// than the margin: most pairs need no more. In intervals: `true` is a proof, `false` says nothing.
pub(super) fn is_beyond(triangle: &Corners, face: &Corners, margin: f64) -> bool {
    let [a, b, c] = *face;
    let edge = |p: [f64; 3]| [p[0] - a[0], p[1] - a[1], p[2] - a[2]];
    let (u, v) = (edge(b), edge(c));
    let normal = [[1, 2], [2, 0], [0, 1]].map(|[i, j]: [usize; 2]| u[i] * v[j] - u[j] * v[i]);
    let length = normal.map(|x| x * x).iter().sum::<f64>().sqrt();
    // Rounding may have turned the normal. The rounded normal is a direction like any other.
    let low = face.iter().map(|&p| height(normal, a, p)[0]).fold(f64::INFINITY, f64::min);
    let high = triangle.iter().map(|&p| height(normal, a, p)[1]).fold(f64::NEG_INFINITY, f64::max);
    let gap = (low - high).next_down();
    let needed = margin * (length * (1.0 + 1e-14)) * (1.0 + 1e-14);
    // Below this, products may have lost all their bits.
    length > 1e-120 && gap > needed && gap > 1e-250
}

/// Bounds of `normal · (p − origin)`.
fn height(normal: [f64; 3], origin: [f64; 3], p: [f64; 3]) -> [f64; 2] {
    let mut bounds = [0.0f64; 2];
    for k in 0..3 {
        let exact = p[k] - origin[k];
        let ends = [exact.next_down(), exact.next_up()].map(|x| normal[k] * x);
        let least = ends[0].min(ends[1]).next_down();
        let most = ends[0].max(ends[1]).next_up();
        bounds = [(bounds[0] + least).next_down(), (bounds[1] + most).next_up()];
    }
    bounds
}

/// Whether a corner is farther from a triangle's plane, if its foot is inside; true if it is not,
/// or there is no plane.
fn corner_is_far(p: &Vector, [a, b, c]: &[Vector; 3], most: &Dyadic) -> bool {
    let normal = cross(&minus(b, a), &minus(c, a));
    let square = dot(&normal, &normal);
    let beyond = [[a, b], [b, c], [c, a]]
        .iter()
        .any(|[u, v]| dot(&normal, &cross(&minus(v, u), &minus(p, u))).sign() < 0);
    if square.sign() == 0 || beyond {
        return true;
    }
    let height = dot(&normal, &minus(p, a));
    &height * &height > most * &square
}

/// Whether a point is farther from a segment.
pub(crate) fn point_is_far(p: &Vector, a: &Vector, b: &Vector, most: &Dyadic) -> bool {
    let (along, to) = (minus(b, a), minus(p, a));
    let (square, foot) = (dot(&along, &along), dot(&along, &to));
    if foot.sign() <= 0 {
        return dot(&to, &to) > *most;
    }
    if foot >= square {
        let to = minus(p, b);
        return dot(&to, &to) > *most;
    }
    let area = cross(&along, &to);
    dot(&area, &area) > most * &square
}

/// Whether two segments are farther apart.
fn edges_are_far([a, b]: [&Vector; 2], [c, d]: [&Vector; 2], most: &Dyadic) -> bool {
    let ends = point_is_far(a, c, d, most)
        && point_is_far(b, c, d, most)
        && point_is_far(c, a, b, most)
        && point_is_far(d, a, b, most);
    if !ends {
        return false;
    }
    let (u, v, w) = (minus(b, a), minus(d, c), minus(c, a));
    let across = cross(&u, &v);
    let square = dot(&across, &across);
    // The lines are nearest to each other at a + x·u and c + y·v, with these times `square`.
    let [x, y] = [dot(&cross(&w, &v), &across), dot(&cross(&w, &u), &across)];
    let between = |z: &Dyadic| z.sign() > 0 && *z < square;
    if square.sign() == 0 || !between(&x) || !between(&y) {
        return true;
    }
    let gap = dot(&w, &across);
    &gap * &gap > most * &square
}

#[cfg(test)]
mod tests {
    use super::*;

    const FLAT: Corners = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];

    #[test]
    fn a_margin_is_kept_up_to_the_distance_itself() {
        let others: [(Corners, f64); 6] = [
            ([[1.0, 1.0, 2.0], [1.0, 2.0, 3.0], [2.0, 1.0, 3.0]], 2.0),
            ([[1.0, 1.0, -2.0], [1.0, 1.0, -3.0], [1.0, 1.0, -4.0]], 2.0),
            ([[1.0, 1.0, -2.0]; 3], 2.0),
            ([[-3.0, -4.0, 0.0], [-5.0, -4.0, 1.0], [-5.0, -4.0, -1.0]], 5.0),
            ([[2.0, -1.0, -3.0], [2.0, -1.0, 3.0], [2.0, -9.0, 0.0]], 1.0),
            ([[-3.0, 1.0, -4.0], [9.0, 2.0, -4.0], [2.0, 9.0, -4.0]], 4.0),
        ];
        for (other, distance) in others {
            for scale in [2f64.powi(-149), 1.0, 2f64.powi(100)] {
                let [s, t] = [FLAT, other].map(|t| t.map(|p| p.map(|x: f64| x * scale)));
                let kept = |margin: f64| {
                    let margin = Margin::new(margin * scale);
                    assert_eq!(margin.is_kept(&s, &t), margin.is_kept(&t, &s));
                    margin.is_kept(&s, &t)
                };
                assert!(kept(0.0) && kept(distance.next_down()) && !kept(distance), "{other:?}");
            }
        }
    }
}
