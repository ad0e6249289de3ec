//! Discrete oriented polytopes: intersections of slabs along fixed directions (Klosowski et al.
//! 1998), the tribox among them.

use glam::DVec3;

/// Directions, and the name of their polytope.
#[derive(Clone, Debug, PartialEq)]
pub struct Slabs {
    /// Of the polytope.
    pub label: &'static str,
    /// One a slab, not of length 1.
    pub directions: Vec<DVec3>,
}

const AXES: [DVec3; 3] = [DVec3::X, DVec3::Y, DVec3::Z];
const EDGES: [DVec3; 6] = [
    DVec3::new(1.0, 1.0, 0.0),
    DVec3::new(1.0, -1.0, 0.0),
    DVec3::new(0.0, 1.0, 1.0),
    DVec3::new(0.0, 1.0, -1.0),
    DVec3::new(1.0, 0.0, 1.0),
    DVec3::new(-1.0, 0.0, 1.0),
];
const CORNERS: [DVec3; 4] = [
    DVec3::new(1.0, 1.0, 1.0),
    DVec3::new(1.0, 1.0, -1.0),
    DVec3::new(1.0, -1.0, 1.0),
    DVec3::new(-1.0, 1.0, 1.0),
];

impl Slabs {
    /// Those of the papers, least first.
    #[must_use]
    pub fn all() -> Vec<Self> {
        let slabs = |label, groups: &[&[DVec3]]| Self { label, directions: groups.concat() };
        vec![
            slabs("box", &[&AXES]),
            slabs("14-DOP", &[&AXES, &CORNERS]),
            slabs("tribox", &[&AXES, &EDGES]),
            slabs("26-DOP", &[&AXES, &CORNERS, &EDGES]),
        ]
    }
}

/// The extent along each direction.
#[derive(Clone, Debug, PartialEq)]
pub struct Dop {
    /// Least and greatest inner product, in the order of [`Slabs::directions`].
    pub ranges: Vec<[f64; 2]>,
}

impl Dop {
    /// The tightest about some points.
    #[must_use]
    pub fn of(slabs: &Slabs, points: impl Iterator<Item = DVec3>) -> Self {
        let mut ranges = vec![[f64::INFINITY, f64::NEG_INFINITY]; slabs.directions.len()];
        for p in points {
            for ([low, high], direction) in ranges.iter_mut().zip(&slabs.directions) {
                let along = direction.dot(p);
                *low = low.min(along);
                *high = high.max(along);
            }
        }
        Self { ranges }
    }

    /// Whether no direction parts the two. This is the usual test, exact of boxes only: two others
    /// may be apart although their ranges overlap along every direction.
    #[must_use]
    pub fn meets(&self, other: &Self) -> bool {
        let mut pairs = self.ranges.iter().zip(&other.ranges);
        pairs.all(|([low, high], [other_low, other_high])| high >= other_low && other_high >= low)
    }
}

#[cfg(test)]
mod tests {
    use super::{Dop, Slabs};
    use glam::DVec3;

    #[test]
    fn a_gap_along_one_direction_parts() {
        let tribox = &Slabs::all()[2];
        let point = |p: DVec3| Dop::of(tribox, std::iter::once(p));
        assert!(point(DVec3::ZERO).meets(&point(DVec3::ZERO)));
        assert!(!point(DVec3::ZERO).meets(&point(DVec3::X)));
        assert!(!point(DVec3::X).meets(&point(DVec3::ZERO)));
    }
}
