//! How far sets of points extend along the axes of a frame.

use glam::DVec3;

/// Coordinates may not exceed this in magnitude, grid units.
pub(super) const MAX_ABS_COORDINATE: f64 = 70_000.0;
/// Relative error of `M·(P − origin)` for fractional points: twice the proved bound. Proof:
/// head of `boxes.rs`.
const FRACTIONAL_MARGIN: f64 = 1.0 / (1u64 << 50) as f64;

/// The rows of a matrix, and the origin that is subtracted before.
#[derive(Clone, Copy)]
pub(super) struct Frame {
    pub matrix: [DVec3; 3],
    pub origin: DVec3,
}

impl Frame {
    /// Coordinate `k` of a difference from the origin. Monotone in each component, rounding
    /// included: the sign of the matrix's entry says whether it rises or falls.
    fn coordinate(&self, k: usize, d: DVec3) -> f64 {
        let row = self.matrix[k];
        row.x * d.x + row.y * d.y + row.z * d.z
    }

    /// The extent of a box. It contains the computed extent of any points in the box, because each
    /// rounded operation is monotone.
    pub(super) fn enclose(&self, bounds: &PointBounds) -> Extent {
        let (low, high) = (bounds.low - self.origin, bounds.high - self.origin);
        let end = |row: DVec3, if_negative: DVec3, else_: DVec3| {
            let pick = |k: usize| if row[k] < 0.0 { if_negative[k] } else { else_[k] };
            DVec3::new(pick(0), pick(1), pick(2))
        };
        let of = |k: usize, a: DVec3, b: DVec3| self.coordinate(k, end(self.matrix[k], a, b));
        Extent {
            low: [0, 1, 2].map(|k| of(k, high, low)),
            high: [0, 1, 2].map(|k| of(k, low, high)),
        }
    }

    /// Whether the axes are those of the grid, in order.
    pub(super) fn is_along_axes(&self) -> bool {
        let [x, y, z] = self.matrix;
        [x.y, x.z, y.x, y.z, z.x, z.y] == [0.0; 6]
    }
}

/// Box of a set of points in a frame, units of its matrix, relative to its origin.
#[derive(Clone, Copy)]
pub(super) struct Extent {
    pub low: [f64; 3],
    pub high: [f64; 3],
}

impl Extent {
    pub(super) const EMPTY: Self = Self { low: [f64::INFINITY; 3], high: [f64::NEG_INFINITY; 3] };

    pub(super) fn include(&mut self, points: &[DVec3], frame: &Frame) {
        for &point in points {
            debug_assert!(point.abs().max_element() <= MAX_ABS_COORDINATE);
            let d = point - frame.origin;
            for k in 0..3 {
                let q = frame.coordinate(k, d);
                self.low[k] = if q < self.low[k] { q } else { self.low[k] };
                self.high[k] = if q > self.high[k] { q } else { self.high[k] };
            }
        }
    }

    /// Widens by the rounding error of fractional coordinates.
    pub(super) fn widened(mut self, bounds: &PointBounds, frame: &Frame) -> Self {
        if bounds.is_fractional {
            let reach = (bounds.low - frame.origin).abs().max((bounds.high - frame.origin).abs());
            let reach = reach.max_element();
            for (k, row) in frame.matrix.iter().enumerate() {
                let row_sum = row.x.abs() + row.y.abs() + row.z.abs();
                self.low[k] -= FRACTIONAL_MARGIN * row_sum * reach;
                self.high[k] += FRACTIONAL_MARGIN * row_sum * reach;
            }
        }
        self
    }

    pub(super) fn contains(&self, other: &Self) -> bool {
        (0..3).all(|k| self.low[k] <= other.low[k] && other.high[k] <= self.high[k])
    }

    pub(super) fn union(mut self, other: &Self) -> Self {
        for k in 0..3 {
            self.low[k] = self.low[k].min(other.low[k]);
            self.high[k] = self.high[k].max(other.high[k]);
        }
        self
    }
}

/// Axis-aligned box of a set of points, and whether a coordinate is no integer.
#[derive(Clone, Copy)]
pub(super) struct PointBounds {
    low: DVec3,
    high: DVec3,
    is_fractional: bool,
}

impl PointBounds {
    pub(super) const EMPTY: Self =
        Self { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY, is_fractional: false };

    pub(super) fn of(points: &[DVec3]) -> Self {
        let mut bounds = Self::EMPTY;
        for &point in points {
            // An integer conversion and back is one cheap instruction each; `trunc` is a call on
            // targets without SSE 4.1.
            let is_fractional = point.to_array().iter().any(|&c| c as i64 as f64 != c);
            bounds = bounds.union(&Self { low: point, high: point, is_fractional });
        }
        bounds
    }

    pub(super) fn union(&self, other: &Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
            is_fractional: self.is_fractional | other.is_fractional,
        }
    }
}

/// A set of points whose extent can be computed.
pub(super) trait PointSet {
    /// The first point, if there is one.
    fn first(&self) -> Option<DVec3>;

    /// The extent of all points in a frame, widened where coordinates are fractional.
    fn extent(&self, frame: &Frame) -> Extent;
}

impl PointSet for &[DVec3] {
    fn first(&self) -> Option<DVec3> {
        <[DVec3]>::first(self).copied()
    }

    fn extent(&self, frame: &Frame) -> Extent {
        let mut extent = Extent::EMPTY;
        extent.include(self, frame);
        extent.widened(&PointBounds::of(self), frame)
    }
}
