//! The closest point against brute force: the interval holds, the witness agrees, and nothing but
//! the question matters.

use super::scenes::{all, options};
use meshsweep_core::{Budget, ClosestPoint, Ended, Hull, QueryError, ScratchEntry};
use meshsweep_host_tests::generate::{Rng, cube, icosphere, rough_sphere, scaled, torus};
use meshsweep_host_tests::oracle::{Bounded, distance_to_mesh, distance_to_triangle};
use meshsweep_host_tests::scene::Scene;
use proptest::prelude::*;

const POINTS: usize = 160;

fn ask(model: &Hull<'_>, p: [f32; 3], stop: &Budget, queue: usize) -> ClosestPoint {
    model.closest_point(p, *stop, &mut vec![ScratchEntry::EMPTY; queue]).expect("a finite question")
}

fn truth(scene: &Scene, p: [f32; 3]) -> Bounded {
    distance_to_mesh(p, &scene.positions, &scene.triangles)
}

fn contains(scene: &Scene, p: [f32; 3], answer: &ClosestPoint, truth: Bounded) {
    let holds = f64::from(answer.distance.lower) <= truth.upper
        && truth.lower <= f64::from(answer.distance.upper);
    assert!(holds, "{}: {p:?}: {answer:?} does not contain {truth:?}", scene.name);
}

/// Error bound of the stored surface, input units.
fn surface_error(model: &Hull<'_>) -> f64 {
    f64::from(model.header().surface_error) * model.scale()
}

fn gap(p: [f32; 3], q: [f32; 3]) -> f64 {
    (0..3).map(|k| (f64::from(p[k]) - f64::from(q[k])).powi(2)).sum::<f64>().sqrt()
}

#[test]
fn interval_contains_the_true_distance_on_every_mesh() {
    for scene in all() {
        let model = scene.model();
        let mut rng = Rng::new(11);
        for p in scene.points(POINTS, &mut rng) {
            let answer = ask(&model, p, &Budget::EXACT, 4096);
            contains(scene, p, &answer, truth(scene, p));
            assert_eq!(answer.ended, Ended::Exact, "{}", scene.name);
        }
    }
}

#[test]
fn exact_interval_is_a_few_ulps_wide() {
    for scene in all() {
        let model = scene.model();
        let mut rng = Rng::new(12);
        for p in scene.points(POINTS, &mut rng) {
            let answer = ask(&model, p, &Budget::EXACT, 4096);
            let (lower, upper) =
                (f64::from(answer.distance.lower), f64::from(answer.distance.upper));
            let lengths = scene.reach() + p.iter().fold(0f64, |m, x| m.max(f64::from(x.abs())));
            // On a needle the supporting plane loses its aspect ratio in accuracy.
            let needle = if scene.name == "needle comb" { 65_536.0 } else { 64.0 };
            let allowed = upper * 4.0 * f64::from(f32::EPSILON)
                + needle * 64.0 * f64::EPSILON * lengths
                + 2.0 * surface_error(&model);
            assert!(
                upper - lower <= allowed,
                "{}: {p:?}: {answer:?}, {allowed:e} allowed",
                scene.name
            );
        }
    }
}

#[test]
fn witness_lies_on_the_named_triangle_and_within_upper() {
    for scene in all() {
        let model = scene.model();
        let mut rng = Rng::new(13);
        for p in scene.points(POINTS, &mut rng) {
            let answer = ask(&model, p, &Budget::EXACT, 4096);
            let triangle = answer.triangle.expect("the blob is whole");
            // The point is rounded to f32.
            let rounding = 2.0 * f64::from(f32::EPSILON) * scene.reach();
            let stored = surface_error(&model);
            let off = distance_to_triangle(answer.point, scene.corners(triangle)).lower;
            assert!(off <= rounding + stored, "{}: {p:?}: {answer:?} is {off:e} off", scene.name);
            let reached = gap(p, answer.point);
            assert!(
                reached <= f64::from(answer.distance.upper) + rounding,
                "{}: {p:?}: {answer:?}",
                scene.name
            );
            // The named triangle is one of the nearest.
            let named = distance_to_triangle(p, scene.corners(triangle));
            let nearest = truth(scene, p);
            let slack = 2.0 * stored + 1e-13 * (scene.reach() + named.upper);
            assert!(
                named.lower <= nearest.upper + slack,
                "{}: {p:?}: {named:?} {nearest:?}",
                scene.name
            );
        }
    }
}

#[test]
fn equidistant_triangles_go_to_the_least_whatever_the_queue() {
    // Points on the medial axis of a cube, and centres of spheres, are equally far from many
    // triangles.
    let scenes = [
        Scene::hull("cube", cube(4), &options(12)),
        Scene::hull("icosphere", icosphere(2), &options(20)),
    ];
    for scene in &scenes {
        let model = scene.model();
        let order: Vec<u32> = (0..model.header().surface_triangles)
            .filter_map(|t| model.source(meshsweep_core::internal::hull::format::TriIdx(t)))
            .collect();
        for p in [
            [0.0; 3],
            [0.25, 0.25, 0.25],
            [0.5, 0.0, 0.0],
            [0.0, 0.0, 2.0],
            [2.0; 3],
            [0.5, 0.5, 0.0],
            [-1.0; 3],
        ] {
            let nearest = truth(scene, p);
            let capacity = model.scratch_entries();
            let answers = [capacity, capacity + 1, 64, 10_000]
                .map(|n| ask(&model, p, &Budget::EXACT, n.max(capacity)));
            for answer in &answers {
                assert_eq!(answer.ended, Ended::Exact, "{p:?}: {answers:?}");
                assert_eq!(
                    (answer.triangle, answer.point),
                    (answers[0].triangle, answers[0].point),
                    "{p:?}: {answers:?}"
                );
                assert_eq!(
                    (answer.distance.lower, answer.distance.upper),
                    (answers[0].distance.lower, answers[0].distance.upper),
                    "{p:?}"
                );
            }
            if scene.name == "cube" {
                // Distances to a cube's faces are exact: the first of all that attain the least
                // one.
                let first = order
                    .iter()
                    .find(|&&t| distance_to_triangle(p, scene.corners(t)).lower <= nearest.upper)
                    .copied();
                assert_eq!(answers[0].triangle, first, "{p:?}");
            }
        }
    }
}

#[test]
fn queue_of_the_named_capacity_never_overflows_and_any_longer_one_answers_alike() {
    for scene in all() {
        let model = scene.model();
        let capacity = model.scratch_entries();
        let mut rng = Rng::new(14);
        for p in scene.points(POINTS / 2, &mut rng) {
            let nearest = truth(scene, p);
            let answers = [10_000, 0, 1, 3, 7, 12, 20, 40, 90]
                .map(|n| ask(&model, p, &Budget::EXACT, capacity + n));
            for answer in answers {
                contains(scene, p, &answer, nearest);
                assert_eq!(answer.ended, Ended::Exact, "{}: {p:?}", scene.name);
                let same =
                    |a: &ClosestPoint| (a.triangle, a.point, a.distance.lower, a.distance.upper);
                assert_eq!(same(&answer), same(&answers[0]), "{}: {p:?}", scene.name);
            }
        }
    }
}

#[test]
fn short_queue_still_contains_the_truth() {
    let mut overflowed = 0;
    for scene in all() {
        let model = scene.model();
        let mut rng = Rng::new(15);
        for p in scene.points(POINTS / 2, &mut rng) {
            let nearest = truth(scene, p);
            for length in [1, 2, 3, 8] {
                let answer = ask(&model, p, &Budget::EXACT, length);
                contains(scene, p, &answer, nearest);
                assert!(matches!(answer.ended, Ended::Exact | Ended::Scratch), "{answer:?}");
                overflowed += u32::from(answer.ended == Ended::Scratch);
            }
        }
    }
    assert!(overflowed > 100, "only {overflowed} overflows were tested");
}

#[test]
fn early_stop_still_contains_the_truth() {
    for scene in all() {
        let model = scene.model();
        let size = scene.size();
        let mut rng = Rng::new(16);
        for p in scene.points(POINTS / 4, &mut rng) {
            let nearest = truth(scene, p);
            for steps in [0, 1, 2, 5, 20, 100] {
                for length in [1, 4096] {
                    let answer = ask(&model, p, &Budget::EXACT.with_steps(steps), length);
                    contains(scene, p, &answer, nearest);
                    assert!(answer.work.opened <= steps, "{}: {answer:?}", scene.name);
                }
            }
            for relative in [1e-6, 0.01, 0.5, 100.0] {
                let answer = ask(&model, p, &Budget::EXACT.with_relative(relative), 4096);
                contains(scene, p, &answer, nearest);
                let (lower, upper) =
                    (f64::from(answer.distance.lower), f64::from(answer.distance.upper));
                if answer.ended == Ended::Tolerance && surface_error(&model) == 0.0 {
                    assert!(
                        upper <= lower * (1.0 + f64::from(relative)) * (1.0 + 1e-6),
                        "{}: {answer:?}",
                        scene.name
                    );
                }
            }
            for absolute in [size * 1e-6, size * 0.01, size] {
                let answer = ask(&model, p, &Budget::EXACT.with_absolute(absolute), 4096);
                contains(scene, p, &answer, nearest);
                let (lower, upper) =
                    (f64::from(answer.distance.lower), f64::from(answer.distance.upper));
                if answer.ended == Ended::Tolerance && surface_error(&model) == 0.0 {
                    assert!(
                        upper - lower <= f64::from(absolute) + 2e-7 * upper,
                        "{}: {answer:?}",
                        scene.name
                    );
                }
            }
        }
    }
}

/// A tolerance may be met before a triangle of the surface is reached.
#[test]
fn with_a_tolerance_the_witness_lies_on_the_surface_and_within_upper() {
    let mut spared = 0;
    for scene in all() {
        let model = scene.model();
        let mut rng = Rng::new(18);
        let rounding = 2.0 * f64::from(f32::EPSILON) * scene.reach() + surface_error(&model);
        for p in scene.points(POINTS / 4, &mut rng) {
            let exact = ask(&model, p, &Budget::EXACT, 4096);
            for relative in [0.01, 0.05, 0.2, 3.0] {
                for length in [1, 3, 4096] {
                    let answer = ask(&model, p, &Budget::EXACT.with_relative(relative), length);
                    contains(scene, p, &answer, truth(scene, p));
                    let triangle = answer.triangle.expect("the blob is whole");
                    let off = distance_to_triangle(answer.point, scene.corners(triangle)).lower;
                    assert!(off <= rounding, "{}: {p:?}: {answer:?} is {off:e} off", scene.name);
                    let reached = gap(p, answer.point);
                    let upper = f64::from(answer.distance.upper);
                    assert!(reached <= upper + rounding, "{}: {p:?}: {answer:?}", scene.name);
                    spared += usize::from(answer.work.opened * 4 < exact.work.opened);
                }
            }
        }
    }
    assert!(spared > 1000, "only {spared} answers took a quarter");
}

#[test]
fn a_point_far_away_gets_an_interval_that_holds() {
    for scene in [
        Scene::hull("torus", torus(2.0, 0.75, 12, 8), &options(20)),
        Scene::hull("torus × 1e-30", scaled(&torus(2.0, 0.75, 12, 8), 1e-30), &options(20)),
        Scene::hull("torus × 1e30", scaled(&torus(2.0, 0.75, 12, 8), 1e30), &options(20)),
    ] {
        let model = scene.model();
        let mut rng = Rng::new(17);
        let size = f64::from(scene.size());
        let mut factor = 10.0;
        while size * factor < 3e38 && factor < 1e31 {
            for _ in 0..4 {
                let p = rng.direction().map(|x| (f64::from(x) * size * factor) as f32);
                for stop in [Budget::EXACT, Budget::EXACT.with_steps(0)] {
                    let answer = ask(&model, p, &stop, 256);
                    contains(&scene, p, &answer, truth(&scene, p));
                }
            }
            factor *= 10.0;
        }
    }
}

#[test]
fn scaling_mesh_and_query_by_a_power_of_two_scales_every_bit() {
    let mesh = rough_sphere(2, 0.3, 5);
    let plain = Scene::hull("plain", mesh.clone(), &options(40));
    let model = plain.model();
    for exponent in [-60, -17, 1, 60, 100] {
        let factor = 2f32.powi(exponent);
        let scene = Scene::hull("scaled", scaled(&mesh, factor), &options(40));
        let scaled_model = scene.model();
        let mut rng = Rng::new(18);
        for p in plain.points(200, &mut rng) {
            let one = ask(&model, p, &Budget::EXACT, 256);
            let other = ask(&scaled_model, p.map(|x| x * factor), &Budget::EXACT, 256);
            assert_eq!(
                (one.distance.lower * factor, one.distance.upper * factor),
                (other.distance.lower, other.distance.upper),
                "2^{exponent} {p:?}"
            );
            assert_eq!(one.point.map(|x| x * factor), other.point, "2^{exponent} {p:?}");
            assert_eq!(
                (one.triangle, one.work, one.ended),
                (other.triangle, other.work, other.ended)
            );
        }
    }
}

#[test]
fn nan_infinity_and_bad_tolerances_are_typed_errors() {
    let scene = Scene::hull("cube", cube(2), &options(12));
    let model = scene.model();
    let mut queue = [ScratchEntry::EMPTY; 64];
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for k in 0..3 {
            let mut p = [0.0; 3];
            p[k] = bad;
            assert_eq!(
                model.closest_point(p, Budget::EXACT, &mut queue),
                Err(QueryError::NotFinite)
            );
        }
        for stop in [Budget::EXACT.with_relative(bad), Budget::EXACT.with_absolute(bad)] {
            assert_eq!(model.closest_point([0.0; 3], stop, &mut queue), Err(QueryError::Tolerance));
        }
    }
    let negative = Budget::EXACT.with_relative(-0.1);
    assert_eq!(model.closest_point([0.0; 3], negative, &mut queue), Err(QueryError::Tolerance));
    assert_eq!(model.closest_point([0.0; 3], Budget::EXACT, &mut []), Err(QueryError::NoScratch));
}

#[test]
fn a_point_on_the_surface_has_lower_zero() {
    let scene = Scene::hull("cube", cube(4), &options(12));
    let model = scene.model();
    for p in [[1.0, 0.3, -0.7], [1.0, 1.0, 1.0], [0.5, -1.0, 0.5], [-1.0, 0.0, 1.0]] {
        assert_eq!(ask(&model, p, &Budget::EXACT, 64).distance.lower, 0.0, "{p:?}");
    }
}

#[test]
fn what_the_queue_held_before_does_not_matter() {
    let scene = Scene::hull("torus", torus(2.0, 0.75, 24, 12), &options(40));
    let model = scene.model();
    let mut rng = Rng::new(19);
    let mut used = vec![ScratchEntry::EMPTY; 300];
    for p in scene.points(200, &mut rng) {
        let again = model.closest_point(p, Budget::EXACT, &mut used).expect("finite");
        assert_eq!(again, ask(&model, p, &Budget::EXACT, 300));
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn interval_holds_for_any_sphere_query_and_stop(
        seed in 0u64..1000,
        p in prop::array::uniform3(-4f32..4.0),
        steps in 0u32..200,
        queue in 1usize..80,
    ) {
        let scene = Scene::hull("rough sphere", rough_sphere(1, 0.5, seed), &options(16));
        let answer = ask(&scene.model(), p, &Budget::EXACT.with_steps(steps), queue);
        let nearest = truth(&scene, p);
        prop_assert!(f64::from(answer.distance.lower) <= nearest.upper && nearest.lower <= f64::from(answer.distance.upper));
    }
}
