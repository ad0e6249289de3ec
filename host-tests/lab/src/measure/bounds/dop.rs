//! Discrete oriented polytopes: intersections of slabs along fixed directions (Klosowski et al.
//! 1998), the tribox among them.

use glam::DVec3;

use super::clip::{Plane, Solid};

/// Directions, and what their polytope is called.
#[derive(Clone, Debug, PartialEq)]
pub struct Slabs {
    /// In tables, with what the directions are.
    pub name: &'static str,
    /// The same, short.
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
    /// All that are compared, least first. The 24-DOP is that of FCL (`fcl::KDOP`, `kDOP-inl.h`;
    /// hpp-fcl's too): three of the four corners, so not symmetric. Paper 001 cites one of 24
    /// planes and does not say which.
    #[must_use]
    pub fn all() -> Vec<Self> {
        let slabs =
            |label, name, groups: &[&[DVec3]]| Self { name, label, directions: groups.concat() };
        vec![
            slabs("box", "box (axes)", &[&AXES]),
            slabs("14-DOP", "14-DOP (axes, corners)", &[&AXES, &CORNERS]),
            slabs("tribox", "tribox = 18-DOP (axes, edges)", &[&AXES, &EDGES]),
            slabs(
                "24-DOP",
                "24-DOP (axes, edges, corners but x+y+z)",
                &[&AXES, &EDGES, &CORNERS[1..]],
            ),
            slabs("26-DOP", "26-DOP (axes, corners, edges)", &[&AXES, &CORNERS, &EDGES]),
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

    /// Its boundary; `centre` and `radius` are those of a ball about the points.
    #[must_use]
    pub fn solid(&self, slabs: &Slabs, centre: DVec3, radius: f64) -> Solid {
        let planes: Vec<Plane> = slabs
            .directions
            .iter()
            .zip(&self.ranges)
            .flat_map(|(&normal, &[low, high])| {
                [Plane { normal, offset: high }, Plane { normal: -normal, offset: -low }]
            })
            .collect();
        // Slabs that touch the ball leave corners outside of it, of these directions none further
        // than the cube's √3.
        Solid::new(&planes, centre, 2.0 * radius)
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
    use crate::measure::bounds::convex_hull::ConvexHull;
    use glam::{DMat3, DVec3};
    use meshsweep_host_tests::generate::{Rng, rough_sphere};

    fn within(inner: &Dop, outer: &Dop, slack: f64) -> bool {
        let mut pairs = inner.ranges.iter().zip(&outer.ranges);
        pairs.all(|([low, high], [outer_low, outer_high])| {
            *low >= outer_low - slack && *high <= outer_high + slack
        })
    }

    #[test]
    fn solids_touch_every_slab_and_stay_about_the_points_when_turned() {
        let (positions, _) = rough_sphere(2, 0.4, 1999);
        let points: Vec<DVec3> =
            positions.iter().map(|p| DVec3::from_array(p.map(f64::from))).collect();
        let mut rng = Rng::new(1998);
        for slabs in Slabs::all() {
            let dop = Dop::of(&slabs, points.iter().copied());
            let corners = dop.solid(&slabs, DVec3::ZERO, 1.4).vertices;
            let again = Dop::of(&slabs, corners.iter().copied());
            assert!(within(&again, &dop, 1e-8) && within(&dop, &again, 1e-8), "{}", slabs.name);
            for _ in 0..20 {
                let turn = DMat3::from_axis_angle(
                    DVec3::from_array(rng.direction().map(f64::from)).normalize(),
                    1.0,
                );
                let tight = Dop::of(&slabs, points.iter().map(|p| turn * *p));
                let loose = Dop::of(&slabs, corners.iter().map(|p| turn * *p));
                assert!(within(&tight, &loose, 1e-8), "{}", slabs.name);
            }
        }
    }

    /// Each of the first's slabs is one of the second's, so that the second is inside.
    fn is_among(fewer: &Slabs, more: &Slabs) -> bool {
        fewer.directions.iter().all(|d| more.directions.contains(d))
    }

    #[test]
    fn more_slabs_are_tighter_and_all_hold_the_points() {
        let all = Slabs::all();
        let labels = |more: &Slabs| -> Vec<&str> {
            all.iter().filter(|fewer| is_among(fewer, more)).map(|fewer| fewer.label).collect()
        };
        assert_eq!(labels(&all[3]), ["box", "tribox", "24-DOP"]);
        assert_eq!(labels(&all[4]), ["box", "14-DOP", "tribox", "24-DOP", "26-DOP"]);
        let mut rng = Rng::new(24);
        for seed in 0..20 {
            let (positions, _) = rough_sphere(1, 0.6, seed);
            let squeeze = DVec3::from_array(rng.point_in([0.2; 3], [1.0; 3]).map(f64::from));
            let points: Vec<DVec3> =
                positions.iter().map(|p| DVec3::from_array(p.map(f64::from)) * squeeze).collect();
            let hull = ConvexHull::new(&points).expect("not flat").volume();
            let solids = all.iter().map(|slabs| {
                let dop = Dop::of(slabs, points.iter().copied());
                for p in &points {
                    let mut along = slabs.directions.iter().map(|d| d.dot(*p)).zip(&dop.ranges);
                    assert!(
                        along.all(|(x, [low, high])| *low <= x && x <= *high),
                        "{}",
                        slabs.name
                    );
                }
                dop.solid(slabs, DVec3::ZERO, 1.6).volume()
            });
            let volumes: Vec<f64> = solids.collect();
            for (fewer, outer) in all.iter().zip(&volumes) {
                assert!(*outer >= hull * (1.0 - 1e-12), "{}", fewer.name);
                for (more, inner) in
                    all.iter().zip(&volumes).filter(|(more, _)| is_among(fewer, more))
                {
                    assert!(*inner <= outer * (1.0 + 1e-12), "{} in {}", more.name, fewer.name);
                }
            }
            assert!(
                volumes[3] < volumes[2] && volumes[4] < volumes[3],
                "three corners, and the fourth, cut something"
            );
        }
    }

    #[test]
    fn a_gap_along_one_direction_parts() {
        let tribox = &Slabs::all()[2];
        let point = |p: DVec3| Dop::of(tribox, std::iter::once(p));
        assert!(point(DVec3::ZERO).meets(&point(DVec3::ZERO)));
        assert!(!point(DVec3::ZERO).meets(&point(DVec3::X)));
        assert!(!point(DVec3::X).meets(&point(DVec3::ZERO)));
    }
}
