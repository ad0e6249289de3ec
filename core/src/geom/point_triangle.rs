//! Point–triangle distance in f64, as an interval that contains the real one.
//!
//! Regions after Ericson, *Real-Time Collision Detection* (2005), 5.1.5. The upper end is the
//! length of the residual `ap − u·ab − v·ac`. The lower end is a supporting plane, which holds for
//! any region that rounding chooses. Derivation: `core/docs/rounding.md` §4.

use super::vector::norm_1;
use crate::num::greater;
use crate::num::tolerance::{POINT_INTERVAL, U64};
use glam::DVec3;

/// Distance of a point and a triangle: `lower ≤ distance ≤ upper` in real arithmetic.
#[derive(Clone, Copy, Debug)]
pub struct PointTriangle {
    /// Not above the distance.
    pub lower: f64,
    /// Not below the distance.
    pub upper: f64,
    /// Squared length of the residual as computed. It decides ties.
    pub distance_sq: f64,
    /// The closest point is `a + u·(b − a) + v·(c − a)`, `u, v ≥ 0`, `u + v ≤ 1` up to one
    /// rounding.
    pub u: f64,
    /// See [`u`](Self::u).
    pub v: f64,
}

/// Distance interval of `p` and the triangle `a b c`.
///
/// Degenerate triangles (segments, points) have a distance too. The width of the interval is a few
/// 1e-16 of the lengths involved. On a needle of aspect ratio `k` the lower end loses `k` times as
/// much. Coordinates must be finite and below 1e75, so that no product overflows.
#[inline]
pub fn point_triangle(p: DVec3, a: DVec3, b: DVec3, c: DVec3) -> PointTriangle {
    let ap = p - a;
    let ab = b - a;
    let ac = c - a;
    let Closest { u, v, residual, direction } = closest(ap, ab, ac);
    let distance_sq = residual.dot(residual);
    let length = libm::sqrt(distance_sq);
    let norms = norm_1(ap) + norm_1(ab) + norm_1(ac);
    let margin = POINT_INTERVAL * U64 * norms;

    // Along any direction, no point of the triangle is nearer than the nearest corner. Without
    // another one the residual is the direction, and its length is known.
    let g = direction.unwrap_or(residual);
    let along = g.dot(ap);
    let support = greater(greater(0.0, g.dot(ab)), g.dot(ac));
    let size = direction.map_or(length, |g| libm::sqrt(g.dot(g)));
    let lower = if size > 0.0 { (along - support) / size - margin } else { 0.0 };
    PointTriangle { lower: lower.max(0.0), upper: length + margin, distance_sq, u, v }
}

/// The closest point, as [`closest`] finds it.
pub(super) struct Closest {
    pub(super) u: f64,
    pub(super) v: f64,
    /// `ap − u·ab − v·ac`.
    residual: DVec3,
    /// Bounds the distance better than the residual.
    direction: Option<DVec3>,
}

/// The closest point by its barycentric coordinates. Terms of the residual whose factor is 0 or 1
/// are left out: boards take hundreds of instructions for each.
#[inline]
pub(super) fn closest(ap: DVec3, ab: DVec3, ac: DVec3) -> Closest {
    let at = |u: f64, v: f64, residual: DVec3, direction: Option<DVec3>| Closest {
        u,
        v,
        residual,
        direction,
    };
    let d1 = ab.dot(ap);
    let d2 = ac.dot(ap);
    if d1 <= 0.0 && d2 <= 0.0 {
        return at(0.0, 0.0, ap, None);
    }
    let aa = ab.dot(ab);
    let bb = ab.dot(ac);
    let d3 = d1 - aa;
    let d4 = d2 - bb;
    if d3 >= 0.0 && d4 <= d3 {
        return at(1.0, 0.0, ap - ab, None);
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 && aa > 0.0 {
        let u = d1 / aa;
        let residual = ap - ab * u;
        return at(u, 0.0, residual, Some(orthogonal(residual, ab, aa)));
    }
    let cc = ac.dot(ac);
    let d5 = d1 - bb;
    let d6 = d2 - cc;
    if d6 >= 0.0 && d5 <= d6 {
        return at(0.0, 1.0, ap - ac, None);
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 && cc > 0.0 {
        let v = d2 / cc;
        let residual = ap - ac * v;
        return at(0.0, v, residual, Some(orthogonal(residual, ac, cc)));
    }
    let va = d3 * d6 - d5 * d4;
    let e4 = d4 - d3;
    let e5 = d5 - d6;
    if va <= 0.0 && e4 >= 0.0 && e5 >= 0.0 && e4 + e5 > 0.0 {
        let v = e4 / (e4 + e5);
        let u = 1.0 - v;
        let bc = ac - ab;
        let residual = ap - ab * u - ac * v;
        return at(u, v, residual, Some(orthogonal(residual, bc, bc.dot(bc))));
    }
    let sum = va + vb + vc;
    if sum <= 0.0 {
        // Only a triangle that rounding has flattened gets here. Corner `a` is a true, if poor,
        // upper bound.
        return at(0.0, 0.0, ap, None);
    }
    let inverse = 1.0 / sum;
    let (u, v) = (vb * inverse, vc * inverse);
    let u = u.clamp(0.0, 1.0);
    let v = v.max(0.0).min(1.0 - u);
    // Near the surface the residual is only rounding. The normal is not.
    let normal = ab.cross(ac);
    let facing = if normal.dot(ap) < 0.0 { -normal } else { normal };
    at(u, v, ap - ab * u - ac * v, Some(facing))
}

/// `r` without its component along `edge`. One correction is enough (Kahan, Parlett).
#[inline]
fn orthogonal(r: DVec3, edge: DVec3, edge_sq: f64) -> DVec3 {
    if edge_sq > 0.0 { r - edge * (r.dot(edge) / edge_sq) } else { r }
}

#[cfg(test)]
mod tests {
    use super::*;

    const A: DVec3 = DVec3::new(0.0, 0.0, 0.0);
    const B: DVec3 = DVec3::new(1.0, 0.0, 0.0);
    const C: DVec3 = DVec3::new(0.0, 1.0, 0.0);

    fn check(p: DVec3, expected: f64) {
        let d = point_triangle(p, A, B, C);
        assert!(d.lower <= expected && expected <= d.upper, "{p} {d:?}");
        assert!(d.upper - d.lower < 1e-13, "{p} {d:?}");
    }

    #[test]
    fn all_seven_regions_have_a_tight_interval() {
        check(DVec3::new(0.25, 0.25, 2.0), 2.0);
        check(DVec3::new(0.25, 0.25, -1e-9), 1e-9);
        check(DVec3::new(-3.0, -4.0, 0.0), 5.0);
        check(DVec3::new(4.0, -4.0, 0.0), 5.0);
        check(DVec3::new(-4.0, 4.0, 0.0), 5.0);
        check(DVec3::new(0.5, -2.0, 0.0), 2.0);
        check(DVec3::new(-2.0, 0.5, 0.0), 2.0);
        check(DVec3::new(1.5, 1.5, 0.0), libm::sqrt(2.0));
        check(DVec3::new(0.3, 0.3, 0.0), 0.0);
    }

    #[test]
    fn degenerate_triangles_are_segments_and_points() {
        let p = DVec3::new(1.0, 2.0, 2.0);
        for (a, b, c, expected) in [
            (A, A, A, 3.0),
            (A, B, B, libm::sqrt(8.0)),
            (A, A, B, libm::sqrt(8.0)),
            (A, B, A, libm::sqrt(8.0)),
            (A, B * 0.5, B, libm::sqrt(8.0)),
        ] {
            let d = point_triangle(p, a, b, c);
            assert!(d.lower <= expected && expected <= d.upper, "{d:?}");
        }
    }
}
