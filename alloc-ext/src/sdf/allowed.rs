//! The width that the interval of a place may have at most.

use super::domain::Domain;
use meshsweep_core::SdfKind;

/// What the questions in f32 add to a width, units. A point on an upper face of the field is asked
/// as one beyond it, which adds three on each side. Rounding adds less than one to each end.
const WIDENED_BY_F32: f64 = 8.0;

/// A width that is allowed everywhere, and how it grows with the distance.
#[derive(Clone, Copy, Debug)]
pub(super) struct Allowed {
    /// Units.
    error: f64,
    per_distance: f64,
    kind: SdfKind,
}

impl Allowed {
    /// A length in the mesh's unit, and a part of the distance.
    pub fn new(error: f64, per_distance: f64, domain: &Domain, kind: SdfKind) -> Self {
        Self { error: error * f64::from(domain.per_unit), per_distance, kind }
    }

    /// How much of the allowed width the intervals of a cell take: 1 is all of it. Their lower ends
    /// are between these numbers of units, each upper end is `width` above.
    ///
    /// The distance that widens what is allowed is the least that the intervals themselves leave.
    pub fn taken(&self, lower: [f64; 2], width: f64) -> f64 {
        let [least, most] = lower;
        let inside = if self.kind == SdfKind::Signed { -(most + width) } else { 0.0 };
        // A point may be a unit from its place.
        let distance = (least.max(inside) - 1.0).max(0.0);
        widest(self.kind, lower, width) / (self.error + self.per_distance * distance)
    }
}

/// The largest width of a cell's answers, units: an end below 0 stands for 0, if the field is not
/// signed.
pub(super) fn widest(kind: SdfKind, [_, most]: [f64; 2], width: f64) -> f64 {
    let cut = if kind == SdfKind::Signed { 0.0 } else { most.min(0.0) };
    (width + cut).max(0.0) + WIDENED_BY_F32
}
