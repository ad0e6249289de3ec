//! Units of length, and meshes scaled from one to another.

use super::{MeshError, RawMesh};
use std::fmt;

/// A unit of length. `Display` prints its symbol.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Micrometres.
    Um,
    /// Millimetres.
    Mm,
    /// Centimetres.
    Cm,
    /// Metres.
    M,
    /// Inches.
    In,
    /// Feet.
    Ft,
}

impl Unit {
    /// All units.
    pub const ALL: [Self; 6] = [Self::Um, Self::Mm, Self::Cm, Self::M, Self::In, Self::Ft];

    /// The unit's symbol, as `mm`.
    #[must_use]
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Um => "um",
            Self::Mm => "mm",
            Self::Cm => "cm",
            Self::M => "m",
            Self::In => "in",
            Self::Ft => "ft",
        }
    }

    /// A length that is given in another unit, in this one.
    #[must_use]
    pub fn of(self, length: f64, unit: Unit) -> f64 {
        length * unit.micrometres() / self.micrometres()
    }

    /// The nearest number.
    pub(super) fn metres(self) -> f64 {
        self.micrometres() / 1e6
    }

    /// Exact.
    fn micrometres(self) -> f64 {
        match self {
            Self::Um => 1.0,
            Self::Mm => 1e3,
            Self::Cm => 1e4,
            Self::M => 1e6,
            Self::In => 25_400.0,
            Self::Ft => 304_800.0,
        }
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.symbol())
    }
}

impl RawMesh {
    /// The mesh in another unit. Coordinates of a file that tells no unit are taken to be in
    /// `unit` already. [`error`](Self::error) grows by the rounding to `f64`.
    ///
    /// # Errors
    /// [`MeshError::TooLarge`].
    pub fn in_unit(mut self, unit: Unit) -> Result<Self, MeshError> {
        let from = self.unit.replace(unit).unwrap_or(unit);
        if from == unit {
            return Ok(self);
        }
        let (times, by) = (from.micrometres(), unit.micrometres());
        let mut largest = 0f64;
        for (vertex, at) in self.positions.iter_mut().enumerate() {
            *at = at.map(|x| x * times / by);
            if !at.iter().all(|x| x.is_finite()) {
                return Err(MeshError::TooLarge { file: self.file, vertex, at: *at });
            }
            largest = largest.max(at.iter().map(|x| x.abs()).sum());
        }
        // A product, a quotient, and the decimal before them: each by half a unit in the last
        // place of a coordinate. The sum over the axes bounds the distance.
        let scaled = self.error * times / by * (1.0 + 4.0 * f64::EPSILON);
        self.error = (scaled + 2.0 * f64::EPSILON * largest).next_up();
        Ok(self)
    }
}
