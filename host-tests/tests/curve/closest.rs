//! Closest points: intervals hold, the segment is the closest, and it stays while the query moves
//! less than the answer says.

use super::scenes::{Scene, scenes, scratch};
use meshsweep::curve::{CurveOptions, Polyline, build};
use meshsweep::progress::Watch;
use meshsweep_core::{Blob, Budget, CurveClosest, CurveSegment, Ended, QueryError};
use meshsweep_host_tests::generate::Rng;
use meshsweep_host_tests::generate::curves::{
    circle, closed, open, spiral, tool_path, walk, zig_zag,
};
use meshsweep_host_tests::oracle::Bounded;

/// The interval contains the truth, and the point and the segment are not farther than its end.
fn holds(scene: &Scene, p: [f32; 3], truth: Bounded, near: &CurveClosest) {
    let told = || format!("{} {p:?} {truth:?} {near:?}", scene.name);
    let (lower, upper) = (f64::from(near.distance.lower), f64::from(near.distance.upper));
    assert!(lower <= truth.upper && truth.lower <= upper, "{}", told());
    let segment = scene.distance(p, near.segment);
    assert!(segment.lower <= upper, "{}", told());
    let way: f64 = (0..3).map(|k| (f64::from(p[k]) - f64::from(near.point[k])).powi(2)).sum();
    let rounding = near.point.iter().map(|x| f64::from(x.abs())).sum::<f64>() * 1.2e-7;
    assert!(way.sqrt() <= upper * (1.0 + 1e-12) + rounding, "{}", told());
}

#[test]
fn intervals_contain_the_distance_with_any_scratch_and_are_as_narrow_as_the_storage() {
    for scene in scenes() {
        let curve = scene.curve();
        let error = 2.0 * f64::from(curve.surface_error());
        let enough = curve.scratch_entries();
        for p in scene.points(60, 5) {
            let truth = scene.truth(p);
            let ask = |entries: usize| {
                curve.closest_point(p, Budget::EXACT, &mut scratch(entries)).expect("finite")
            };
            let exact = ask(enough);
            for entries in [1, 2, 3, enough, enough + 1, 2 * enough + 3, 400] {
                let near = ask(entries);
                holds(&scene, p, truth, &near);
                if near.ended == Ended::Exact {
                    let same = (near.distance, near.point, near.segment, near.t);
                    assert_eq!(same, (exact.distance, exact.point, exact.segment, exact.t));
                } else {
                    assert!(near.ended == Ended::Scratch && entries < enough, "{near:?}");
                }
            }
            let width = f64::from(exact.distance.upper) - f64::from(exact.distance.lower);
            let size = f64::from(scene.size()) + truth.upper;
            let allowed = error + 4e-7 * truth.upper + 5e-14 * size;
            let is_far = truth.upper > 1e7 * f64::from(scene.size());
            assert!(is_far || width <= allowed, "{} {p:?} {exact:?} {error}", scene.name);
        }
    }
}

#[test]
fn every_budget_keeps_the_interval_and_meets_what_it_asks() {
    for scene in scenes() {
        let curve = scene.curve();
        let entries = 2 * curve.scratch_entries();
        for (k, p) in (0..).zip(scene.points(30, 6)) {
            let truth = scene.truth(p);
            let absolute = 0.01 * scene.size();
            for budget in [
                Budget::EXACT.with_steps(k),
                Budget::EXACT.with_relative(0.2),
                Budget::EXACT.with_absolute(absolute),
            ] {
                let near = curve.closest_point(p, budget, &mut scratch(entries)).expect("finite");
                holds(&scene, p, truth, &near);
                let steps_kept = near.work.opened <= budget.steps;
                assert!(steps_kept && near.ended != Ended::Scratch, "{near:?}");
                let width = near.distance.upper - near.distance.lower;
                let tolerable =
                    near.distance.upper <= near.distance.lower * 1.2 || width <= budget.absolute;
                assert!(near.ended != Ended::Tolerance || tolerable, "{near:?}");
            }
        }
    }
}

#[test]
fn the_segment_stays_while_the_query_moves_less_than_told() {
    let (mut known, mut asked) = (0, 0);
    for scene in scenes() {
        let curve = scene.curve();
        let mut rng = Rng::new(9);
        for p in scene.points(40, 7) {
            let mut memory = scratch(64);
            let near = curve.closest_point(p, Budget::EXACT, &mut memory).expect("finite");
            asked += 1;
            if near.safe_motion == 0.0 {
                continue;
            }
            known += 1;
            for _ in 0..4 {
                let way = rng.direction();
                let moved: [f32; 3] =
                    std::array::from_fn(|k| p[k] + 0.999 * near.safe_motion * way[k]);
                let length: f64 =
                    (0..3).map(|k| (f64::from(moved[k]) - f64::from(p[k])).powi(2)).sum();
                // Rounding may have moved it farther, or beyond f32.
                if length.sqrt() >= f64::from(near.safe_motion)
                    || !moved.iter().all(|x| x.is_finite())
                {
                    continue;
                }
                let others = scene.segments.iter().filter(|(_, name)| *name != near.segment);
                let others = meshsweep_host_tests::oracle::distance_to_segments(
                    moved,
                    others.map(|(ends, _)| *ends),
                );
                let still = scene.distance(moved, near.segment);
                assert!(still.lower <= others.upper, "{} {p:?} {near:?}", scene.name);
            }
        }
    }
    assert!(3 * known > asked, "{known} of {asked}");
}

#[test]
fn of_equal_distances_the_first_segment_is_named() {
    let first = |polylines: &[Polyline], p: [f32; 3]| {
        let scene = Scene::new("ties", polylines, true);
        [1, 2, 64].map(|entries| {
            let near = scene.curve().closest_point(p, Budget::EXACT, &mut scratch(entries));
            near.expect("finite")
        })[2]
    };
    let name = |polyline, segment| CurveSegment { polyline, segment };
    // A corner belongs to two segments, and so do repeated points.
    let [a, b, c] = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]];
    let corner = first(&[open(vec![a, b, c])], [3.0, -2.0, 0.5]);
    assert_eq!((corner.segment, corner.t, corner.point), (name(0, 0), 1.0, [1.0, 0.0, 0.0]));
    assert_eq!(corner.safe_motion, 0.0);
    let repeated = first(&[open(vec![c, c, b]), open(vec![c, c, c])], [2.0, 5.0, 0.0]);
    assert_eq!((repeated.segment, repeated.t), (name(0, 0), 0.0));
    let square = closed(vec![a, b, c, [0.0, 1.0, 0.0]]);
    let centre = first(std::slice::from_ref(&square), [0.5, 0.5, 0.0]);
    assert_eq!((centre.segment, centre.distance.lower <= 0.5), (name(0, 0), true));
    // The closing segment is the last one. No segment joins two polylines.
    assert_eq!(first(&[square], [-1.0, 0.5, 0.0]).segment, name(0, 3));
    let apart = [open(vec![a, b]), open(vec![[9.0, 0.0, 0.0], [10.0, 0.0, 0.0]])];
    let between = first(&apart, [5.5, 0.0, 0.0]);
    assert_eq!(between.segment, name(1, 0));
    assert!(between.distance.lower <= 3.5 && between.distance.upper < 3.500_001);
}

#[test]
fn wrong_questions_are_refused_and_far_ones_answered() {
    let scene = Scene::new("circle", &[circle(40)], true);
    let curve = scene.curve();
    let ask = |p, budget, entries| curve.closest_point(p, budget, &mut scratch(entries));
    assert_eq!(ask([0.0, f32::NAN, 0.0], Budget::EXACT, 9), Err(QueryError::NotFinite));
    assert_eq!(ask([f32::INFINITY, 0.0, 0.0], Budget::EXACT, 9), Err(QueryError::NotFinite));
    let negative = Budget::EXACT.with_relative(-1.0);
    assert_eq!(ask([0.0; 3], negative, 9), Err(QueryError::Tolerance));
    assert_eq!(ask([0.0; 3], Budget::EXACT, 0), Err(QueryError::NoScratch));
    for p in [[1e9, 0.0, 0.0], [f32::MAX, -f32::MAX, f32::MAX], [-1e20, 3.0, 1e-30]] {
        let near = ask(p, Budget::EXACT, 1).expect("finite");
        holds(&scene, p, scene.truth(p), &near);
        assert!(near.distance.upper <= near.distance.lower * 1.000_001, "{near:?}");
    }
}

/// Capsules and f64 segments of a query, in mean.
fn work(scene: &Scene, far: bool, entries: usize) -> [f64; 2] {
    let curve = scene.curve();
    let points = scene.points(1000, 3);
    let wanted = |kind: usize| if far { kind >= 8 } else { (4..7).contains(&kind) };
    let asked = || points.iter().enumerate().filter(|(k, _)| wanted(k % 10));
    let works = asked().map(|(_, &p)| {
        let near = curve.closest_point(p, Budget::EXACT, &mut scratch(entries)).expect("finite");
        [near.work.bounds, near.work.exact].map(f64::from)
    });
    let sum = works.fold([0.0; 2], |sum, work| [sum[0] + work[0], sum[1] + work[1]]);
    sum.map(|x| x / asked().count() as f64)
}

/// Prints the table "Curves" of `core/docs/measured.md` with `--nocapture`.
#[test]
fn work_grows_far_slower_than_the_segments() {
    for name in ["tool path", "spiral", "zig-zag", "walk"] {
        let path = |segments| match name {
            "tool path" => tool_path(segments),
            "spiral" => spiral(segments),
            "zig-zag" => zig_zag(segments),
            _ => walk(segments, 1),
        };
        for segments in [250, 2000, 16_000] {
            let scene = Scene::new("work", &[path(segments)], false);
            let enough = scene.curve().scratch_entries();
            let [far, near] = [true, false].map(|far| work(&scene, far, 1000));
            let [deep_far, deep_near] = [true, false].map(|far| work(&scene, far, enough));
            println!(
                "{name} {segments}: stack {enough}, best first {far:.0?} {near:.0?}, \
                 depth first {deep_far:.0?} {deep_near:.0?}"
            );
            let most = 60.0 + 0.2 * segments as f64;
            assert!(far[0] < most && near[0] < most && deep_far[0] < 1.5 * most, "{name}");
            assert!(enough <= 40, "{name} {enough}");
        }
    }
}

#[test]
fn a_blob_of_a_curve_serves_curves_only() {
    let bytes = build(&[circle(5)], &CurveOptions { is_f32: true }, Watch::NONE)
        .expect("a curve")
        .0
        .to_bytes();
    let blob = Blob::open(&bytes).expect("opens");
    let curve = blob.curve().expect("is there");
    assert!(curve.is_planar() && curve.is_closed(0) == Some(true) && curve.is_closed(1).is_none());
    assert_eq!((curve.segment_count(), curve.polyline_count()), (5, 1));
    assert!(blob.bvh().is_err() && blob.hull().is_err());
}
