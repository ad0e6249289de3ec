//! Scales, places far from the origin, far motions, and matrices that are no rotations.

use super::held::{Tally, ask, contains, holds, truth};
use meshsweep_core::{Budget, Ended, Pose};
use meshsweep_host_tests::generate::corpus::IDENTITY;
use meshsweep_host_tests::generate::{
    EXTREME_SCALES, Rng, rough_sphere, scaled, torus, transformed,
};
use meshsweep_host_tests::motion::{motions, placed, rotation};
use meshsweep_host_tests::scene::Scene;

#[test]
fn scaling_both_meshes_and_the_motion_by_a_power_of_two_scales_the_answer() {
    let (a, b) = (torus(2.0, 0.75, 16, 8), rough_sphere(2, 0.5, 1));
    let (first, second) = (Scene::both("", a.clone()), Scene::both("", b.clone()));
    let poses = motions(&first, &second, 15, 1);
    for scale in EXTREME_SCALES {
        let (large, other) =
            (Scene::both("", scaled(&a, scale)), Scene::both("", scaled(&b, scale)));
        for pose in &poses {
            let moved = Pose { translation: pose.translation.map(|x| x * scale), ..*pose };
            for (plain, scaled) in first.trees().iter().zip(large.trees()) {
                for (with, and) in second.trees().iter().zip(other.trees()) {
                    let answer = ask(plain, with, pose, Budget::EXACT);
                    let also = ask(&scaled, &and, &moved, Budget::EXACT);
                    assert_eq!(answer.distance.lower * scale, also.distance.lower);
                    assert_eq!(answer.distance.upper * scale, also.distance.upper);
                    assert_eq!(answer.points.map(|p| p.map(|x| x * scale)), also.points);
                    assert_eq!((answer.triangles, answer.work), (also.triangles, also.work));
                }
            }
        }
    }
}

#[test]
fn intervals_at_extreme_scales_contain_the_truth() {
    for scale in [1e30, 1e-30] {
        let a = Scene::both("", scaled(&torus(2.0, 0.75, 12, 8), scale));
        let b = Scene::both("", scaled(&rough_sphere(1, 0.5, 1), scale));
        let mut tally = Tally::default();
        for pose in motions(&a, &b, 12, 2) {
            holds("scaled", &a, &b, &pose, &mut tally);
        }
        assert!(tally.meets > 0 && tally.apart > 0, "{tally:?}");
    }
}

#[test]
fn models_of_very_different_size_have_the_distance_of_their_input() {
    for (factor, seed) in [(1.0 / 64.0, 12), (37.0, 13), (1.0 / 4096.0, 14)] {
        let small = scaled(&rough_sphere(1, 0.3, 4), factor);
        let (a, b) = (Scene::both("", torus(2.0, 0.75, 16, 8)), Scene::both("", small));
        let mut tally = Tally::default();
        for pose in motions(&a, &b, 16, seed) {
            holds("sizes", &a, &b, &pose, &mut tally);
        }
        assert!(tally.apart > 0, "{factor}: {tally:?}");
    }
}

#[test]
fn a_mesh_far_from_its_own_origin_has_the_distance_of_its_input() {
    let far = [1e6, -1.5e6, 2e6];
    let a = Scene::both("", transformed(&scaled(&torus(2.0, 0.75, 16, 8), 64.0), IDENTITY, far));
    let b = Scene::both("", scaled(&rough_sphere(2, 0.5, 1), 64.0));
    let mut tally = Tally::default();
    let mut rng = Rng::new(4);
    for _ in 0..12 {
        let offset = rng.point_in([-250.0; 3], [250.0; 3]);
        let place = std::array::from_fn(|k| far[k] + offset[k]);
        holds("first is far", &a, &b, &placed(&b, rotation(&mut rng), place), &mut tally);
        holds("second is far", &b, &a, &placed(&a, rotation(&mut rng), offset), &mut tally);
    }
    assert!(tally.meets > 0 && tally.apart > 0, "{tally:?}");
}

#[test]
fn matrices_need_not_be_rotations() {
    let (a, b) =
        (Scene::both("", torus(2.0, 0.75, 16, 8)), Scene::both("", rough_sphere(2, 0.5, 1)));
    let mirrored = [[0.0, -1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, -1.0]];
    let sheared = [[1.5, 0.7, 0.0], [-0.4, 0.6, 1.1], [0.2, 2.0, -1.0]];
    let tiny = [[1e-4, 0.0, 0.0], [0.0, 1e-5, 0.0], [0.0, 0.0, 1e-4]];
    let mut rng = Rng::new(5);
    let mut tally = Tally::default();
    for matrix in [mirrored, sheared, tiny] {
        for _ in 0..8 {
            let place = rng.point_in([-4.0, -4.0, -2.0], [4.0, 4.0, 2.0]);
            let pose = Pose { is_affine: true, ..placed(&b, matrix, place) };
            holds("matrix", &a, &b, &pose, &mut tally);
        }
    }
    assert!(tally.meets > 0 && tally.apart > 0, "{tally:?}");
}

#[test]
fn far_motions_have_an_interval_that_narrows_with_the_distance() {
    let (a, b) =
        (Scene::both("", torus(2.0, 0.75, 12, 6)), Scene::both("", rough_sphere(1, 0.5, 1)));
    let mut rng = Rng::new(6);
    for far in [1e2f32, 1e4, 1e6, 1e9, 1e20, 1e38] {
        let place = rng.direction().map(|x| x * far);
        let pose = placed(&b, rotation(&mut rng), place);
        let truth = truth(&a, &b, &pose);
        for tree in a.trees() {
            for other in b.trees() {
                let found = ask(&tree, &other, &pose, Budget::EXACT);
                assert!(contains(found.distance, truth), "{far}: {found:?} {truth:?}");
                let width = f64::from(found.distance.upper) - f64::from(found.distance.lower);
                let allowed = match found.ended {
                    Ended::Exact => 1e-6 * truth.upper + 1e-3,
                    Ended::Resolution => 40.0 + 1e-6 * truth.upper,
                    ended => panic!("{ended:?}"),
                };
                assert!(width <= allowed, "{far}: {found:?} {truth:?} {width:e}");
            }
        }
    }
}
