//! Random choices in double precision, so that a failing program can be named by its seed.

use glam::DVec3;

use crate::generate::Rng;

/// [`Rng`] with what programs need.
#[derive(Clone, Debug)]
pub struct Random(Rng);

impl Random {
    /// The sequence that `seed` names.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self(Rng::new(seed))
    }

    /// A whole number below `count`; 0 if `count` is 0.
    pub fn below(&mut self, count: usize) -> usize {
        self.0.below(count)
    }

    /// A number in `lower..upper`.
    pub fn within(&mut self, lower: f64, upper: f64) -> f64 {
        lower + (upper - lower) * self.0.unit_f64()
    }

    /// A direction, uniform on the sphere.
    pub fn direction(&mut self) -> DVec3 {
        loop {
            let v =
                DVec3::new(self.within(-1.0, 1.0), self.within(-1.0, 1.0), self.within(-1.0, 1.0));
            let length = v.length();
            if (0.1..1.0).contains(&length) {
                return v / length;
            }
        }
    }

    /// One of `choices`, which must not be empty.
    pub fn pick<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.below(choices.len())]
    }

    /// Puts `items` in random order.
    pub fn shuffle<T>(&mut self, items: &mut [T]) {
        for last in (1..items.len()).rev() {
            items.swap(last, self.below(last + 1));
        }
    }
}
