//! How deep two solids are in each other.

use super::answer::{Ended, Interval};
use super::verdict::Undecided;
use super::work::Work;
use crate::geom::Pose;

/// How two solids lie to each other. All but `Undecided` are proved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Relation {
    /// No point is inside both.
    Apart,
    /// The surfaces meet, or points are inside both.
    Overlap,
    /// The surfaces do not meet, and a component of the first one lies inside the second solid.
    /// Other components may lie outside.
    FirstInside,
    /// The surfaces do not meet, and a component of the second one lies inside the first solid.
    /// Other components may lie outside, and one of the first may lie inside the second as well.
    SecondInside,
    /// Nothing is proved.
    Undecided(Undecided),
}

/// How two solids lie to each other, and how deep they are in each other.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct Penetration {
    /// How they lie to each other.
    pub relation: Relation,
    /// Penetration depth: the length of the shortest translation after which no point is inside
    /// both, input units. `0 ..= 0` if they are apart, from 0 to infinity if a mesh has no sides.
    pub depth: Interval,
    /// A pose of the second model, with the same matrix, at which it is proved that they are apart.
    /// Its translation is at most `depth.upper` from the one in the question. `None` if none was
    /// found.
    pub apart: Option<Pose>,
    /// The point that proves `depth.lower`, in the first model's frame. It is inside both solids,
    /// and the sum of its depths in them is at least `depth.lower`. `None` if the lower end is 0.
    pub deepest: Option<[f32; 3]>,
    /// The work of all searches.
    pub work: Work,
    /// Why the search ended. [`Ended::Exact`]: every start and direction was tried. The interval
    /// may still be wide, because the search tries only some of them.
    pub ended: Ended,
}
