//! Conditions on edge collapses, as a caller chooses them.

use super::{Conditions, Priority};
use crate::lp::Order;

/// Conditions on edge collapses that a caller may choose; `None` is the default.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CollapseOptions {
    /// Largest valence of a hull vertex. Default: 12.
    pub max_valence: Option<u32>,
    /// Least ratio of a star's worst compactness after a collapse to that before it. Default: 0.8.
    pub compactness: Option<f64>,
    /// Largest change of a face's normal in a collapse, in degrees. Default: 45.
    pub max_normal_deviation: Option<f64>,
    /// How candidate edges of outer hulls are ordered. Default: [`Priority::Program`].
    pub priority: Option<Priority>,
    /// The order in which the program of an outer hull's vertex takes the planes of a star.
    /// Default: [`Order::MostViolated`].
    pub order: Option<Order>,
}

impl CollapseOptions {
    /// The first given option, by the program's name.
    #[must_use]
    pub fn given(&self) -> Option<&'static str> {
        let Self { max_valence, compactness, max_normal_deviation, priority, order } = self;
        [
            ("--max-valence", max_valence.is_some()),
            ("--compactness", compactness.is_some()),
            ("--max-normal-deviation", max_normal_deviation.is_some()),
            ("--priority", priority.is_some()),
            ("--order", order.is_some()),
        ]
        .into_iter()
        .find_map(|(option, given)| given.then_some(option))
    }

    /// The conditions of a collapse.
    #[must_use]
    pub fn conditions(&self) -> Conditions {
        let default = Conditions::default();
        // The default's cosine of 45° may differ from this one in the last bit, and so would the
        // blob's bytes.
        let cosine = |degrees: f64| {
            if degrees == 45.0 { default.min_normal_cosine } else { degrees.to_radians().cos() }
        };
        Conditions {
            max_valence: self.max_valence.map_or(default.max_valence, |edges| edges as usize),
            compactness_ratio: self.compactness.unwrap_or(default.compactness_ratio),
            min_normal_cosine: self.max_normal_deviation.map_or(default.min_normal_cosine, cosine),
            order: self.order.unwrap_or(default.order),
            ..default
        }
    }
}
