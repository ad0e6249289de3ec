//! The closest point in f64.

use super::scenes::{STACK, all, stack, surface_error};
use meshsweep_core::{Budget, Bvh, ClosestPoint, Ended, Verdict};
use meshsweep_host_tests::generate::{Rng, needle_comb, scaled, uv_sphere};
use meshsweep_host_tests::oracle::distance_to_triangle;
use meshsweep_host_tests::scene::Scene;

const POINTS: usize = 120;

fn ask(scene: &Scene, p: [f32; 3], budget: Budget) -> ClosestPoint {
    scene.bvh().closest_point_precise(p, budget, &mut stack(STACK)).expect("a finite question")
}

fn contains(scene: &Scene, p: [f32; 3], answer: &ClosestPoint) {
    let truth = scene.truth(p);
    let holds = f64::from(answer.distance.lower) <= truth.upper
        && truth.lower <= f64::from(answer.distance.upper);
    assert!(holds, "{}: {p:?}: {answer:?} does not contain {truth:?}", scene.name);
}

#[test]
fn interval_contains_the_true_distance_on_every_mesh() {
    for scene in all() {
        for p in scene.points(POINTS, &mut Rng::new(31)) {
            contains(scene, p, &ask(scene, p, Budget::EXACT));
        }
    }
}

/// A kernel in f64 is off by some 1e-15 of the lengths, on a needle times its aspect.
#[test]
fn interval_is_as_wide_as_the_surface_error_and_a_rounding_of_each_end() {
    for scene in all() {
        for p in scene.points(POINTS, &mut Rng::new(32)) {
            let answer = ask(scene, p, Budget::EXACT);
            let (lower, upper) = (answer.distance.lower, answer.distance.upper);
            let width = f64::from(upper) - f64::from(lower);
            let rounding = f64::from(upper.next_up() - upper);
            let kernel = if scene.name.contains("sliver") { 1e-7 } else { 1e-11 };
            let allowed = 2.0 * surface_error(scene) + 3.0 * rounding + kernel * scene.reach();
            assert!(width <= allowed, "{}: {answer:?}, {allowed:e} allowed", scene.name);
        }
    }
}

#[test]
fn named_triangle_is_nearest_up_to_the_surface_error() {
    for scene in all() {
        for p in scene.points(POINTS, &mut Rng::new(33)) {
            let answer = ask(scene, p, Budget::EXACT);
            let named = scene.corners(answer.triangle.expect("a tree has all triangles"));
            let least = scene.truth(p).upper + 2.0 * surface_error(scene) + 1e-11 * scene.reach();
            assert!(distance_to_triangle(p, named).lower <= least, "{}: {answer:?}", scene.name);
        }
    }
}

#[test]
fn few_steps_and_little_scratch_leave_an_interval_that_contains_the_truth() {
    let mut cut_short = 0;
    for scene in all() {
        let tree = scene.bvh();
        for p in scene.points(POINTS / 2, &mut Rng::new(34)) {
            for steps in [0, 1, 2, 4, 8, 16] {
                let budget = Budget::EXACT.with_steps(steps);
                let answer = ask(scene, p, budget);
                contains(scene, p, &answer);
                assert!(answer.work.opened <= steps, "{answer:?}");
                cut_short += usize::from(answer.ended == Ended::Steps);
            }
            let answer = tree.closest_point_precise(p, Budget::EXACT, &mut stack(1));
            contains(scene, p, &answer.expect("an entry is enough to begin"));
        }
    }
    assert!(cut_short > 1000, "{cut_short} of all queries were cut short");
}

/// Squares of such distances leave the range of f32.
#[test]
fn next_to_triangles_that_are_points_beside_the_model_no_answer_is_wrong() {
    for edge in [0.0, 2f32.powi(-100), 2f32.powi(-90)] {
        let corners = [[0.0; 3], [0.0, edge, 0.0], [0.0, 0.0, edge]];
        let there = corners.map(|[x, y, z]| [x + 1.0, y, z]);
        let mesh = ([corners, there].concat(), vec![[0, 1, 2], [3, 4, 5]]);
        for single in [false, true] {
            let scene = Scene::tree("points", mesh.clone(), single);
            let tree = scene.bvh();
            for at in [1e-37, 1e-30, 1e-28, 1e-27, 1e-25, 1e-20, 1e-15, 1e-10, 0.5] {
                let p = [at, 0.0, 0.0];
                let plain = tree.closest_point(p, Budget::EXACT, &mut stack(STACK));
                contains(&scene, p, &plain.expect("a point"));
                contains(&scene, p, &ask(&scene, p, Budget::EXACT));
                let within = tree.within(p, 1.05 * at, Budget::EXACT, &mut stack(STACK));
                assert_ne!(within.expect("a point").verdict, Verdict::No, "{edge:e} {at:e}");
                let signed = tree.signed_distance(p, Budget::EXACT, &mut stack(STACK));
                contains(&scene, p, &signed.expect("a point").closest);
            }
        }
    }
}

/// At the centre every triangle is a candidate, on needles the bounds of f32 are poor.
#[test]
fn centres_of_spheres_and_needles_are_measured() {
    for (name, mesh) in [("sphere", uv_sphere(24, 12)), ("needles", needle_comb())] {
        for scale in [1.0, 1e-30, 1e30] {
            let scene = Scene::tree(name, scaled(&mesh, scale), true);
            for p in [[0.0; 3], [1e-7 * scale, 0.0, 0.0], [0.4 * scale, 0.5 * scale, 0.1 * scale]] {
                let answer = ask(&scene, p, Budget::EXACT);
                contains(&scene, p, &answer);
                assert!(answer.work.exact > 0, "{answer:?}");
            }
        }
    }
}

#[test]
fn an_error_of_the_place_does_not_add_triangles_that_are_measured() {
    let scene = Scene::tree("sphere", uv_sphere(48, 24), true);
    let tree = scene.bvh();
    let moved = tree.with_error(0.1).expect("an error");
    let mut rng = Rng::new(36);
    for p in scene.points(POINTS, &mut rng) {
        let of = |tree: &Bvh<'_>| {
            let answer = tree.closest_point_precise(p, Budget::EXACT, &mut stack(STACK));
            answer.expect("a point").work.exact
        };
        assert!(of(&moved) <= of(&tree) * 21 / 20 + 2, "{p:?}: {} and {}", of(&tree), of(&moved));
    }
}
