//! Segment against mesh, every triangle looked at; whether they meet is decided by exact predicates
//! (`robust`, after Shewchuk 1997), so edges and vertices are watertight.

use super::double::{Double, Vector};
use robust::{Coord, Coord3D, orient2d, orient3d};

/// A triangle that a segment meets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Index of the triangle in the mesh.
    pub triangle: u32,
    /// The first common parameter is not below this.
    pub t_lower: f64,
    /// Nor above this.
    pub t_upper: f64,
    /// Whether the segment lies in the triangle's plane.
    pub coplanar: bool,
}

fn coord([x, y, z]: [f32; 3]) -> Coord3D<f64> {
    Coord3D { x: f64::from(x), y: f64::from(y), z: f64::from(z) }
}

fn side(a: [f32; 3], b: [f32; 3], c: [f32; 3], d: [f32; 3]) -> i8 {
    sign(orient3d(coord(a), coord(b), coord(c), coord(d)))
}

fn sign(x: f64) -> i8 {
    i8::from(x > 0.0) - i8::from(x < 0.0)
}

/// Whether the closed segment and the closed triangle have a common point, and whether they are
/// coplanar. Exact. The triangle must have an area.
#[must_use]
pub fn meets(a: [f32; 3], b: [f32; 3], [u, v, w]: [[f32; 3]; 3]) -> Option<bool> {
    let (sa, sb) = (side(u, v, w, a), side(u, v, w, b));
    if sa * sb > 0 {
        return None;
    }
    if sa == 0 && sb == 0 {
        return meets_in_plane(a, b, [u, v, w]).then_some(true);
    }
    let sides = [side(a, b, u, v), side(a, b, v, w), side(a, b, w, u)];
    let one_way = sides.iter().all(|&s| s >= 0) || sides.iter().all(|&s| s <= 0);
    one_way.then_some(false)
}

/// The coplanar case, on a coordinate plane on which the triangle keeps its area. Leaving out a
/// coordinate is exact.
fn meets_in_plane(a: [f32; 3], b: [f32; 3], t: [[f32; 3]; 3]) -> bool {
    let flat = |p: [f32; 3], drop: usize| Coord {
        x: f64::from(p[(drop + 1) % 3]),
        y: f64::from(p[(drop + 2) % 3]),
    };
    let Some(drop) = (0..3).find(|&k| {
        let [u, v, w] = t.map(|p| flat(p, k));
        orient2d(u, v, w) != 0.0
    }) else {
        return false;
    };
    let (p, q) = (flat(a, drop), flat(b, drop));
    let t = t.map(|p| flat(p, drop));
    let inside = |x: Coord<f64>| {
        let s = [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])].map(|(u, v)| sign(orient2d(u, v, x)));
        s.iter().all(|&s| s >= 0) || s.iter().all(|&s| s <= 0)
    };
    inside(p)
        || inside(q)
        || [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])].into_iter().any(|(u, v)| cross_2d(p, q, u, v))
}

/// Whether two closed segments in the plane meet.
fn cross_2d(p: Coord<f64>, q: Coord<f64>, u: Coord<f64>, v: Coord<f64>) -> bool {
    let [a, b] = [u, v].map(|x| sign(orient2d(p, q, x)));
    let [c, d] = [p, q].map(|x| sign(orient2d(u, v, x)));
    if a == 0 && b == 0 && c == 0 && d == 0 {
        let overlap =
            |lo: f64, hi: f64, x: f64, y: f64| lo.min(hi) <= x.max(y) && x.min(y) <= lo.max(hi);
        return overlap(p.x, q.x, u.x, v.x) && overlap(p.y, q.y, u.y, v.y);
    }
    a * b <= 0 && c * d <= 0
}

/// All triangles that the closed segment meets, by rising `t_lower`, then index.
#[must_use]
pub fn contacts(
    a: [f32; 3],
    b: [f32; 3],
    positions: &[[f32; 3]],
    triangles: &[[u32; 3]],
) -> Vec<Contact> {
    let mut found = Vec::new();
    for (index, triangle) in triangles.iter().enumerate() {
        let corners = triangle.map(|v| positions[v as usize]);
        let Some(coplanar) = meets(a, b, corners) else { continue };
        let (t_lower, t_upper) =
            if coplanar { first_in_plane(a, b, corners) } else { crossing(a, b, corners) };
        found.push(Contact { triangle: index as u32, t_lower, t_upper, coplanar });
    }
    found.sort_by(|x, y| x.t_lower.total_cmp(&y.t_lower).then(x.triangle.cmp(&y.triangle)));
    found
}

/// Parameter at which the segment crosses the plane; it is known to do so.
fn crossing(a: [f32; 3], b: [f32; 3], corners: [[f32; 3]; 3]) -> (f64, f64) {
    let [u, v, w] = corners.map(Vector::new);
    let (a, b) = (Vector::new(a), Vector::new(b));
    let normal = v.minus(&u).cross(&w.minus(&u));
    let from = normal.dot(&u.minus(&a));
    let across = normal.dot(&b.minus(&a));
    let t = (from / across).hi.clamp(0.0, 1.0);
    let sizes = v.minus(&u).norm_1() * w.minus(&u).norm_1();
    let error =
        1e-29 * sizes * (u.minus(&a).norm_1() + b.minus(&a).norm_1()) / across.hi.abs() + 1e-15 * t;
    if error.is_finite() { ((t - error).max(0.0), (t + error).min(1.0)) } else { (0.0, 1.0) }
}

/// First common parameter in the plane: the least at which the segment is in the triangle, by
/// clipping to its three sides.
fn first_in_plane(a: [f32; 3], b: [f32; 3], corners: [[f32; 3]; 3]) -> (f64, f64) {
    let [u, v, w] = corners.map(Vector::new);
    let (a, b) = (Vector::new(a), Vector::new(b));
    let d = b.minus(&a);
    let normal = v.minus(&u).cross(&w.minus(&u));
    let mut t = Double::ZERO;
    let mut error = 1e-15;
    for (from, to) in [(&u, &v), (&v, &w), (&w, &u)] {
        // Outward in the plane.
        let out = to.minus(from).cross(&normal);
        let (start, along) = (out.dot(&a.minus(from)), out.dot(&d));
        let scale = to.minus(from).norm_1() * normal.norm_1();
        if start.is_positive() && !along.is_positive() && along.hi != 0.0 {
            let enter = -(start / along);
            error += 1e-28 * scale * (a.minus(from).norm_1() + d.norm_1()) / along.hi.abs();
            if (enter - t).is_positive() {
                t = enter;
            }
        }
    }
    let t = t.clamp_unit().hi;
    if error.is_finite() { ((t - error).max(0.0), (t + error).min(1.0)) } else { (0.0, 1.0) }
}

/// An upper bound of the distance of segment and triangle, in `f64`; 0 if they meet.
#[must_use]
pub fn gap_to_triangle(a: [f32; 3], b: [f32; 3], corners: [[f32; 3]; 3]) -> f64 {
    if meets(a, b, corners).is_some() {
        return 0.0;
    }
    let [u, v, w] = corners;
    let ends = [a, b].map(|p| super::rough_distance_sq(p, corners));
    let corners_to_segment = corners.map(|p| super::rough_distance_sq(p, [a, b, b]));
    let edges = [(u, v), (v, w), (w, u)].map(|(p, q)| edge_gap_sq(a, b, p, q));
    let least =
        ends.into_iter().chain(corners_to_segment).chain(edges).fold(f64::INFINITY, f64::min);
    least.sqrt()
}

/// Squared distance of the points at which the lines come closest, both kept on their segments.
fn edge_gap_sq(a: [f32; 3], b: [f32; 3], p: [f32; 3], q: [f32; 3]) -> f64 {
    let [a, b, p, q] = [a, b, p, q].map(Vector::new);
    let (d, e, s) = (b.minus(&a), q.minus(&p), a.minus(&p));
    let (dd, ee, de) = (d.dot(&d), e.dot(&e), d.dot(&e));
    let (ds, es) = (d.dot(&s), e.dot(&s));
    let determinant = dd * ee - de * de;
    if !determinant.is_positive() {
        return f64::INFINITY;
    }
    let t = ((de * es - ds * ee) / determinant).clamp_unit();
    let k = ((de * t + es) / ee).clamp_unit();
    let t = ((de * k - ds) / dd).clamp_unit();
    let gap = s.plus(&d.times(t)).minus(&e.times(k));
    gap.dot(&gap).hi
}

#[cfg(test)]
mod tests {
    use super::*;

    const T: [[f32; 3]; 3] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

    #[test]
    fn contacts_at_faces_edges_and_in_the_plane() {
        assert_eq!(meets([0.2, 0.2, 1.0], [0.2, 0.2, -1.0], T), Some(false));
        assert_eq!(meets([0.5, 0.5, 1.0], [0.5, 0.5, -1.0], T), Some(false));
        assert_eq!(meets([0.51, 0.5, 1.0], [0.51, 0.5, -1.0], T), None);
        assert_eq!(meets([-1.0, 0.2, 0.0], [1.0, 0.2, 0.0], T), Some(true));
        assert_eq!(meets([-1.0, -0.2, 0.0], [1.0, -0.2, 0.0], T), None);
        assert_eq!(meets([2.0, 0.0, 0.0], [3.0, 0.0, 0.0], T), None);
        assert_eq!(meets([-1.0, 0.0, 0.0], [3.0, 0.0, 0.0], T), Some(true));
        assert_eq!(meets([0.2, 0.2, 0.0], [0.2, 0.2, 0.0], T), Some(true));
        assert_eq!(meets([0.2, 0.2, 0.1], [0.2, 0.2, 0.1], T), None);
    }

    #[test]
    fn parameters_are_bracketed() {
        let (positions, triangles) = (T.to_vec(), [[0, 1, 2]]);
        let at = |a, b| contacts(a, b, &positions, &triangles)[0];
        let through = at([0.2, 0.2, 1.0], [0.2, 0.2, -3.0]);
        assert!(
            through.t_lower <= 0.25
                && 0.25 <= through.t_upper
                && through.t_upper - through.t_lower < 1e-14
        );
        let in_plane = at([-1.0, 0.25, 0.0], [1.0, 0.25, 0.0]);
        assert!(in_plane.t_lower <= 0.5 && 0.5 <= in_plane.t_upper && in_plane.coplanar);
        assert!(gap_to_triangle([0.2, 0.2, 1.0], [0.2, 0.2, 0.5], T) - 0.5 < 1e-12);
        assert!(gap_to_triangle([0.5, -0.5, 1.0], [0.5, -0.5, -1.0], T) - 0.5 < 1e-12);
    }
}
