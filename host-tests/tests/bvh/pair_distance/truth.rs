//! Random motions of solids, soups and slivers: every interval contains the true distance.

use super::held::{Tally, ask, holds, truth};
use meshsweep_core::{Budget, Pose};
use meshsweep_host_tests::generate::corpus::{IDENTITY, mixed, slivers};
use meshsweep_host_tests::generate::{
    Rng, Triangles, bracket, cube, icosphere, inverted, joined, needle_comb, rough_sphere, scaled,
    torus, two_parts,
};
use meshsweep_host_tests::motion::{motions, placed, rotation};
use meshsweep_host_tests::scene::Scene;

fn check(name: &str, a: Triangles, b: Triangles, count: usize, seed: u64) -> Tally {
    let (a, b) = (Scene::both("", a), Scene::both("", b));
    let mut tally = Tally::default();
    for pose in motions(&a, &b, count, seed) {
        holds(name, &a, &b, &pose, &mut tally);
    }
    assert!(tally.apart > 0, "{name}: {tally:?}");
    tally
}

#[test]
fn distances_of_solids_are_those_of_their_input() {
    let tallies = [
        check("torus, torus", torus(2.0, 0.75, 16, 8), torus(2.0, 0.75, 16, 8), 24, 1),
        check("spheres", icosphere(2), rough_sphere(2, 0.4, 3), 24, 2),
        check("cubes", cube(1), cube(4), 30, 3),
        check("bracket, sphere", bracket(), rough_sphere(2, 0.8, 7), 10, 4),
        check("parts", two_parts(), cube(2), 20, 5),
    ];
    assert!(tallies.iter().any(|tally| tally.meets > 0), "{tallies:?}");
}

#[test]
fn distances_of_needles_slivers_and_soups_are_those_of_their_input() {
    check("needles, cube", needle_comb(), cube(3), 12, 6);
    check("needles, needles", needle_comb(), needle_comb(), 8, 7);
    for along in [false, true] {
        check("slivers", slivers(60, 8, along), slivers(60, 9, !along), 8, 8);
    }
    check("mixed", mixed(80, 10), cube(2), 8, 10);
}

#[test]
fn the_distance_of_a_surface_inside_another_is_that_of_the_surfaces() {
    let ball = Scene::both("", scaled(&rough_sphere(2, 0.3, 1), 0.3));
    let shell = Scene::both("", joined(&scaled(&cube(3), 8.0), &inverted(&icosphere(2))));
    let mut rng = Rng::new(11);
    let mut tally = Tally::default();
    for _ in 0..12 {
        let place = rng.point_in([-0.3; 3], [0.3; 3]);
        holds("inside", &shell, &ball, &placed(&ball, rotation(&mut rng), place), &mut tally);
    }
    assert!(tally.apart > 6, "{tally:?}");
}

#[test]
fn touching_surfaces_have_a_lower_end_of_zero() {
    let (a, b) = (Scene::both("", cube(2)), Scene::both("", cube(3)));
    let (low, high) = a.bounds();
    let side = high[0] - low[0];
    let mut tally = Tally::default();
    for translation in [
        [side, 0.0, 0.0],
        [side, side, 0.0],
        [side, -side, side],
        [0.0; 3],
        [0.25 * side, side, 0.5 * side],
    ] {
        holds("touching", &a, &b, &Pose::rigid(IDENTITY, translation), &mut tally);
    }
    assert_eq!(tally.apart, 0, "{tally:?}");
}

/// The edges of a small cube that stands on a large one are far from those of the large one.
#[test]
fn a_small_body_on_a_large_face_has_a_distance_near_zero() {
    let (large, small) = (Scene::both("", scaled(&cube(1), 100.0)), Scene::both("", cube(1)));
    let ((_, top), (bottom, _)) = (large.bounds(), small.bounds());
    let mut tally = Tally::default();
    for sideways in [[20.0, 30.0], [-50.0, 1.0], [7.25, -41.5]] {
        let translation = [sideways[0], sideways[1], top[2] - bottom[2]];
        let pose = Pose::rigid(IDENTITY, translation);
        holds("standing", &large, &small, &pose, &mut tally);
        for (a, b) in large.trees().iter().zip(small.trees()) {
            let found = ask(a, &b, &pose, Budget::EXACT);
            assert!(found.distance.upper < 0.1, "{found:?}");
        }
    }
}

#[test]
fn small_gaps_are_seen() {
    let (a, b) = (Scene::both("", cube(2)), Scene::both("", rough_sphere(2, 0.4, 2)));
    let mut rng = Rng::new(12);
    let mut tally = Tally::default();
    for _ in 0..4 {
        let turn = rotation(&mut rng);
        let away = placed(&b, turn, [5.0, 0.4, 0.3]);
        let gap = truth(&a, &b, &away).lower;
        // Along x the gap of convex bodies shrinks by no more than the way.
        for left in [1e-2, 1e-4, 1e-6, 0.0] {
            let mut pose = away;
            for _ in 0..8 {
                let rest = truth(&a, &b, &pose).lower - left * gap;
                pose.translation[0] -= rest.max(0.0) as f32;
            }
            holds("small gap", &a, &b, &pose, &mut tally);
        }
    }
}

#[test]
fn blobs_of_vertices_that_were_moved_speak_of_the_input() {
    for (by, seed) in [(1e-2f32, 15), (1e-4, 16)] {
        let (a, b) = (torus(2.0, 0.75, 16, 8), rough_sphere(2, 0.4, 3));
        let (first, second) = (Scene::moved("", a, by, seed), Scene::moved("", b, by, seed + 10));
        let mut tally = Tally::default();
        for pose in motions(&first, &second, 20, seed) {
            holds("moved", &first, &second, &pose, &mut tally);
        }
        assert!(tally.apart > 4 && tally.meets > 2, "{by}: {tally:?}");
    }
}
