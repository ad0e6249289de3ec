//! How deep two solids are in each other.

use super::answer::{Ended, Interval};
use super::verdict::Undecided;
use super::work::Work;
use crate::geom::Pose;

/// How two solids lie to each other. All but `Undecided` are proved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Relation {
    /// No point is inside both.
    Apart,
    /// Points are inside both, and the surfaces meet or may meet.
    Overlap,
    /// The surfaces do not meet, and a part of the first solid lies inside the second.
    FirstInside,
    /// The surfaces do not meet, and a part of the second solid lies inside the first.
    SecondInside,
    /// Nothing is proved.
    Undecided(Undecided),
}

/// How two solids lie to each other, and how deep they are in each other.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Penetration {
    /// How they lie to each other.
    pub relation: Relation,
    /// The length of the shortest translation after which no point is inside both, input units.
    /// `0 ..= 0` if they are apart, from 0 to infinity if a mesh has no sides.
    pub depth: Interval,
    /// A pose of the second model, with the same matrix, at which it is proved that they are apart.
    /// Its translation is `depth.upper` away from the one asked about. `None` if no translation was
    /// found.
    pub apart: Option<Pose>,
    /// The point that proves `depth.lower`, in the first model's frame: so far inside both together
    /// that no shorter translation parts them. `None` if the lower end is 0.
    pub deepest: Option<[f32; 3]>,
    /// The work of all searches.
    pub work: Work,
    /// Why the search ended. [`Ended::Exact`]: everything was tried; the interval is as wide as it
    /// is all the same.
    pub ended: Ended,
}
