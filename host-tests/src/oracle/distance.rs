//! Distance of a point and a mesh, every triangle looked at.
//!
//! Not Ericson's regions: the foot on the plane if three half-planes contain the point, else the
//! nearest of three edges. In 106 bits for every triangle that may be the nearest by an estimate in
//! `f64`.

use super::double::{Double, Vector};
use glam::DVec3;

/// A real number between two `f64`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounded {
    /// Not above it.
    pub lower: f64,
    /// Not below it.
    pub upper: f64,
}

impl Bounded {
    /// A distance of 106 bits whose terms are of this size.
    pub(super) fn about(distance: Double, size: f64) -> Self {
        let margin = DOUBLE_ERROR * size;
        Bounded {
            lower: (distance.hi.next_down() - margin).next_down().max(0.0),
            upper: (distance.hi.next_up() + margin).next_up(),
        }
    }
}

/// The root of the least of some squares.
pub(super) fn least_root<const N: usize>(squares: [Double; N]) -> Double {
    let least = squares.into_iter().reduce(|x, y| if (x - y).is_positive() { y } else { x });
    least.unwrap_or(Double::ZERO).sqrt()
}

/// Relative to the lengths in play, more than 106 bits lose on a triangle whose height is above
/// 1e-10 of its length.
const DOUBLE_ERROR: f64 = 1e-26;

/// Relative to the lengths in play, more than the estimate in `f64` is off, degenerate triangles
/// included: the three edges alone are good to 1e-14, and the plane is only trusted where its
/// normal is.
const ROUGH_ERROR: f64 = 1e-7;

/// Distance of `p` and the triangle, to some 26 digits of the lengths involved.
#[must_use]
pub fn distance_to_triangle(p: [f32; 3], corners: [[f32; 3]; 3]) -> Bounded {
    distance_between(&Vector::new(p), &corners.map(Vector::new))
}

/// Distance of `p` and the nearest of the triangles after `rotation`·v + `translation`. Cost: 106
/// bits for every triangle.
#[must_use]
pub fn distance_to_moved_mesh(
    p: [f32; 3],
    [positions, rotation]: [&[[f32; 3]]; 2],
    triangles: &[[u32; 3]],
    translation: [f32; 3],
) -> Bounded {
    let (p, shift) = (Vector::new(p), Vector::new(translation));
    let rows: Vec<Vector> = rotation.iter().map(|&row| Vector::new(row)).collect();
    let moved = |v: u32| {
        let at = Vector::new(positions[v as usize]);
        Vector(std::array::from_fn(|k| rows[k].dot(&at))).plus(&shift)
    };
    let nothing = Bounded { lower: f64::INFINITY, upper: f64::INFINITY };
    triangles.iter().map(|t| distance_between(&p, &t.map(moved))).fold(nothing, |best, d| Bounded {
        lower: best.lower.min(d.lower),
        upper: best.upper.min(d.upper),
    })
}

pub(super) fn distance_between(p: &Vector, [a, b, c]: &[Vector; 3]) -> Bounded {
    let size = p.minus(a).norm_1() + b.minus(a).norm_1() + c.minus(a).norm_1();
    let normal = b.minus(a).cross(&c.minus(a));
    let squared = normal.dot(&normal);
    let within = |from: &Vector, to: &Vector| {
        !to.minus(from).cross(&normal).dot(&p.minus(from)).is_positive()
    };
    let distance = if squared.is_positive() && within(a, b) && within(b, c) && within(c, a) {
        let height = normal.dot(&p.minus(a)) / squared.sqrt();
        if height.is_positive() { height } else { -height }
    } else {
        least_root([(a, b), (b, c), (c, a)].map(|(from, to)| squared_to_segment(p, from, to)))
    };
    Bounded::about(distance, size)
}

pub(super) fn squared_to_segment(p: &Vector, from: &Vector, to: &Vector) -> Double {
    let (d, s) = (to.minus(from), p.minus(from));
    let length = d.dot(&d);
    let t = if length.is_positive() { (d.dot(&s) / length).clamp_unit() } else { Double::ZERO };
    let gap = s.minus(&d.times(t));
    gap.dot(&gap)
}

/// Distance of `p` and the nearest of the triangles; infinite if there is none. Cost: one estimate
/// in `f64` for each triangle, 106 bits for the nearest few.
#[must_use]
pub fn distance_to_mesh(p: [f32; 3], positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Bounded {
    let corners = |t: &[u32; 3]| t.map(|v| positions[v as usize]);
    let rough: Vec<(f64, f64)> = triangles
        .iter()
        .map(|t| {
            let corners = corners(t);
            let size = corners.iter().map(|v| span(p, *v)).sum::<f64>();
            (rough_distance_sq(p, corners).sqrt(), ROUGH_ERROR * size)
        })
        .collect();
    let nearest = rough.iter().map(|(d, error)| d + error).fold(f64::INFINITY, f64::min);
    let mut best = Bounded { lower: f64::INFINITY, upper: f64::INFINITY };
    for (triangle, (d, error)) in triangles.iter().zip(&rough) {
        if d - error <= nearest {
            let exact = distance_to_triangle(p, corners(triangle));
            best.lower = best.lower.min(exact.lower);
            best.upper = best.upper.min(exact.upper);
        }
    }
    best
}

fn span(p: [f32; 3], q: [f32; 3]) -> f64 {
    (0..3).map(|k| (f64::from(p[k]) - f64::from(q[k])).abs()).sum()
}

/// Squared distance in plain `f64`.
#[must_use]
pub fn rough_distance_sq(p: [f32; 3], corners: [[f32; 3]; 3]) -> f64 {
    wide_distance_sq(p.map(f64::from), corners.map(|v| v.map(f64::from)))
}

/// The same of a point and corners in `f64`.
#[must_use]
pub fn wide_distance_sq(p: [f64; 3], [a, b, c]: [[f64; 3]; 3]) -> f64 {
    let [p, a, b, c] = [p, a, b, c].map(DVec3::from);
    let edges = [(a, b), (b, c), (c, a)];
    let to_edge = |(from, to): (DVec3, DVec3)| {
        let (d, s) = (to - from, p - from);
        let t = (d.dot(s) / d.dot(d)).clamp(0.0, 1.0);
        let t = if t.is_nan() { 0.0 } else { t };
        (s - d * t).length_squared()
    };
    let nearest_edge = edges.into_iter().map(to_edge).fold(f64::INFINITY, f64::min);
    let normal = (b - a).cross(c - a);
    let within = |(from, to): (DVec3, DVec3)| (to - from).cross(normal).dot(p - from) <= 0.0;
    let square = normal.length_squared();
    if square > 0.0 && edges.into_iter().all(within) {
        let height = normal.dot(p - a);
        return nearest_edge.min(height * height / square);
    }
    nearest_edge
}

#[cfg(test)]
mod tests {
    use super::*;

    const T: [[f32; 3]; 3] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

    fn check(p: [f32; 3], expected: f64) {
        let d = distance_to_triangle(p, T);
        assert!(
            d.lower <= expected
                && expected <= d.upper
                && d.upper - d.lower < 1e-15 * (1.0 + expected),
            "{d:?}"
        );
        assert!((rough_distance_sq(p, T).sqrt() - expected).abs() < 1e-12);
    }

    #[test]
    fn face_edges_corners_and_the_surface_itself() {
        check([0.25, 0.25, 2.0], 2.0);
        check([0.25, 0.25, -2.0], 2.0);
        check([-3.0, -4.0, 0.0], 5.0);
        check([0.5, -2.0, 0.0], 2.0);
        check([1.5, 1.5, 0.0], 2f64.sqrt());
        check([0.25, 0.25, 0.0], 0.0);
        check([1.0, 0.0, 0.0], 0.0);
    }

    #[test]
    fn scale_does_not_matter() {
        for k in [-40, 40] {
            let s = 10f32.powi(k / 2) * 10f32.powi(k - k / 2).sqrt();
            let d =
                distance_to_triangle([0.25 * s, 0.25 * s, 3.0 * s], T.map(|v| v.map(|x| x * s)));
            let expected = 3.0 * f64::from(s);
            assert!(
                d.lower <= expected * (1.0 + 1e-7)
                    && d.upper >= expected * (1.0 - 1e-7)
                    && d.lower > 0.0,
                "{d:?}"
            );
        }
    }
}
