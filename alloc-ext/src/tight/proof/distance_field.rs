//! Bounds of the distance from any point to the mesh, from exact distances at the points of a
//! lattice. These are computed when they are first asked for.

use super::obstacle::Obstacle;
use crate::tight::shared_map::SharedMap;
use glam::DVec3;
use rustc_hash::FxHashMap;

/// Bounds of the distance at the lattice points that were asked for.
#[derive(Clone, Debug)]
pub(crate) struct DistanceField {
    step: f64,
    known: SharedMap<[i32; 3], [f64; 2]>,
}

/// Number of points at which all are forgotten.
const CAPACITY: usize = 1 << 19;

/// More than the rounding of a bound, as a fraction of it.
const ROUNDING: f64 = 1e-12;

impl DistanceField {
    /// With a distance between lattice points.
    pub fn new(step: f64) -> Self {
        Self { step, known: SharedMap::default() }
    }

    /// Distance between lattice points.
    pub fn step(&self) -> f64 {
        self.step
    }

    /// Takes out the distances that no clone shares.
    pub fn take_added(&mut self) -> FxHashMap<[i32; 3], [f64; 2]> {
        self.known.take_added()
    }

    /// Adds distances that a clone computed.
    pub fn add(&mut self, distances: FxHashMap<[i32; 3], [f64; 2]>) {
        for (cell, bounds) in distances {
            self.known.insert(cell, bounds, CAPACITY);
        }
    }

    /// Bounds of a point's distance to the mesh, at most a step's diagonal apart.
    pub fn about(&mut self, obstacle: &Obstacle, p: DVec3) -> [f64; 2] {
        // Where the conversion saturates, the bounds include the distance to the lattice point.
        let cell = (p / self.step).round().to_array().map(|x| x as i32);
        let point = DVec3::from(cell.map(f64::from)) * self.step;
        let [lower, upper] = self.known.get(cell).unwrap_or_else(|| {
            let bounds = obstacle.nearest(point).map_or([0.0, f64::INFINITY], |(_, bounds)| bounds);
            self.known.insert(cell, bounds, CAPACITY);
            bounds
        });
        let away = (p - point).length();
        [lower * (1.0 - ROUNDING) - away * (1.0 + ROUNDING), (upper + away) * (1.0 + ROUNDING)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_hold_the_distance_near_and_far() {
        let corners = [[0.0, 0.0, 0.0], [3.0, 1.0, 0.0], [1.0, 4.0, 2.0]].map(DVec3::from);
        let obstacle = Obstacle::new(&corners, &[[0, 1, 2]]);
        for step in [1e-30, 1e-3, 0.25, 7.0, 1e30] {
            let mut field = DistanceField::new(step);
            for i in 0..2000u32 {
                // Points of a lattice that no step divides, up to where cells have no number.
                let at = |k: u32| f64::from(i.wrapping_mul(k) % 1013) / 101.3 - 5.0;
                let p = DVec3::new(at(7), at(131), at(577)) * if i % 3 == 0 { 1e6 } else { 1.0 };
                let [lower, upper] = obstacle.nearest(p).map(|(_, bounds)| bounds).unwrap();
                let about = field.about(&obstacle, p);
                assert!(
                    about[0] <= lower && upper <= about[1],
                    "{p} {about:?} {lower} {upper} {step}"
                );
                assert!(
                    step != 0.25 || i % 3 == 0 || about[1] - about[0] <= 2.0 * step,
                    "{about:?}"
                );
            }
        }
    }
}
