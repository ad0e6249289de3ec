//! Distances, segments, motions.

use super::points::points;
use meshsweep_core::internal::tribox::{DIRECTIONS, SLABS};
use meshsweep_core::{Pose, Tribox};
use meshsweep_host_tests::generate::Rng;

#[test]
fn segments_are_clipped_outward() {
    let mut rng = Rng::new(10);
    let mut met = 0;
    for _ in 0..20_000 {
        let tribox = Tribox::of_points(points(&mut rng)).unwrap();
        let mut end = || [0; 3].map(|_: i32| (rng.below(4001) as f32 - 2000.0) / 256.0);
        let (a, b) = (end(), end());
        let exact = |t: f64| {
            let p: [f64; 3] =
                std::array::from_fn(|k| f64::from(a[k]) + t * (f64::from(b[k]) - f64::from(a[k])));
            (0..SLABS).all(|slab| {
                let d = DIRECTIONS[slab].map(f64::from);
                let here = d[0] * p[0] + d[1] * p[1] + d[2] * p[2];
                f64::from(tribox.low[slab]) <= here && here <= f64::from(tribox.high[slab])
            })
        };
        let clipped = tribox.clip(a, b);
        for step in 0..=64 {
            let t = f64::from(step) / 64.0;
            if exact(t) {
                let (enter, leave) = clipped.expect("a point of the segment is inside");
                assert!(f64::from(enter) <= t && t <= f64::from(leave));
                met += 1;
            }
        }
        if let Some((enter, leave)) = clipped {
            let middle = f64::midpoint(f64::from(enter), f64::from(leave));
            assert!(leave - enter < 1e-5 || exact(middle), "{tribox:?} {a:?} {b:?} {clipped:?}");
        }
    }
    assert!(met > 1000, "{met}");
}

#[test]
fn distances_are_below_those_to_the_vertices_hull_and_exact_beyond_faces() {
    let mut rng = Rng::new(11);
    for _ in 0..5_000 {
        let points = points(&mut rng);
        let tribox = Tribox::of_points(points.iter().copied()).unwrap();
        let p = [0; 3].map(|_: i32| (rng.below(4001) as f32 - 2000.0) / 64.0);
        let lower = f64::from(tribox.distance(p));
        for point in points {
            let way =
                glam::Vec3::from_array(p).as_dvec3() - glam::Vec3::from_array(point).as_dvec3();
            assert!(lower <= way.length());
        }
        if tribox.contains_point(p) {
            assert_eq!(lower, 0.0);
        }
    }
    let corners = (0..8).map(|i| [i & 1, i >> 1 & 1, i >> 2].map(|bit| bit as f32));
    let cube = Tribox::of_points(corners).unwrap();
    assert!((cube.distance([0.5, 0.5, 3.0]) - 2.0).abs() < 1e-5);
    for scale in [1e-30f32, 1e-10, 1.0, 1e10, 1e30] {
        let cube = Tribox::of_points([[0.0; 3], [scale; 3]]).unwrap();
        let distance = cube.distance([3.0 * scale; 3]);
        assert!(distance <= 3.465 * scale && distance > 3.46 * scale, "{scale} {distance}");
    }
    assert_eq!(Tribox::EMPTY.distance([0.0; 3]), f32::INFINITY);
}

#[test]
fn what_is_moved_stays_inside() {
    let mut rng = Rng::new(12);
    for _ in 0..3_000 {
        let points = points(&mut rng);
        let (sine, cosine) = (rng.below(6283) as f64 * 1e-3).sin_cos();
        let (s, c) = (sine as f32, cosine as f32);
        let t = [0; 3].map(|_: i32| rng.below(1000) as f32 * 0.1 - 50.0);
        let pose =
            Pose::rigid([[c, -s, 0.0], [0.6 * s, 0.6 * c, -0.8], [0.8 * s, 0.8 * c, 0.6]], t);
        let tight = pose.bound(points.iter().copied()).unwrap();
        let loose = Tribox::of_points(points.iter().copied()).unwrap().moved(&pose).unwrap();
        for point in &points {
            let p = point.map(f64::from);
            let q: [f64; 3] = std::array::from_fn(|k| {
                let row = pose.rotation[k].map(f64::from);
                row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + f64::from(t[k])
            });
            for (slab, direction) in DIRECTIONS.iter().enumerate() {
                let d = direction.map(f64::from);
                let here = d[0] * q[0] + d[1] * q[1] + d[2] * q[2];
                for bound in [&tight, &loose] {
                    assert!(
                        f64::from(bound.low[slab]) <= here && here <= f64::from(bound.high[slab])
                    );
                }
            }
        }
    }
    let point = Tribox::of_point([1.0, 2.0, 3.0]).unwrap();
    let there = point.moved(&Pose::IDENTITY).unwrap();
    assert!(there.contains(&point) && there.high[0] - there.low[0] < 3e-5);
    assert!(Pose::rigid([[3.0; 3]; 3], [0.0; 3]).bound([[0.0; 3]]).is_err());
}

#[test]
fn what_f32_cannot_sum_is_neither_clear_nor_far() {
    let cube =
        Tribox::of_points([[-1.0; 3], [1.0; 3], [1.0, -1.0, 1.0], [-1.0, 1.0, -1.0]]).unwrap();
    assert!(
        cube.clip([2e38, -3.0, 0.0], [-2e38, 3.0, 0.0])
            .is_some_and(|(enter, leave)| enter <= 0.5 && 0.5 <= leave)
    );
    assert!(
        cube.clip([2e38, 0.0, 0.0], [-2e38, 0.0, 0.0])
            .is_some_and(|(enter, leave)| enter <= 0.5 && 0.5 <= leave)
    );
    let distance = cube.distance([2e38, 2e38, 0.0]);
    assert!(distance > 1.9e38 && distance < 2.83e38, "{distance}");
    // One unit of the subnormal range, by √2 outward.
    let ulp = f32::from_bits(1);
    let padded = Tribox::of_point([0.0; 3]).unwrap().padded(ulp).unwrap();
    assert!(padded.high[3] >= f32::from_bits(2) && padded.high[0] == ulp);
}
