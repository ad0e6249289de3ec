//! Axis-aligned boxes and half-spaces in `f64`.

use glam::DVec3;

/// An axis-aligned box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bounds {
    pub low: DVec3,
    pub high: DVec3,
}

impl Bounds {
    pub const EMPTY: Self = Self { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY };

    pub fn of(points: &[DVec3]) -> Self {
        points.iter().fold(Self::EMPTY, |bounds, &p| bounds.with(p))
    }

    pub fn with(self, p: DVec3) -> Self {
        Self { low: self.low.min(p), high: self.high.max(p) }
    }

    pub fn join(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// Larger by a distance on all sides, up to rounding.
    pub fn grown(self, distance: f64) -> Self {
        Self { low: self.low - distance, high: self.high + distance }
    }

    pub fn meets(&self, other: &Self) -> bool {
        self.low.cmple(other.high).all() && other.low.cmple(self.high).all()
    }

    /// Whether this box holds another one.
    pub fn contains(&self, other: &Self) -> bool {
        self.low.cmple(other.low).all() && other.high.cmple(self.high).all()
    }

    /// The axis along which it is longest; the first of equals.
    pub fn longest_axis(&self) -> usize {
        let extent = (self.high - self.low).to_array();
        (0..3).fold(0, |best, axis| if extent[axis] > extent[best] { axis } else { best })
    }

    /// Largest `normal · p` over the box.
    pub fn support(&self, normal: DVec3) -> f64 {
        let pick = |n: f64, low: f64, high: f64| n * if n > 0.0 { high } else { low };
        pick(normal.x, self.low.x, self.high.x)
            + pick(normal.y, self.low.y, self.high.y)
            + pick(normal.z, self.low.z, self.high.z)
    }
}

/// The half-space of the points with `normal · p ≥ offset`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plane {
    pub normal: DVec3,
    pub offset: f64,
}

impl Plane {
    /// `normal · p − offset`.
    #[inline]
    pub fn height(&self, p: DVec3) -> f64 {
        self.normal.dot(p) - self.offset
    }

    /// Whether a point is on that side.
    #[inline]
    pub fn holds(&self, p: DVec3) -> bool {
        self.normal.dot(p) >= self.offset
    }

    /// Whether a box has a point on that side.
    #[inline]
    pub fn reaches(&self, bounds: &Bounds) -> bool {
        bounds.support(self.normal) >= self.offset
    }
}
