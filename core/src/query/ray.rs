//! Rays. A ray is asked as a segment that ends behind the model, at a parameter that is a power of
//! two. So its direction keeps its bits, and parameters of the segment become the ray's without
//! rounding.

use super::error::QueryError;
use super::hits::{AllHits, FirstHit, TriangleHit};
use crate::num::{down_to_f32, exp2, up_to_f32};

/// A ray whose direction is finite and not zero, input units.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ray {
    pub(crate) origin: [f32; 3],
    direction: [f64; 3],
    /// The greatest component of the direction, without sign.
    largest: f64,
}

/// How a ray goes on behind the model.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Behind {
    /// The way from the origin to a place behind the model, exact.
    pub(crate) way: [f64; 3],
    /// The ray's parameter of that place: a power of two.
    pub(crate) parameter: f64,
}

impl Ray {
    pub(crate) fn new(origin: [f32; 3], direction: [f32; 3]) -> Result<Ray, QueryError> {
        if !origin.iter().chain(&direction).all(|x| x.is_finite()) {
            return Err(QueryError::NotFinite);
        }
        let direction = direction.map(f64::from);
        let largest = direction.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        if largest == 0.0 {
            return Err(QueryError::NoDirection);
        }
        Ok(Ray { origin, direction, largest })
    }

    /// A place on the ray that is farther from the origin than `beyond` along some axis, but no
    /// farther than four times as much along any. `unit`: lengths of `beyond` in an input unit, a
    /// power of two.
    pub(crate) fn behind(&self, unit: f64, beyond: f64) -> Behind {
        let ratio = beyond / (self.largest * unit);
        let exponent = ((ratio.to_bits() >> 52) as i32).wrapping_sub(1022);
        let parameter = exp2(exponent);
        Behind { way: self.direction.map(|x| x * unit * parameter), parameter }
    }
}

/// A parameter of the segment as the ray's, rounded to f32 and kept finite.
fn nearest(t: f32, parameter: f64) -> f32 {
    ((f64::from(t) * parameter) as f32).min(f32::MAX)
}

impl FirstHit {
    /// The answer about a segment, as that about the ray.
    pub(crate) fn of_ray(mut self, parameter: f64) -> FirstHit {
        // Infinite only where there is no hit: a finite bound stays finite.
        if self.t.lower < f32::INFINITY {
            self.t.lower = down_to_f32(f64::from(self.t.lower) * parameter);
        }
        self.t.upper = up_to_f32(f64::from(self.t.upper) * parameter);
        if let Some(hit) = &mut self.hit {
            hit.t = nearest(hit.t, parameter);
        }
        self
    }
}

impl AllHits {
    /// The answer about a segment, as that about the ray.
    pub(crate) fn of_ray(self, hits: &mut [TriangleHit], parameter: f64) -> AllHits {
        for listed in hits.iter_mut().take(self.stored) {
            listed.hit.t = nearest(listed.hit.t, parameter);
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::noise::Noise;
    use crate::query::{Ended, Interval, Work};

    #[test]
    fn the_place_is_behind_and_the_direction_keeps_its_bits() {
        let mut noise = Noise(5);
        for (round, exponent) in (0..10_000).zip((-100..100).cycle()) {
            let size = [1.0, 1e-30, 1e30, 1e-44][round % 4];
            let direction = [(); 3].map(|()| noise.unit() * size);
            let Ok(ray) = Ray::new([0.0; 3], direction) else { continue };
            let (unit, beyond) = (exp2(exponent), f64::from(noise.unit().abs()) + 1.0);
            let Behind { way, parameter } = ray.behind(unit, beyond);
            let most = way.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
            assert!(beyond < most && most <= 4.0 * beyond, "{beyond} {most}");
            for (way, direction) in way.iter().zip(direction) {
                assert_eq!(way / parameter / unit, f64::from(direction));
            }
        }
    }

    #[test]
    fn rays_without_a_direction_and_numbers_that_are_none_are_refused() {
        let refused = |origin, direction| Ray::new(origin, direction).err();
        assert_eq!(refused([0.0; 3], [0.0, -0.0, 0.0]), Some(QueryError::NoDirection));
        assert_eq!(refused([0.0; 3], [0.0, f32::NAN, 1.0]), Some(QueryError::NotFinite));
        assert_eq!(refused([0.0; 3], [f32::INFINITY, 0.0, 1.0]), Some(QueryError::NotFinite));
        assert_eq!(refused([f32::NEG_INFINITY, 0.0, 0.0], [1.0; 3]), Some(QueryError::NotFinite));
        assert_eq!(refused([0.0; 3], [1e-45, 0.0, 0.0]), None);
    }

    #[test]
    fn a_parameter_beyond_f32_proves_no_clear_ray() {
        let (t, ended) = (Interval::new(0.25, 0.5), Ended::Exact);
        let far = FirstHit { t, hit: None, work: Work::NONE, ended }.of_ray(exp2(400));
        assert_eq!(far.t, Interval::new(f32::MAX, f32::INFINITY));
        assert!(!far.is_clear() && FirstHit::CLEAR.of_ray(exp2(-400)).is_clear());
        let near = FirstHit { t, hit: None, work: Work::NONE, ended }.of_ray(exp2(-400));
        assert_eq!(near.t, Interval::new(0.0, f32::from_bits(1)));
    }
}
