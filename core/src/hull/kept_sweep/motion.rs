//! How much nearer a motion of the point may bring a part of the mesh.

use crate::geom::Aabb;
use crate::num::tolerance::{TURNED, TURNS_FROM, U64};
use glam::{DVec3, Vec3};

/// The ball that holds the mesh.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ball {
    centre: DVec3,
    radius: f64,
    /// The centre in f32, and the squared distance from it from which on turns are told from other
    /// motions. On a Cortex-M f64 is slow.
    about: Vec3,
    far_sq: f32,
}

impl Ball {
    /// The ball around a box.
    pub(super) fn around(bounds: &Aabb) -> Ball {
        let (low, high) = (bounds.min.as_dvec3(), bounds.max.as_dvec3());
        // Both are exact.
        let (centre, half) = ((low + high) * 0.5, (high - low) * 0.5);
        let radius = half.length();
        let far = TURNS_FROM * radius as f32;
        Ball { centre, radius, about: centre.as_vec3(), far_sq: far * far }
    }

    /// An upper bound of what a point may come nearer to a point of the ball, or go away from it,
    /// on its way from one place to another.
    ///
    /// The way is a turn about the centre, and a motion toward the centre or away from it. A turn
    /// of the point changes distances as the same turn of the ball does, the other way round. It
    /// moves no point of the ball by more than the radius times the chord of the directions. Near
    /// the ball the way itself is shorter.
    #[inline]
    pub(super) fn approach(&self, from: DVec3, to: DVec3) -> f64 {
        let way = from.distance(to);
        let seen = to.as_vec3() - self.about;
        if seen.dot(seen) > self.far_sq { self.turn(from, to).min(way) } else { way }
    }

    #[inline(never)]
    fn turn(&self, from: DVec3, to: DVec3) -> f64 {
        let (from, to) = (from - self.centre, to - self.centre);
        let (near, far) = (from.length(), to.length());
        let chord = (from / near).distance(to / far);
        // A direction carries five roundings, a length four of itself.
        let rounding = TURNED * U64 * (self.radius + near + far);
        let motion = self.radius * chord + (far - near).abs() + rounding;
        // The start may be the centre.
        if motion.is_nan() { f64::INFINITY } else { motion }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_point_of_the_box_comes_nearer_than_by_the_bound_and_turns_cost_little() {
        let mut state = 7u64;
        let mut random = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        };
        let bounds = Aabb { min: Vec3::new(-1.0, 0.25, -0.5), max: Vec3::new(0.5, 1.0, 2.0) };
        let ball = Ball::around(&bounds);
        let mut spared = 0;
        for round in 0..100_000 {
            let away = [1.0, 3.0, 30.0, 3e3, 1e8][round % 5];
            let step = [1e-6, 1e-3, 1.0, 10.0][round / 5 % 4];
            let mut vector = |size: f64| DVec3::new(random(), random(), random()) * size;
            let (from, by) = (vector(away), vector(step));
            let mut to = from + by;
            if round % 3 == 0 {
                // The same distance from the centre.
                let seen = to - ball.centre;
                to = ball.centre + seen * (from.distance(ball.centre) / seen.length());
            }
            let (low, high) = (bounds.min.as_dvec3(), bounds.max.as_dvec3());
            let inside = low + (high - low) * (vector(0.5) + 0.5);
            let bound = ball.approach(from, to);
            // Differences of lengths in f64 carry as much.
            let rounding = 1e-15 * (away + step + 3.0);
            let change = (from.distance(inside) - to.distance(inside)).abs();
            assert!(change <= bound + rounding, "{from} {to} {inside}: {change:e} {bound:e}");
            assert!(bound <= from.distance(to), "{from} {to}: {bound:e}");
            spared += u32::from(bound < 0.2 * from.distance(to));
        }
        assert!(spared > 10_000, "{spared}");
    }
}
