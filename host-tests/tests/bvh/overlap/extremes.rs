//! Scales, places far from the origin, and matrices that are no rotations.

use super::motions::{Tally, holds, motions, placed, rotation};
use meshsweep_host_tests::generate::corpus::IDENTITY;
use meshsweep_host_tests::generate::{
    EXTREME_SCALES, Rng, cube, icosphere, joined, rough_sphere, scaled, torus, transformed,
};
use meshsweep_host_tests::scene::Scene;

#[test]
fn scaling_both_meshes_and_the_motion_by_a_power_of_two_changes_no_answer() {
    let (a, b) = (torus(2.0, 0.75, 16, 8), rough_sphere(2, 0.5, 1));
    let (first, second) = (Scene::both("", a.clone()), Scene::both("", b.clone()));
    let poses = motions(&first, &second, 25, 1);
    for scale in EXTREME_SCALES {
        let (large, other) =
            (Scene::both("", scaled(&a, scale)), Scene::both("", scaled(&b, scale)));
        for pose in &poses {
            let translation = pose.translation.map(|x| x * scale);
            let moved = meshsweep_core::Pose { translation, ..*pose };
            for (plain, scaled) in first.trees().iter().zip(large.trees()) {
                for (with, and) in second.trees().iter().zip(other.trees()) {
                    let answer = super::motions::ask(plain, with, pose);
                    assert_eq!(answer, super::motions::ask(&scaled, &and, &moved), "{scale}");
                }
            }
        }
    }
}

#[test]
fn answers_at_extreme_scales_are_exact() {
    for scale in [1e30, 1e-30] {
        let a = Scene::both("", scaled(&torus(2.0, 0.75, 12, 8), scale));
        let b = Scene::both("", scaled(&rough_sphere(1, 0.5, 1), scale));
        let mut tallies: [Tally; 4] = Default::default();
        for pose in motions(&a, &b, 20, 2) {
            holds("scaled", &a, &b, &pose, &mut tallies);
        }
        assert!(
            tallies[3].open == 0 && tallies[3].meets > 0 && tallies[3].apart > 0,
            "{tallies:?}"
        );
    }
}

#[test]
fn a_mesh_far_from_its_own_origin_is_met_all_the_same() {
    let far = [1e6, -1.5e6, 2e6];
    let a = Scene::both("", transformed(&scaled(&torus(2.0, 0.75, 16, 8), 64.0), IDENTITY, far));
    let b = Scene::both("", scaled(&rough_sphere(2, 0.5, 1), 64.0));
    let mut tallies: [Tally; 4] = Default::default();
    let mut rng = Rng::new(4);
    for _ in 0..20 {
        let offset = rng.point_in([-250.0; 3], [250.0; 3]);
        let place = std::array::from_fn(|k| far[k] + offset[k]);
        holds("first is far", &a, &b, &placed(&b, rotation(&mut rng), place), &mut tallies);
        holds("second is far", &b, &a, &placed(&a, rotation(&mut rng), offset), &mut tallies);
    }
    assert!(tallies[3].meets > 0 && tallies[3].apart > 0, "{tallies:?}");
}

#[test]
fn matrices_need_not_be_rotations() {
    let (a, b) =
        (Scene::both("", torus(2.0, 0.75, 16, 8)), Scene::both("", rough_sphere(2, 0.5, 1)));
    let mirrored = [[0.0, -1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, -1.0]];
    let sheared = [[1.5, 0.7, 0.0], [-0.4, 0.6, 1.1], [0.2, 2.0, -1.0]];
    let flat = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.3, 0.2, 0.0]];
    let mut rng = Rng::new(5);
    let mut tallies: [Tally; 4] = Default::default();
    for matrix in [mirrored, sheared, flat] {
        for _ in 0..8 {
            let place = rng.point_in([-4.0, -4.0, -2.0], [4.0, 4.0, 2.0]);
            let pose = meshsweep_core::Pose { is_affine: true, ..placed(&b, matrix, place) };
            holds("matrix", &a, &b, &pose, &mut tallies);
        }
    }
    assert!(tallies[3].meets > 0 && tallies[3].apart > 0, "{tallies:?}");
}

#[test]
fn matrices_with_next_to_nothing_in_a_column_part_nothing_that_meets() {
    let grain = transformed(&scaled(&rough_sphere(2, 0.3, 3), 0.003), IDENTITY, [1.5, 0.1, 0.2]);
    let sheet = (vec![[0.1, -1.0, -1.0], [0.2, 3.0, -1.0], [-0.3, -1.0, 3.0]], vec![[0, 1, 2]]);
    let b = Scene::both("", sheet);
    let mut tallies: [Tally; 4] = Default::default();
    for factor in [1.0, 1.0 / (1u64 << 38) as f32] {
        let a = Scene::both("", scaled(&joined(&cube(1), &grain), factor));
        let mut column = f32::from_bits(1);
        while column < 1e-2 {
            for by in [1.500_591f32, 1.4991, 1.502] {
                let matrix = [[column, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
                let pose = meshsweep_core::Pose::affine(matrix, [by * factor, 0.0, 0.0]);
                holds("column", &a, &b, &pose, &mut tallies);
            }
            column *= 7.0;
        }
    }
    assert!(tallies.iter().all(|tally| tally.apart > 0 || tally.open > 0), "{tallies:?}");
}

#[test]
fn answers_hold_where_far_origins_cancel() {
    let rotation = [
        [-2.906_628_5e-7, 0.570_989_8, 0.0],
        [-2.722_691_5e-7, -0.609_564_2, 0.0],
        [0.0, -0.514_287_23, 1.0],
    ];
    let mut rng = Rng::new(6);
    let mut tallies: [Tally; 4] = Default::default();
    for _ in 0..60 {
        let offset = rng.point_in([-1.6e7; 3], [1.6e7; 3]);
        let plate = vec![[0.0, -3.0, -3.0], [0.0, 5.0, -2.0], [0.0, -1.0, 6.0]];
        let plate = plate
            .into_iter()
            .map(|p: [f32; 3]| std::array::from_fn(|k| p[k] + offset[k]))
            .collect();
        let b = Scene::both("", (plate, vec![[0, 1, 2]]));
        // A grain, which the motion's rounding alone keeps off the plate, and a ball that is larger
        // than such rounding.
        for scale in [1.0 / (1u32 << 24) as f32, 1.0] {
            let a = Scene::both("", scaled(&icosphere(0), scale));
            let pose = placed(&b, rotation, [0.0; 3]);
            let pose = meshsweep_core::Pose { is_affine: true, ..pose };
            holds("cancelled", &a, &b, &pose, &mut tallies);
        }
    }
    assert!(tallies.iter().all(|tally| tally.apart > 50 && tally.meets > 50), "{tallies:?}");
}
