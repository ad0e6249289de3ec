//! Triboxes, and the sides of all triangles as curves.

use crate::checks::holds;
use crate::scene::{Kind, Scene, wide};
use crate::tree::segments;
use meshsweep::curve::{CurveOptions, Polyline, build};
use meshsweep::mesh::Input;
use meshsweep::progress::Watch;
use meshsweep::tribox::{self, TriboxOptions};
use meshsweep_core::{Budget, Curve, Interval, QueryError, ScratchEntry, Triboxes, Verdict};
use meshsweep_host_tests::generate::extremes::{Extreme, extreme_points};
use meshsweep_host_tests::oracle::exact::{Corners, distance_compared, first_meeting};
use std::cmp::Ordering::{Greater, Less};

fn triboxes(extreme: &Extreme) {
    let scene = Scene::new(extreme.name, &wide(extreme.mesh.clone()), Kind::F32);
    let input =
        Input { mesh: &scene.mesh, moved: scene.moved, input_triangles: scene.corners.len() };
    let bytes = match tribox::build(input, &TriboxOptions::new(8), Watch::NONE) {
        Ok((tables, _)) => tables.to_bytes(),
        Err(error) => {
            let is_huge = ["the_largest_numbers"].contains(&extreme.name);
            return assert!(is_huge, "{}: {error}", scene.name);
        }
    };
    let all = Triboxes::open(&bytes).expect("opens");
    let mut stack = vec![ScratchEntry::EMPTY; all.scratch_entries()];
    let points = extreme_points(&extreme.mesh);
    let far = |p: &[f32; 3]| p.iter().any(|x| x.abs() > 1e35);
    let is_refused = |error: QueryError, p: &[f32; 3]| {
        assert!(error == QueryError::OutOfDomain && far(p), "{}: {p:?} {error}", scene.name);
    };
    for p in &points {
        let truth = scene.nearest(*p);
        match all.distance(*p, Budget::EXACT, &mut stack) {
            Ok(found) => {
                let compared = |t| distance_compared(p.map(f64::from), t, found.lower.into());
                let is_below = truth.iter().all(|t| compared(t) != Less);
                assert!(is_below, "{}: {p:?} {found:?}", scene.name);
            }
            Err(error) => is_refused(error, p),
        }
    }
    for [a, b] in segments(&points) {
        match all.clip(a, b, Budget::EXACT, &mut stack) {
            Ok(found) => {
                let [from, to] = [a, b].map(|p| p.map(f64::from));
                let is_early = scene.corners.iter().any(|t| {
                    let first = first_meeting(from, to, t);
                    let lower = f64::from(found.lower).min(2.0);
                    first.is_some_and(|first| first.compared_with(lower) == Less)
                });
                assert!(!is_early, "{}: {a:?} {b:?} {found:?}", scene.name);
            }
            Err(error) => is_refused(error, if far(&a) { &a } else { &b }),
        }
    }
}

/// Two sides of each triangle, a polyline each.
fn curves(extreme: &Extreme) {
    let scene = Scene::new(extreme.name, &wide(extreme.mesh.clone()), Kind::F32);
    let polylines: Vec<_> = scene
        .corners
        .iter()
        .map(|t| Polyline { points: t.to_vec(), ..Polyline::default() })
        .collect();
    let sides: Vec<Corners> =
        scene.corners.iter().flat_map(|&[a, b, c]| [[a, b, b], [b, c, c]]).collect();
    let all: Vec<&Corners> = sides.iter().collect();
    for is_f32 in [false, true] {
        let bytes =
            build(&polylines, &CurveOptions { is_f32 }, Watch::NONE).expect("curves").0.to_bytes();
        let curve = Curve::open(&bytes).expect("opens");
        let mut scratch = vec![ScratchEntry::EMPTY; curve.scratch_entries()];
        for p in extreme_points(&extreme.mesh) {
            let told = |what: &dyn std::fmt::Debug| {
                format!("{}, f32: {is_f32}: {p:?} {what:?}", extreme.name)
            };
            let near = curve.closest_point(p, Budget::EXACT, &mut scratch).expect("a point");
            let Interval { lower, upper } = near.distance;
            assert!(holds(&all, p, Interval { lower, upper }), "{}", told(&near));
            let distance = (0.75 * upper).min(f32::MAX);
            let within = curve.within(p, distance, Budget::EXACT, &mut scratch);
            let within = within.expect("a distance");
            let compared = |t| distance_compared(p.map(f64::from), t, distance.into());
            let is_near = all.iter().any(|t| compared(t) != Greater);
            let wrong = match within.verdict {
                Verdict::Yes => !is_near,
                Verdict::No => is_near,
                _ => false,
            };
            assert!(!wrong, "{}", told(&within));
        }
    }
}

on_every_extreme!(triboxes_bound_the_truth_from_below, super::triboxes);
on_every_extreme!(curves_contain_the_truth, super::curves);
