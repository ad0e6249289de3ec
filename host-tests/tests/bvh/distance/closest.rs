//! The closest point.

use super::scenes::{STACK, all, allowed_width, order, stack, surface_error};
use meshsweep_core::{Budget, Bvh, ClosestPoint, Ended, Hint, Interval, QueryError, Verdict};
use meshsweep_host_tests::generate::{
    Rng, Triangles, cube, icosphere, rough_sphere, scaled, torus,
};
use meshsweep_host_tests::oracle::{Bounded, distance_to_triangle};
use meshsweep_host_tests::scene::Scene;
use proptest::prelude::*;

const POINTS: usize = 120;

fn ask(tree: &Bvh<'_>, p: [f32; 3], stop: &Budget, entries: usize) -> ClosestPoint {
    tree.closest_point(p, *stop, &mut stack(entries)).expect("a finite question")
}

fn contains(scene: &Scene, p: [f32; 3], answer: &ClosestPoint, truth: Bounded) {
    let holds = f64::from(answer.distance.lower) <= truth.upper
        && truth.lower <= f64::from(answer.distance.upper);
    assert!(holds, "{}: {p:?}: {answer:?} does not contain {truth:?}", scene.name);
}

#[test]
fn interval_contains_the_true_distance_on_every_mesh() {
    for scene in all() {
        let tree = scene.bvh();
        for p in scene.points(POINTS, &mut Rng::new(11)) {
            let answer = ask(&tree, p, &Budget::EXACT, STACK);
            contains(scene, p, &answer, scene.truth(p));
            assert_eq!(answer.ended, Ended::Exact);
        }
    }
}

#[test]
fn exact_interval_is_as_wide_as_the_stored_surface_and_rounding() {
    for scene in all() {
        let tree = scene.bvh();
        for p in scene.points(POINTS, &mut Rng::new(12)) {
            let answer = ask(&tree, p, &Budget::EXACT, STACK);
            let width = f64::from(answer.distance.upper) - f64::from(answer.distance.lower);
            let allowed = allowed_width(scene, f64::from(answer.distance.upper));
            assert!(width <= allowed, "{answer:?} is {width:e} wide, {allowed:e} allowed");
        }
    }
}

#[test]
fn witness_lies_on_the_named_triangle_and_within_upper() {
    for scene in all() {
        let tree = scene.bvh();
        for p in scene.points(POINTS, &mut Rng::new(13)) {
            let answer = ask(&tree, p, &Budget::EXACT, STACK);
            let named = scene.corners(answer.triangle.expect("a tree has all triangles"));
            let rounding = 8.0 * f64::from(f32::EPSILON) * scene.reach();
            let off = distance_to_triangle(answer.point, named).lower;
            assert!(off <= rounding + surface_error(scene), "{answer:?} is {off:e} off");
            let gap: f64 =
                (0..3).map(|k| (f64::from(p[k]) - f64::from(answer.point[k])).powi(2)).sum();
            assert!(gap.sqrt() <= f64::from(answer.distance.upper) + rounding, "{answer:?}");
            assert!(distance_to_triangle(p, named).lower <= f64::from(answer.distance.upper));
        }
    }
}

#[test]
fn answer_has_the_same_bits_with_any_hint_and_any_used_stack() {
    for scene in all() {
        let tree = scene.bvh();
        let same =
            |a: &ClosestPoint| (a.triangle, a.point, a.distance.lower, a.distance.upper, a.ended);
        let mut used = stack(STACK);
        let mut hint = Hint::NONE;
        for p in scene.points(POINTS, &mut Rng::new(14)) {
            let plain = ask(&tree, p, &Budget::EXACT, STACK);
            let hinted =
                tree.closest_point_from(p, &mut hint, Budget::EXACT, &mut used).expect("finite");
            assert_eq!(same(&plain), same(&hinted));
            let again =
                tree.closest_point_from(p, &mut hint, Budget::EXACT, &mut used).expect("finite");
            assert_eq!(same(&plain), same(&again));
        }
    }
}

#[test]
fn equidistant_triangles_go_to_the_least_in_blob_order() {
    for single in [false, true] {
        let scene = Scene::tree("cube", cube(4), single);
        let tree = scene.bvh();
        let order = order(&scene);
        for p in [
            [0.0; 3],
            [0.25; 3],
            [0.5, 0.0, 0.0],
            [0.0, 0.0, 2.0],
            [2.0; 3],
            [0.5, 0.5, 0.0],
            [-1.0; 3],
        ] {
            let nearest = scene.truth(p);
            // Distances to a cube's faces are exact.
            let first =
                order.iter().find(|&&t| scene.truth_of(p, t).lower <= nearest.upper).copied();
            assert_eq!(ask(&tree, p, &Budget::EXACT, STACK).triangle, first, "{p:?}");
        }
    }
}

#[test]
fn named_stack_never_overflows_and_a_longer_one_answers_alike() {
    for scene in all() {
        let tree = scene.bvh();
        let entries = tree.header().stack_entries as usize;
        for p in scene.points(POINTS / 2, &mut Rng::new(15)) {
            let answer = ask(&tree, p, &Budget::EXACT, entries);
            assert_eq!(answer.ended, Ended::Exact);
            for more in [1, 2, 5, 7, 8, 40] {
                assert_eq!(ask(&tree, p, &Budget::EXACT, entries + more), answer);
            }
        }
    }
}

#[test]
fn short_stacks_few_steps_and_tolerances_still_contain_the_truth() {
    let mut overflowed = 0;
    for scene in all() {
        let tree = scene.bvh();
        let size = scene.size();
        // What is pruned at a tolerance is pruned by its box, whose rounding counts in model sizes.
        let boxes = |answer: &ClosestPoint| {
            64.0 * f64::from(f32::EPSILON)
                * (f64::from(answer.distance.upper) + 3.0 * f64::from(size))
        };
        for p in scene.points(POINTS / 3, &mut Rng::new(16)) {
            let truth = scene.truth(p);
            for entries in [1, 2, 3, 8, 16, STACK] {
                let answer = ask(&tree, p, &Budget::EXACT, entries);
                contains(scene, p, &answer, truth);
                overflowed += u32::from(answer.ended == Ended::Scratch);
                for steps in [0, 1, 2, 5, 20] {
                    let answer = ask(&tree, p, &Budget::EXACT.with_steps(steps), entries);
                    contains(scene, p, &answer, truth);
                    assert!(answer.work.opened <= steps, "{answer:?}");
                }
            }
            for relative in [1e-6, 0.01, 0.5, 100.0] {
                let answer = ask(&tree, p, &Budget::EXACT.with_relative(relative), STACK);
                contains(scene, p, &answer, truth);
                let boxes = boxes(&answer);
                let allowed = f64::from(answer.distance.lower) * f64::from(relative)
                    + (allowed_width(scene, f64::from(answer.distance.upper)) + boxes)
                        * (1.0 + f64::from(relative));
                assert!(
                    f64::from(answer.distance.upper) - f64::from(answer.distance.lower)
                        <= allowed * 1.001,
                    "{relative}: {answer:?}"
                );
            }
            for absolute in [size * 1e-6, size * 0.01, size] {
                let answer = ask(&tree, p, &Budget::EXACT.with_absolute(absolute), STACK);
                contains(scene, p, &answer, truth);
                let allowed = f64::from(absolute)
                    + allowed_width(scene, f64::from(answer.distance.upper))
                    + boxes(&answer);
                assert!(
                    f64::from(answer.distance.upper) - f64::from(answer.distance.lower) <= allowed,
                    "{absolute:e}: {answer:?}"
                );
            }
        }
    }
    assert!(overflowed > 100, "only {overflowed} overflows were tested");
}

#[test]
fn a_point_far_away_gets_an_interval_that_holds() {
    for factor in [1.0, 1e-30, 1e30] {
        for single in [false, true] {
            let scene = Scene::tree("torus", scaled(&torus(2.0, 0.75, 12, 8), factor), single);
            let tree = scene.bvh();
            let mut rng = Rng::new(17);
            let size = f64::from(scene.size());
            let mut far = 10.0;
            while size * far < 3e38 {
                for _ in 0..4 {
                    let p = rng.direction().map(|x| (f64::from(x) * size * far) as f32);
                    for stop in [Budget::EXACT, Budget::EXACT.with_steps(0)] {
                        contains(&scene, p, &ask(&tree, p, &stop, STACK), scene.truth(p));
                    }
                }
                far *= 4.0;
            }
        }
    }
}

#[test]
fn centre_of_a_sphere_visits_all_and_holds() {
    for single in [false, true] {
        let scene = Scene::tree("icosphere", icosphere(3), single);
        let answer = ask(&scene.bvh(), [0.0; 3], &Budget::EXACT, STACK);
        contains(&scene, [0.0; 3], &answer, scene.truth([0.0; 3]));
    }
}

#[test]
fn scaling_mesh_and_query_by_a_power_of_two_scales_every_bit() {
    let mesh = rough_sphere(2, 0.3, 5);
    for single in [false, true] {
        let plain = Scene::tree("plain", mesh.clone(), single);
        for exponent in [-60, -17, 1, 60, 100] {
            let factor = 2f32.powi(exponent);
            let scene = Scene::tree("scaled", scaled(&mesh, factor), single);
            for p in plain.points(120, &mut Rng::new(18)) {
                let one = ask(&plain.bvh(), p, &Budget::EXACT, STACK);
                let other = ask(&scene.bvh(), p.map(|x| x * factor), &Budget::EXACT, STACK);
                assert_eq!(
                    (one.distance.lower * factor, one.distance.upper * factor),
                    (other.distance.lower, other.distance.upper),
                    "{p:?}"
                );
                assert_eq!(one.point.map(|x| x * factor), other.point, "2^{exponent} {p:?}");
                assert_eq!(
                    (one.triangle, one.work, one.ended),
                    (other.triangle, other.work, other.ended)
                );
            }
        }
    }
}

#[test]
fn nan_infinity_bad_tolerances_and_no_stack_are_typed_errors() {
    let scene = Scene::tree("cube", cube(2), false);
    let tree = scene.bvh();
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for k in 0..3 {
            let mut p = [0.0; 3];
            p[k] = bad;
            assert_eq!(
                tree.closest_point(p, Budget::EXACT, &mut stack(64)),
                Err(QueryError::NotFinite)
            );
        }
        for stop in [Budget::EXACT.with_relative(bad), Budget::EXACT.with_absolute(bad)] {
            assert_eq!(
                tree.closest_point([0.0; 3], stop, &mut stack(64)),
                Err(QueryError::Tolerance)
            );
        }
    }
    assert_eq!(tree.closest_point([0.0; 3], Budget::EXACT, &mut []), Err(QueryError::NoScratch));
}

/// Entries with which a tree takes the least lower bound first in each of 40 steps.
const ROOM: usize = 8 * 40;

#[test]
fn a_limit_of_steps_never_outgrows_the_scratch_that_suffices() {
    for scene in all() {
        let tree = scene.bvh();
        let enough = tree.scratch_entries();
        for p in scene.points(POINTS / 3, &mut Rng::new(17)) {
            for entries in [enough, enough + 1, enough + 7, 3 * enough / 2, ROOM] {
                for steps in [0, 1, 2, 3, 5, 8, 13, 21, 34, 55, 1000] {
                    let answer = ask(&tree, p, &Budget::EXACT.with_steps(steps), entries);
                    assert_ne!(answer.ended, Ended::Scratch, "{p:?}, {steps}: {answer:?}");
                }
            }
        }
    }
}

/// After the first leaf nodes are visited in the order of lower bounds. So a step can only raise
/// the least of them.
#[test]
fn with_room_another_step_never_lowers_the_lower_bound_nor_raises_the_upper() {
    for scene in all() {
        let tree = scene.bvh();
        for p in scene.points(POINTS / 3, &mut Rng::new(18)) {
            let after = |steps| ask(&tree, p, &Budget::EXACT.with_steps(steps), ROOM);
            let answers = (1..40).map(after).filter(|answer| answer.work.triangles > 0);
            let intervals: Vec<_> = answers.map(|answer| answer.distance).collect();
            for pair in intervals.windows(2) {
                let rounding = allowed_width(scene, f64::from(pair[0].upper)) as f32;
                assert!(pair[1].lower >= pair[0].lower - rounding, "{p:?}: {pair:?}");
                assert!(pair[1].upper <= pair[0].upper + rounding, "{p:?}: {pair:?}");
            }
        }
    }
}

#[test]
fn with_room_as_many_steps_leave_narrower_intervals_after_fewer_triangles() {
    let scene = Scene::tree("torus", torus(2.0, 0.75, 120, 60), false);
    let tree = scene.bvh();
    let mut rng = Rng::new(19);
    let points: Vec<_> = (0..400).map(|_| rng.direction().map(|x| 4.0 * x)).collect();
    let sums = |entries: usize| {
        let answers = points.iter().map(|&p| ask(&tree, p, &Budget::EXACT.with_steps(16), entries));
        answers.fold((0.0, 0), |(width, triangles), answer| {
            let Interval { lower, upper } = answer.distance;
            (width + f64::from(upper - lower), triangles + answer.work.triangles)
        })
    };
    let (depth_first, least_first) = (sums(tree.scratch_entries()), sums(ROOM));
    assert!(least_first.0 < 0.8 * depth_first.0, "{least_first:?} beside {depth_first:?}");
    assert!(least_first.1 < depth_first.1, "{least_first:?} beside {depth_first:?}");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn interval_holds_for_any_soup_query_and_stop(
        seed in 0u64..100_000,
        kind in 0usize..3,
        single in any::<bool>(),
        p in prop::array::uniform3(-2f32..2.0),
        steps in 0u32..60,
        entries in 1usize..40,
    ) {
        let scene = super::scenes::random(kind, seed, single);
        let answer = ask(&scene.bvh(), p, &Budget::EXACT.with_steps(steps), entries);
        contains(&scene, p, &answer, scene.truth(p));
        let on = scene.points(12, &mut Rng::new(seed));
        for p in on {
            contains(&scene, p, &ask(&scene.bvh(), p, &Budget::EXACT, STACK), scene.truth(p));
        }
    }
}

/// Nodes that are flat in their frame have steps of 2^-36 units: their number from far away,
/// squared, is beyond f32.
#[test]
fn flat_parts_are_right_from_any_distance() {
    for single in [false, true] {
        for (name, mesh) in [("cube", cube(6)), ("plate", plate(12))] {
            let scene = Scene::tree(name, mesh, single);
            let tree = scene.bvh();
            let mut rng = Rng::new(90);
            for power in 4..24 {
                for _ in 0..6 {
                    let far = scene.size() * 2f32.powi(power);
                    let p = rng.direction().map(|x| x * far);
                    let truth = scene.truth(p);
                    let answer = ask(&tree, p, &Budget::EXACT, STACK);
                    contains(&scene, p, &answer, truth);
                    let twice = (2.0 * truth.upper) as f32;
                    let within =
                        tree.within(p, twice, Budget::EXACT, &mut stack(STACK)).expect("finite");
                    let named = within.witness.is_some();
                    assert!(
                        within.verdict == Verdict::Yes && named,
                        "{}: {p:?}: {within:?}",
                        scene.name
                    );
                    let half = (0.5 * truth.lower) as f32;
                    let within =
                        tree.within(p, half, Budget::EXACT, &mut stack(STACK)).expect("finite");
                    assert_eq!(within.verdict, Verdict::No, "{}: {p:?}", scene.name);
                }
            }
        }
    }
}

/// A square of `n`² cells in the plane z = 0.
fn plate(n: u32) -> Triangles {
    let at = |i: u32| 2.0 * i as f32 / n as f32 - 1.0;
    let positions = (0..=n).flat_map(|j| (0..=n).map(move |i| [at(i), at(j), 0.0])).collect();
    let corner = |i: u32, j: u32| j * (n + 1) + i;
    let cell = |i: u32, j: u32| {
        let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
        [[a, b, c], [a, c, d]]
    };
    let triangles = (0..n).flat_map(|j| (0..n).flat_map(move |i| cell(i, j))).collect();
    (positions, triangles)
}

/// No leaf is visited: the model's box answers. Its gaps are far shorter than its coordinates.
#[test]
fn without_a_step_the_box_of_a_flat_or_distant_mesh_bounds_the_truth() {
    let mut rng = Rng::new(17);
    for power in [-120, -60, -40, 0, 42, 60] {
        let unit = 2f32.powi(power);
        for i in 0..60 {
            let by = unit * 2f32.powi(-(i % 30) * 4);
            let mut point = || rng.point_in([-by; 3], [by; 3]);
            let mut corners = vec![point(), point(), point()];
            let height = if i % 2 == 0 { unit } else { 0.0 };
            corners.iter_mut().for_each(|corner| corner[2] = height);
            let p = point();
            let p = [p[0], p[1], height + [0.0, 0.5 * by, 0.5 * unit][i as usize % 3]];
            for single in [false, true] {
                let scene = Scene::tree("flat", (corners.clone(), vec![[0, 1, 2]]), single);
                let answer = ask(&scene.bvh(), p, &Budget::EXACT.with_steps(0), STACK);
                contains(&scene, p, &answer, scene.truth(p));
            }
        }
    }
}
