//! Whether triangles keep a distance, proved in floating point.
//!
//! Two convex sets are farther apart than `d` if and only if some direction `n` separates them by
//! `d`: `min n·p − max n·q > d·|n|` over the corners `p` of the one and `q` of the other. Any `n`
//! proves it, so that rounding may choose `n`. Only the rounding of the test itself has to be
//! bounded.
//!
//! With ε = 2^-53, the difference of two coordinates is off by a part ε, its product with `n` by as
//! much again, and a sum of three products adds two: `n·(p − o)` is off by less than 4.1 ε·S, where
//! S sums the magnitudes of the products. The difference of two such numbers is off by less than 11
//! ε·S. [`ROUNDING`] is three times that. `n` has about length 1, so that underflow loses far less
//! than the least normal number, which is added. The length of `n` is off by less than 5 ε, its
//! product with the distance by one more: less than the part that [`Clearance`] adds to the
//! distance.

use crate::geom::{Bounds, Triangle};
use glam::DVec3;
use meshsweep_core::internal::geom::point_triangle;

/// Bound of the rounding of a test, as a fraction of S. The module derives it.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// A distance to keep, rounded up so that every test against it is a proof.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Clearance(f64);

impl Clearance {
    pub fn new(distance: f64) -> Self {
        Self((distance * (1.0 + 8.0 * f64::EPSILON)).next_up())
    }

    /// Whether two boxes with `f32` corners are farther apart along one axis.
    #[inline]
    pub fn separates_boxes(&self, a: &Bounds, b: &Bounds) -> bool {
        (a.low - b.high).max(b.low - a.high).max_element() > self.0
    }

    /// Whether all of `above` is farther than the distance beyond all of `below` along a direction
    /// of any length.
    #[inline]
    pub fn separates_along(&self, direction: DVec3, above: &Triangle, below: &Triangle) -> bool {
        let Some(n) = unit(direction) else { return false };
        let origin = below[0];
        let mut size = 0f64;
        let mut along = |p: DVec3| {
            let terms = n * (p - origin);
            size = size.max(terms.abs().element_sum());
            terms.element_sum()
        };
        let low = above.iter().fold(f64::INFINITY, |low, &p| low.min(along(p)));
        let high = below.iter().fold(f64::NEG_INFINITY, |high, &p| high.max(along(p)));
        low - high - (ROUNDING * size + f64::MIN_POSITIVE) > self.0 * n.length()
    }

    /// As [`separates_along`](Self::separates_along), with a box below.
    #[inline]
    pub fn separates_box_along(&self, direction: DVec3, above: &Triangle, below: &Bounds) -> bool {
        let Some(n) = unit(direction) else { return false };
        let origin = above[0];
        let pick = DVec3::select(n.cmpgt(DVec3::ZERO), below.high, below.low);
        let terms = n * (pick - origin);
        let (high, mut size) = (terms.element_sum(), terms.abs().element_sum());
        let mut low = f64::INFINITY;
        for &p in above {
            let terms = n * (p - origin);
            size = size.max(terms.abs().element_sum());
            low = low.min(terms.element_sum());
        }
        low - high - (ROUNDING * size + f64::MIN_POSITIVE) > self.0 * n.length()
    }

    /// Whether a triangle with area is certainly farther than the distance from another triangle,
    /// which may have no area.
    pub fn separates(&self, face: &Triangle, normal: DVec3, triangle: &Triangle) -> bool {
        if self.separates_quickly(face, normal, triangle) {
            return true;
        }
        let Some(near) = Nearest::of(face, triangle) else { return false };
        self.separates_along(near.direction, face, triangle)
            || self.separates_along(near.p - near.q, face, triangle)
    }

    /// As [`separates`](Self::separates), along two directions that cost little. They decide for
    /// triangles that are far apart.
    pub fn separates_quickly(&self, face: &Triangle, normal: DVec3, triangle: &Triangle) -> bool {
        if self.separates_along(normal, face, triangle) {
            return true;
        }
        let middle = (triangle[0] + triangle[1] + triangle[2]) / 3.0;
        self.separates_along(towards(face, middle), face, triangle)
    }

    /// Whether a triangle is certainly farther than the distance from a box.
    #[inline]
    pub fn separates_box(
        &self,
        face: &Triangle,
        bounds: &Bounds,
        normal: DVec3,
        below: &Bounds,
    ) -> bool {
        if self.separates_boxes(bounds, below) || self.separates_box_along(normal, face, below) {
            return true;
        }
        self.separates_box_along(towards(face, (below.low + below.high) * 0.5), face, below)
    }
}

/// The way from a point to the nearest point of a triangle.
fn towards([a, b, c]: &Triangle, p: DVec3) -> DVec3 {
    let near = point_triangle(p, *a, *b, *c);
    *a + (b - a) * near.u + (c - a) * near.v - p
}

fn unit(direction: DVec3) -> Option<DVec3> {
    // Scaled by its largest coordinate first, because squares may underflow.
    let largest = direction.abs().max_element();
    let scaled = direction / largest;
    (largest > 0.0 && scaled.is_finite()).then(|| scaled / scaled.length())
}

/// The closest points of two triangles that do not cross. Not exact.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Nearest {
    /// On the first triangle, and its weights there.
    pub p: DVec3,
    pub weights: [f64; 3],
    /// On the second.
    pub q: DVec3,
    pub distance: f64,
    /// From the second towards the first triangle, of any length. It is more accurate than `p − q`
    /// where these are close together.
    pub direction: DVec3,
}

impl Nearest {
    /// `None` if no distance is a number.
    pub fn of(s: &Triangle, t: &Triangle) -> Option<Self> {
        let mut best: Option<Self> = None;
        let mut offer = |weights: [f64; 3], q: DVec3, normal: Option<DVec3>| {
            let p = s[0] * weights[0] + s[1] * weights[1] + s[2] * weights[2];
            let distance = (p - q).length();
            if distance < best.map_or(f64::INFINITY, |b| b.distance) {
                let direction = match normal {
                    Some(n) if n.dot(p - q) < 0.0 => -n,
                    Some(n) => n,
                    None => p - q,
                };
                best = Some(Self { p, weights, q, distance, direction });
            }
        };
        for &q in t {
            let (weights, inside) = weights(q, s);
            offer(weights, q, inside.then(|| normal(s)));
        }
        for (i, &p) in s.iter().enumerate() {
            let (on_t, inside) = weights(p, t);
            let mut corner = [0.0; 3];
            corner[i] = 1.0;
            let q = t[0] * on_t[0] + t[1] * on_t[1] + t[2] * on_t[2];
            offer(corner, q, inside.then(|| normal(t)));
        }
        for i in 0..3 {
            let j = (i + 1) % 3;
            let u = s[j] - s[i];
            for k in 0..3 {
                let (c, d) = (t[k], t[(k + 1) % 3]);
                // If an end of an edge is the closest point, it was offered as a corner.
                if let Some([x, y]) = crossing(s[i] - c, u, d - c) {
                    let mut on_edge = [0.0; 3];
                    (on_edge[i], on_edge[j]) = (1.0 - x, x);
                    offer(on_edge, c + (d - c) * y, Some(u.cross(d - c)));
                }
            }
        }
        best
    }
}

fn normal([a, b, c]: &Triangle) -> DVec3 {
    (b - a).cross(c - a)
}

/// Weights of the point of a triangle that is nearest to `p`, and whether it is inside.
fn weights(p: DVec3, &[a, b, c]: &Triangle) -> ([f64; 3], bool) {
    let near = point_triangle(p, a, b, c);
    let weights = [1.0 - near.u - near.v, near.u, near.v];
    (weights, weights.iter().all(|&w| w > 0.0))
}

/// The parameters of the closest points of the lines `w + x·u` and `y·v`, if they lie between the
/// ends of both.
fn crossing(w: DVec3, u: DVec3, v: DVec3) -> Option<[f64; 2]> {
    let (uu, uv, vv, uw, vw) = (u.dot(u), u.dot(v), v.dot(v), u.dot(w), v.dot(w));
    let det = uu * vv - uv * uv;
    let (x, y) = ((uv * vw - vv * uw) / det, (uu * vw - uv * uw) / det);
    let between = |z: f64| 0.0 < z && z < 1.0;
    (det > 0.0 && between(x) && between(y)).then_some([x, y])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangle(points: [[f64; 3]; 3]) -> Triangle {
        points.map(DVec3::from)
    }

    fn parts(distance: f64, s: &Triangle, t: &Triangle) -> bool {
        let bounds = Bounds::of(s);
        let found = Clearance::new(distance).separates(s, normal(s), t);
        assert!(
            found || !Clearance::new(distance).separates_box(s, &bounds, normal(s), &Bounds::of(t))
        );
        found
    }

    const FLAT: [[f64; 3]; 3] = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];

    #[test]
    fn a_distance_is_kept_if_it_is_less_and_not_if_it_is_equal() {
        let flat = triangle(FLAT);
        let others = [
            (triangle([[1.0, 1.0, 2.0], [1.0, 2.0, 3.0], [2.0, 1.0, 3.0]]), 2.0),
            (triangle([[1.0, 1.0, -2.0], [1.0, 1.0, -3.0], [1.0, 1.0, -4.0]]), 2.0),
            (triangle([[1.0, 1.0, -2.0]; 3]), 2.0),
            (triangle([[-3.0, -4.0, 0.0], [-5.0, -4.0, 1.0], [-5.0, -4.0, -1.0]]), 5.0),
            (triangle([[2.0, -1.0, -3.0], [2.0, -1.0, 3.0], [2.0, -9.0, 0.0]]), 1.0),
            (triangle([[-3.0, 1.0, -4.0], [9.0, 2.0, -4.0], [2.0, 9.0, -4.0]]), 4.0),
        ];
        for (other, distance) in others {
            for scale in [2f64.powi(-100), 1.0, 2f64.powi(100)] {
                let [s, t] = [flat, other].map(|t| t.map(|p| p * scale));
                let at = distance * scale;
                // `separates` allows `ROUNDING` of the triangles' size, which is a few times the
                // distance.
                assert!(parts(at * (1.0 - 1e-12), &s, &t), "{t:?}");
                assert!(!parts(at, &s, &t) && !parts(at * (1.0 + 1e-14), &s, &t), "{t:?}");
                assert!(Nearest::of(&s, &t).is_some_and(|n| (n.distance / at - 1.0).abs() < 1e-14));
            }
        }
    }

    #[test]
    fn triangles_that_meet_keep_no_distance() {
        let flat = triangle(FLAT);
        let through = triangle([[1.0, 1.0, -1.0], [1.0, 1.5, 2.0], [1.5, 1.0, 2.0]]);
        assert!(!parts(0.0, &flat, &through) && !parts(0.0, &through, &flat));
        assert!(!parts(0.0, &flat, &flat));
    }
}
