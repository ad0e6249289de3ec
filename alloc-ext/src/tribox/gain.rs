//! What an option changed: triboxes of the finest level without it and with it.

use super::choose::Measure;
use super::extent::Extent;
use super::level::{faces_of, proxies};
use super::split::Hierarchy;
use crate::counted::Counted;
use crate::number::{About, Percent};
use std::fmt;

/// What the triboxes of a hierarchy's finest level have in all.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Total {
    /// Their number.
    pub triboxes: usize,
    /// Their faces, without those of no extent.
    pub faces: usize,
    /// Sum of their areas and of their volumes.
    pub extent: Extent,
}

impl Total {
    /// Of a hierarchy.
    #[must_use]
    pub fn of(hierarchy: &Hierarchy) -> Total {
        let triboxes = proxies(hierarchy, usize::MAX);
        let mut extent = Extent::default();
        for tribox in &triboxes {
            let Extent { area, volume } = Extent::of(tribox);
            extent.area += area;
            extent.volume += volume;
        }
        let faces = triboxes.iter().map(faces_of).sum();
        Total { triboxes: triboxes.len(), faces, extent }
    }

    /// Void beside a solid of this volume, as a part of it.
    #[must_use]
    pub fn void(&self, solid: f64) -> f64 {
        self.extent.volume / solid - 1.0
    }

    /// The number of triboxes if they are split by their error, and what they measure: the lesser
    /// is the better.
    pub(super) fn cost(&self, measure: Measure, is_by_error: bool) -> (usize, f64) {
        (if is_by_error { self.triboxes } else { 0 }, measure.of(self.extent))
    }
}

/// What an option changed at the finest level.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Gain {
    /// Without the option.
    pub before: Total,
    /// With it. `None` if it had nothing to change.
    pub after: Option<Total>,
    /// Whether the option made the triboxes fewer, where an error is asked for, else less in all.
    pub is_gain: bool,
}

impl Gain {
    /// Of what an option changed. `measure` is what splits minimise.
    #[must_use]
    pub fn of(before: Total, after: Total, measure: Measure, is_by_error: bool) -> Gain {
        let cost = |total: Total| total.cost(measure, is_by_error);
        Gain { before, after: Some(after), is_gain: cost(after) < cost(before) }
    }

    /// Of other planes: `plain` was split without them, `grown` with them. `oriented` is what a
    /// turn gained after that.
    #[must_use]
    pub fn of_planes(
        plain: &Hierarchy,
        grown: &Hierarchy,
        oriented: Option<Gain>,
        is_by_error: bool,
    ) -> Gain {
        let after = oriented.map_or_else(|| Total::of(grown), |gain| gain.before);
        Self::of(Total::of(plain), after, plain.measure, is_by_error)
    }

    /// The gain as words. `option` is the option as it was typed, `solid` the volume of the solid.
    #[must_use]
    pub fn said<'a>(&'a self, option: &'a str, solid: Option<f64>) -> impl fmt::Display + 'a {
        Said { gain: self, option, solid: solid.filter(|&volume| volume > 0.0) }
    }
}

struct Said<'a> {
    gain: &'a Gain,
    option: &'a str,
    solid: Option<f64>,
}

impl fmt::Display for Said<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Said { gain: Gain { before, after, is_gain }, option, solid } = self;
        f.write_str(if *is_gain { "gained by " } else { "nothing gained by " })?;
        let Some(after) = after else {
            return write!(f, "{option}: no turn was found with less than along the mesh's axes");
        };
        write!(f, "{option}: ")?;
        if let Some(solid) = *solid {
            let [before, after] = [before, after].map(|total| Percent(100.0 * total.void(solid)));
            write!(f, "void {before} % before, {after} % after; ")?;
        }
        let faces = [before, after].map(|total| total.faces);
        write!(
            f,
            "area {} before, {} after; {} of {} before, {} of {} after",
            About(before.extent.area),
            About(after.extent.area),
            Counted(faces[0], "face"),
            Counted(before.triboxes, "tribox"),
            Counted(faces[1], "face"),
            Counted(after.triboxes, "tribox"),
        )
    }
}
