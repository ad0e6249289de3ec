//! Distances in the frame of a model that a pose moved, and those in the world. Derivation:
//! `core/docs/rounding.md` §15.

use crate::num::tolerance::U64;
use crate::num::{down_to_f32, greater, up_to_f32};
use crate::query::answer::Interval;

/// How distances in a moved model's frame differ from those in the world.
pub(crate) struct WorldLengths {
    /// A place is no farther than this from the one that was meant, in the model's frame.
    pub(crate) error: f64,
    /// The pose changes lengths by a factor within `1 ± stretch`.
    pub(crate) stretch: f64,
}

impl WorldLengths {
    /// The distance in the world, from that in the model's frame.
    pub(crate) fn in_world(&self, distance: Interval) -> Interval {
        let lower = (f64::from(distance.lower) - self.error) * (1.0 - self.stretch);
        let upper = (f64::from(distance.upper) + self.error) * (1.0 + self.stretch);
        Interval::new(down_to_f32(greater(0.0, lower)), up_to_f32(upper))
    }

    /// If nothing is within this distance in the model's frame, nothing is within `distance` in the
    /// world.
    pub(crate) fn at_most(&self, distance: f32) -> f32 {
        let in_model = f64::from(distance) / (1.0 - self.stretch) + self.error;
        up_to_f32(in_model * (1.0 + 4.0 * U64))
    }

    /// What is within this distance in the model's frame is within `distance` in the world. `None`
    /// if no distance is.
    pub(crate) fn at_least(&self, distance: f32) -> Option<f32> {
        let in_model = (f64::from(distance) / (1.0 + self.stretch)) * (1.0 - 4.0 * U64);
        let in_model = in_model - self.error * (1.0 + 4.0 * U64);
        (in_model >= 0.0).then(|| down_to_f32(in_model))
    }
}
