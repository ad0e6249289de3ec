//! Whether two triangles, each swept by a sphere, are certainly apart.
//!
//! They are compared along the axes, along the way from centre to centre and along both normals. A
//! direction is taken as it was computed, and all corners are measured along it. So a normal
//! misjudged on a sliver costs tightness and not truth. Derivation: `core/docs/rounding.md` §16.

use super::vector::{Point, Precision, cross, dot, minus};
use crate::num::tolerance::{SQUARED_SLACK, U32};
use crate::num::{each, greater, lesser};

/// A triangle swept by a sphere.
#[derive(Clone, Copy, Debug)]
pub struct SweptTriangle<T> {
    /// The triangle's corners.
    pub corners: [Point<T>; 3],
    radius: T,
    /// The box of the corners.
    low: Point<T>,
    high: Point<T>,
}

impl<T: Precision> SweptTriangle<T> {
    /// Of its corners and the sphere's radius, which may be infinite.
    #[inline(always)]
    pub fn new(corners: [Point<T>; 3], radius: T) -> Self {
        let [[ax, ay, az], [bx, by, bz], [cx, cy, cz]] = corners;
        let each = |pick: fn(T, T) -> T| {
            [pick(pick(ax, bx), cx), pick(pick(ay, by), cy), pick(pick(az, bz), cz)]
        };
        SweptTriangle { corners, radius, low: each(lesser), high: each(greater) }
    }

    /// Sum of the sides of its box.
    #[inline(always)]
    pub fn size(&self) -> T {
        let [x, y, z] = minus(self.high, self.low);
        let twice = self.radius + self.radius;
        ((x + y) + z) + (twice + (twice + twice))
    }

    /// Whether both are certainly farther than `margin` from each other. `margin` has to contain
    /// what the corners are off by, and the rounding of a height: 26 unit roundoffs of the longest
    /// offset along an axis from a corner to another.
    #[inline(always)]
    pub fn is_apart(&self, other: &SweptTriangle<T>, margin: T) -> bool {
        let radii = ((self.radius + other.radius) + margin) * T::from(1.0 + 4.0 * U32);
        let (before, behind) = (minus(other.low, self.high), minus(self.low, other.high));
        if before.into_iter().chain(behind).any(|gap| gap > radii) {
            return true;
        }
        self.is_apart_along(minus(other.sum(), self.sum()), other, radii)
            || self.is_apart_along(self.normal(), other, radii)
            || self.is_apart_along(other.normal(), other, radii)
    }

    /// Thrice the centre.
    #[inline(always)]
    fn sum(&self) -> Point<T> {
        let [[ax, ay, az], [bx, by, bz], [cx, cy, cz]] = self.corners;
        [(ax + bx) + cx, (ay + by) + cy, (az + bz) + cz]
    }

    #[inline(always)]
    fn normal(&self) -> Point<T> {
        let [a, b, c] = self.corners;
        cross(minus(b, a), minus(c, a))
    }

    /// Whether all corners of one are farther than `radii` from all of the other along a direction.
    #[inline(always)]
    fn is_apart_along(&self, direction: Point<T>, other: &SweptTriangle<T>, radii: T) -> bool {
        let [from, ..] = self.corners;
        let height = |corner: Point<T>| dot(direction, minus(corner, from));
        let ([p, q, r], [s, t, u]) = (each(self.corners, height), each(other.corners, height));
        let above = lesser(lesser(s, t), u) - greater(greater(p, q), r);
        let below = lesser(lesser(p, q), r) - greater(greater(s, t), u);
        let gap = greater(above, below);
        let length_sq = dot(direction, direction);
        let limit = (radii * radii) * length_sq;
        // Below the least number to be trusted the squares may have lost all digits.
        gap > T::ZERO
            && length_sq > T::UNDERFLOW_LOSS
            && limit > T::UNDERFLOW_LOSS
            && (gap * gap) * T::from(SQUARED_SLACK) > limit
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FLAT: [[f32; 3]; 3] = [[0.0; 3], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];

    fn apart(other: [[f32; 3]; 3], radii: [f32; 2]) -> bool {
        let [a, b] = [SweptTriangle::new(FLAT, radii[0]), SweptTriangle::new(other, radii[1])];
        assert_eq!(a.is_apart(&b, 1e-5), b.is_apart(&a, 1e-5));
        let wide = |t: [[f32; 3]; 3], radius: f32| {
            SweptTriangle::new(t.map(|p| p.map(f64::from)), f64::from(radius))
        };
        let exact = wide(FLAT, radii[0]).is_apart(&wide(other, radii[1]), 1e-5);
        assert_eq!(a.is_apart(&b, 1e-5), exact);
        exact
    }

    #[test]
    fn boxes_and_normals_part_what_is_farther_than_both_radii() {
        let above = [[1.0, 1.0, 1.0], [2.0, 1.0, 2.0], [1.0, 2.0, 2.0]];
        assert!(apart(above, [0.0; 2]));
        assert!(apart(above, [0.5, 0.49]));
        assert!(!apart(above, [0.5, 0.51]));
        assert!(!apart(above, [0.0, f32::INFINITY]));
        // Boxes meet, and only the slanted triangle's plane is between them.
        let slanted = [[4.0, 4.0, -1.0], [4.0, 0.5, 2.0], [0.5, 4.0, 2.0]];
        assert!(apart(slanted, [0.1; 2]));
        assert!(!apart(slanted, [1.0; 2]));
        // No normal: the boxes alone.
        assert!(!apart([[1.0, 1.0, 0.0]; 3], [0.0; 2]));
        assert!(apart([[1.0, 1.0, 0.5]; 3], [0.2; 2]));
    }
}
