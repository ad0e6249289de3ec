//! A corner that is the closest point of many triangles.
//!
//! Of the triangles that f32 cannot rule out on a machined part most share the corner that is the
//! closest point. f64 gives all of them the same distance. A board computes f64 by instructions,
//! several thousand for a triangle. So f32 proves that a further triangle at the corner would give
//! the same bits, and only its number is looked at. Proof: `core/docs/rounding.md` §4, *Shared
//! corners*.

use crate::geom::{PointTriangle, RealVector};
use crate::num::Real;
use crate::num::tolerance::{
    CORNER_AREA, CORNER_DOUBT, CORNER_FARTHEST, CORNER_LARGEST, CORNER_LEAST, CORNER_SIDE,
    CORNER_WIDTH, CORNER_WIDTH_LEAST,
};
use glam::{DVec3, Vec3};

/// A query point that looks for such a corner.
#[derive(Clone, Copy, Debug)]
pub(super) struct SharedCorner {
    point: Vec3,
    /// Upper bound of the 1-norms of the ways from a corner to the point and to another corner,
    /// together.
    norms: f32,
    surface_error: f64,
    known: Option<Known>,
}

/// A corner whose distance was computed in f64.
#[derive(Clone, Copy, Debug)]
struct Known {
    position: Vec3,
    distance_sq: f64,
}

impl SharedCorner {
    /// `None` where differences of coordinates may be rounded in f64.
    ///
    /// `norms` is an upper bound of the 1-norms of the ways from any corner of the model to the
    /// point and to another corner, together.
    pub(super) fn new(p: DVec3, norms: f32, surface_error: f64) -> Option<Self> {
        let point = p.as_vec3();
        let is_coarse =
            point.to_array().into_iter().all(|x| x == 0.0 || is_multiple(x.abs(), CORNER_FARTHEST));
        is_coarse.then_some(SharedCorner { point, norms, surface_error, known: None })
    }

    /// The squared distance and the closest point of a triangle, if its closest point is certainly
    /// the corner that is known. Then f64 would give this squared distance, bit by bit, and bounds
    /// that are reported as those of the triangle that was evaluated at the corner.
    #[inline]
    pub(super) fn find(&self, corners: [Vec3; 3]) -> Option<(f64, Vec3)> {
        let Known { position, distance_sq } = self.known?;
        let place = corners.iter().position(|corner| *corner == position)?;
        self.is_closest(corners, place).then_some((distance_sq, position))
    }

    /// Remembers the closest point of a triangle that was evaluated in f64, if that is a corner
    /// and if no number of f32 is too near to its distance.
    pub(super) fn learn(&mut self, corners: [Vec3; 3], evaluated: &PointTriangle) {
        let place = match (evaluated.u, evaluated.v) {
            (0.0, 0.0) => 0,
            (1.0, 0.0) => 1,
            (0.0, 1.0) => 2,
            _ => return,
        };
        let (distance, error) = (evaluated.upper, self.surface_error);
        let mut ends = [distance, distance - error, distance + error].into_iter();
        if let Some(&position) = corners.get(place)
            && self.is_closest(corners, place)
            && ends.all(|end| self.is_settled(end))
        {
            self.known = Some(Known { position, distance_sq: evaluated.distance_sq });
        }
    }

    /// Whether the corner at a place, 0 to 2, is certainly the closest point, for the kernel in f64
    /// too.
    #[inline]
    fn is_closest(&self, corners: [Vec3; 3], place: usize) -> bool {
        let [a, b, c] = RealVector::corners(corners);
        let (corner, one, other) = match place {
            0 => (a, b, c),
            1 => (b, a, c),
            _ => (c, a, b),
        };
        let point = RealVector::from(self.point);
        let (offset, one, other) = (point - corner, one - corner, other - corner);
        let (offset_size, one_size, other_size) = (offset.norm_1(), one.norm_1(), other.norm_1());
        let doubt = Real(CORNER_DOUBT) * Real(self.norms) * Real(self.norms);
        let is_behind = |edge: RealVector, size: Real| {
            offset.dot(edge) < -(Real(CORNER_SIDE) * offset_size * size + doubt)
        };
        if !(is_behind(one, one_size) && is_behind(other, other_size)) {
            return false;
        }
        // The kernel looks at the first edge before the last corner. A triangle with an area lies
        // on the right side of it.
        if place == 2 {
            let normal = one.cross(other);
            let (product, sum) = (one_size * other_size, one_size + other_size);
            if normal.dot(normal) <= Real(CORNER_AREA) * product * product + doubt * sum * sum {
                return false;
            }
        }
        let is_coarse = |x: f32| x.to_bits() == 0 || is_multiple(x.abs(), CORNER_LARGEST);
        corners.iter().all(|at| is_coarse(at.x) && is_coarse(at.y) && is_coarse(at.z))
    }

    /// Whether no number of f32 lies among the bounds that triangles have at a corner of about this
    /// distance.
    fn is_settled(&self, distance: f64) -> bool {
        // One f32 is this many f64 from the next.
        const STEP: u32 = 1 << 29;
        let doubt = CORNER_WIDTH * self.norms / distance as f32 + CORNER_WIDTH_LEAST;
        let above = (distance.to_bits() % u64::from(STEP)) as u32;
        // NaN of a distance of 0 is refused, too.
        distance > 0.0 && doubt < (STEP / 2) as f32 && {
            let doubt = doubt as u32;
            above > doubt && above < STEP - doubt
        }
    }
}

/// Whether a positive number is a multiple of 2^-46 below a limit.
#[inline(always)]
fn is_multiple(x: f32, limit: f32) -> bool {
    x.to_bits().wrapping_sub(CORNER_LEAST.to_bits()) < limit.to_bits() - CORNER_LEAST.to_bits()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{Aabb, SweptPoint, point_triangle};
    use crate::num::{down_to_f32, up_to_f32};

    fn random(state: &mut u64) -> f32 {
        *state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (*state >> 40) as f32 / (1u32 << 23) as f32 - 1.0
    }

    fn shared(p: Vec3) -> Option<SharedCorner> {
        let bounds = Aabb { min: Vec3::NEG_ONE, max: Vec3::ONE };
        SharedCorner::new(p.as_dvec3(), SweptPoint::new(p, &bounds).norms(), 0.0)
    }

    fn evaluated(p: Vec3, corners: [Vec3; 3]) -> PointTriangle {
        let [a, b, c] = corners.map(|v| v.as_dvec3());
        point_triangle(p.as_dvec3(), a, b, c)
    }

    /// Needles, coarse grids where all signs may be 0, and triangles of all sizes about one corner.
    #[test]
    fn a_triangle_at_a_known_corner_has_the_bits_of_the_kernel() {
        let mut state = 3;
        let mut found = [0; 3];
        for round in 0..60_000 {
            let step = [0.0, 0.25, 0.125][round % 3];
            let size = [1.0, 1e-1, 1e-3, 1e-5][round / 3 % 4];
            let mut vector = |size: f32| {
                let v = Vec3::new(random(&mut state), random(&mut state), random(&mut state));
                if step > 0.0 { (v / step).round() * step } else { v * size }
            };
            let (corner, p) = (vector(0.5), vector(3.0));
            let Some(mut shared) = shared(p) else { continue };
            for turn in 0..6 {
                let other = corner + vector(size) * 0.5;
                let sliver = other + vector(size) * [0.5, 1e-6][turn % 2];
                let mut corners = [corner, other, sliver];
                corners.rotate_right(round / 12 % 3);
                if !corners.iter().all(|v| v.abs().max_element() <= 1.0) {
                    continue;
                }
                let real = evaluated(p, corners);
                let Some((distance_sq, point)) = shared.find(corners) else {
                    shared.learn(corners, &real);
                    continue;
                };
                let [a, b, c] = corners.map(|v| v.as_dvec3());
                let closest = a + (b - a) * real.u + (c - a) * real.v;
                assert_eq!(distance_sq.to_bits(), real.distance_sq.to_bits(), "{p} {corners:?}");
                assert_eq!(
                    closest.to_array().map(f64::to_bits),
                    point.as_dvec3().to_array().map(f64::to_bits)
                );
                let length = libm::sqrt(distance_sq);
                assert_eq!(up_to_f32(real.upper), up_to_f32(length), "{p} {corners:?}");
                assert_eq!(down_to_f32(real.lower), down_to_f32(length), "{p} {corners:?}");
                found[round / 12 % 3] += 1;
            }
        }
        assert!(found.iter().all(|&count| count > 1_000), "{found:?}");
    }

    #[test]
    fn what_may_have_other_bits_is_not_found() {
        let corners = [Vec3::ZERO, Vec3::X, Vec3::Y];
        let known = |p: Vec3, corners: [Vec3; 3]| {
            let mut shared = shared(p)?;
            shared.learn(corners, &evaluated(p, corners));
            shared.find(corners)
        };
        let p = Vec3::new(-0.3, -0.4, 0.7);
        assert!(known(p, corners).is_some());
        assert!(known(Vec3::new(-0.3, -0.4, 0.0), corners).is_some(), "0.5 is off by roundings");
        // A number of f32; the point in the plane across an edge; no corner.
        assert!(known(Vec3::new(-3.0, -4.0, 0.0), corners).is_none());
        assert!(known(Vec3::new(0.0, -0.4, 0.7), corners).is_none());
        assert!(known(Vec3::new(0.3, -0.4, 0.7), corners).is_none());
        // Coordinates that are too fine or too large; −0, which f64 makes 0.
        assert!(known(p + Vec3::new(0.300_000_04, 0.0, 0.0), corners).is_none());
        assert!(known(p * 64.0, corners).is_none());
        assert!(known(p, [Vec3::ZERO, Vec3::X + Vec3::Y * 1e-9, Vec3::Y]).is_none());
        assert!(known(p, [Vec3::new(0.0, -0.0, 0.0), Vec3::X, Vec3::Y]).is_none());
        // The last corner of a triangle without an area.
        assert!(known(p, [Vec3::X, Vec3::X * 0.5, Vec3::ZERO]).is_none());
        assert!(known(p, [Vec3::X, Vec3::Y, Vec3::ZERO]).is_some());
    }
}
