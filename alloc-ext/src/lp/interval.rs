//! The program in one variable.

/// The values of `t` that satisfy every `rate · t >= bound` so far: a closed interval, perhaps
/// unbounded or empty.
pub(super) struct Interval {
    lower: f64,
    upper: f64,
}

impl Interval {
    /// Every number.
    pub(super) const ALL: Self = Self { lower: f64::NEG_INFINITY, upper: f64::INFINITY };

    /// Adds the constraint `rate · t >= bound`; `rate` must not be zero.
    #[inline(always)]
    pub(super) fn clip(&mut self, rate: f64, bound: f64) {
        let t = bound / rate;
        // Conditional moves, for the sign is not predictable.
        let lower = if rate > 0.0 { t } else { f64::NEG_INFINITY };
        let upper = if rate > 0.0 { f64::INFINITY } else { t };
        self.lower = if lower > self.lower { lower } else { self.lower };
        self.upper = if upper < self.upper { upper } else { self.upper };
    }

    /// The point of the interval nearest to `target`: the optimum of any convex objective with its
    /// minimum there. `None` if the interval is empty.
    #[inline(always)]
    pub(super) fn nearest(&self, target: f64) -> Option<f64> {
        (self.lower <= self.upper).then(|| target.max(self.lower).min(self.upper))
    }

    /// As [`Interval::nearest`], but for an empty interval the point half way between its ends.
    pub(super) fn nearest_or_middle(&self, target: f64) -> f64 {
        self.nearest(target).unwrap_or(0.5 * (self.lower + self.upper))
    }
}
