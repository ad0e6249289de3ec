//! The n closest triangles.

use super::scenes::{STACK, all, allowed_width, order, stack, surface_error};
use meshsweep_core::{Budget, Ended, KNearest, Neighbor, QueryError};
use meshsweep_host_tests::generate::{Rng, cube, scaled, torus};
use meshsweep_host_tests::oracle::{Bounded, distance_to_triangle};
use meshsweep_host_tests::scene::Scene;

fn ask(
    scene: &Scene,
    p: [f32; 3],
    n: usize,
    stop: &Budget,
    entries: usize,
) -> (KNearest, Vec<Neighbor>) {
    let mut out = vec![Neighbor::EMPTY; n];
    let answer =
        scene.bvh().nearest(p, &mut out, *stop, &mut stack(entries)).expect("a finite question");
    assert!(answer.stored <= n);
    out.truncate(answer.stored);
    (answer, out)
}

fn truths(scene: &Scene, p: [f32; 3]) -> Vec<Bounded> {
    (0..scene.triangles.len() as u32).map(|t| scene.truth_of(p, t)).collect()
}

/// Every interval holds. No triangle is named twice. Triangles that are not stored are beyond
/// `rest_lower`.
fn check(scene: &Scene, p: [f32; 3], truths: &[Bounded], answer: &KNearest, out: &[Neighbor]) {
    let mut named = vec![false; truths.len()];
    for near in out {
        let truth = truths[near.triangle() as usize];
        let holds = f64::from(near.distance().lower) <= truth.upper
            && truth.lower <= f64::from(near.distance().upper);
        assert!(holds, "{}: {p:?}: {near:?} does not contain {truth:?}", scene.name);
        assert!(
            !std::mem::replace(&mut named[near.triangle() as usize], true),
            "{}: {p:?}: twice",
            scene.name
        );
    }
    for (truth, _) in truths.iter().zip(named).filter(|(_, named)| !named) {
        let beyond = f64::from(answer.rest_lower) <= truth.upper;
        assert!(beyond, "{}: {p:?}: {answer:?}, one left out at {truth:?}", scene.name);
    }
}

#[test]
fn intervals_hold_and_the_rest_is_farther() {
    for scene in all() {
        for p in scene.points(24, &mut Rng::new(41)) {
            let truths = truths(scene, p);
            for n in [1, 2, 7, 40, scene.triangles.len() + 3] {
                let (answer, out) = ask(scene, p, n, &Budget::EXACT, STACK);
                check(scene, p, &truths, &answer, &out);
                assert_eq!(answer.ended, Ended::Exact);
                assert_eq!(out.len(), n.min(truths.len()));
                assert!(out.is_sorted_by(|a, b| a.distance().upper <= b.distance().upper));
                if n > truths.len() {
                    assert_eq!(answer.rest_lower, f32::INFINITY);
                }
                let mut sorted: Vec<f64> = truths.iter().map(|t| t.lower).collect();
                sorted.sort_by(f64::total_cmp);
                for (near, truth) in out.iter().zip(sorted) {
                    assert!(truth <= f64::from(near.distance().upper), "{near:?} {truth:?}");
                }
                // As close as the last one stored, but for what f32 and the grid cannot tell.
                if let (Some(last), true) = (out.last(), n < truths.len()) {
                    let slack = allowed_width(scene, f64::from(last.distance().upper));
                    assert!(
                        f64::from(answer.rest_lower) >= f64::from(last.distance().upper) - slack,
                        "{answer:?} {last:?}"
                    );
                }
            }
        }
    }
}

#[test]
fn first_is_the_closest_point_and_fewer_are_a_prefix() {
    for scene in all() {
        for p in scene.points(48, &mut Rng::new(42)) {
            let closest =
                scene.bvh().closest_point(p, Budget::EXACT, &mut stack(STACK)).expect("finite");
            let (_, most) = ask(scene, p, 20, &Budget::EXACT, STACK);
            assert_eq!(
                (Some(most[0].triangle()), most[0].distance().upper),
                (closest.triangle, closest.distance.upper)
            );
            for n in 1..most.len() {
                assert_eq!(ask(scene, p, n, &Budget::EXACT, STACK).1, most[..n]);
            }
        }
    }
}

#[test]
fn witnesses_lie_on_their_triangles() {
    for scene in all() {
        for p in scene.points(24, &mut Rng::new(43)) {
            for near in ask(scene, p, 12, &Budget::EXACT, STACK).1 {
                let off = distance_to_triangle(near.point(), scene.corners(near.triangle())).lower;
                let allowed = surface_error(scene) + 8.0 * f64::from(f32::EPSILON) * scene.reach();
                assert!(off <= allowed, "{near:?} is {off:e} off");
            }
        }
    }
}

#[test]
fn equidistant_triangles_come_by_their_number_in_the_blob() {
    for single in [false, true] {
        let scene = Scene::tree("cube", cube(2), single);
        let order = order(&scene);
        let place =
            |near: &Neighbor| order.iter().position(|&t| t == near.triangle()).expect("named");
        for p in [[0.0; 3], [0.0, 0.0, 2.0], [3.0; 3], [0.5, 0.5, 0.0], [-1.0; 3]] {
            let (_, out) = ask(&scene, p, 60, &Budget::EXACT, STACK);
            for pair in
                out.windows(2).filter(|pair| pair[0].distance().upper == pair[1].distance().upper)
            {
                assert!(place(&pair[0]) < place(&pair[1]), "{p:?}: {pair:?}");
            }
        }
    }
}

#[test]
fn short_stacks_and_few_steps_leave_true_bounds() {
    let mut cut = 0;
    for scene in all() {
        for p in scene.points(24, &mut Rng::new(44)) {
            let truths = truths(scene, p);
            for n in [1, 5] {
                for (steps, entries) in
                    [(u32::MAX, 1), (u32::MAX, 2), (u32::MAX, 9), (0, 9), (1, STACK), (4, STACK)]
                {
                    let (answer, out) = ask(scene, p, n, &Budget::EXACT.with_steps(steps), entries);
                    check(scene, p, &truths, &answer, &out);
                    cut += u32::from(answer.ended != Ended::Exact);
                }
            }
        }
    }
    assert!(cut > 100, "only {cut} searches were cut short");
}

#[test]
fn far_points_get_the_interval_of_the_box() {
    for factor in [1.0, 1e-30, 1e30] {
        let scene = Scene::tree("torus", scaled(&torus(2.0, 0.75, 12, 8), factor), false);
        for far in [1e3, 1e7, 3e8] {
            let x = scene.size() * far;
            let p = if x.is_finite() { [x, -x, 0.5 * x] } else { [3e38, -1e38, 2e38] };
            let truths = truths(&scene, p);
            for n in [0, 1, 5, 10_000] {
                let (answer, out) = ask(&scene, p, n, &Budget::EXACT, STACK);
                check(&scene, p, &truths, &answer, &out);
                assert_eq!(out.len(), n.min(truths.len()));
            }
        }
    }
}

#[test]
fn bad_questions_are_typed_errors() {
    let scene = Scene::tree("cube", cube(1), false);
    let (tree, mut out) = (scene.bvh(), [Neighbor::EMPTY; 2]);
    let nan = [0.0, f32::NAN, 0.0];
    assert_eq!(
        tree.nearest(nan, &mut out, Budget::EXACT, &mut stack(64)),
        Err(QueryError::NotFinite)
    );
    assert_eq!(
        tree.nearest([0.0; 3], &mut out, Budget::EXACT, &mut []),
        Err(QueryError::NoScratch)
    );
    let bad = Budget::EXACT.with_relative(-1.0);
    assert_eq!(tree.nearest([0.0; 3], &mut out, bad, &mut stack(64)), Err(QueryError::Tolerance));
}
