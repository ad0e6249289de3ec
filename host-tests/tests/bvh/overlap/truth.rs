//! Random motions of solids and soups: every answer and every pair is the exact one.

use super::motions::{Tally, holds, motions};
use meshsweep_host_tests::generate::{
    Triangles, bracket, cube, groove_block, icosphere, joined, needle_comb, rough_sphere, torus,
    two_parts, uv_sphere,
};
use meshsweep_host_tests::scene::Scene;

/// Random triangles of sizes from a thousandth of the whole to all of it.
fn soup(seed: u64) -> Triangles {
    let mut rng = meshsweep_host_tests::generate::Rng::new(seed);
    let mut positions = Vec::new();
    for _ in 0..150 {
        let centre = rng.point_in([-1.0; 3], [1.0; 3]);
        let size = 10f32.powf(rng.range(-3.0, 0.0));
        for _ in 0..3 {
            positions.push(std::array::from_fn(|k| centre[k] + size * rng.range(-1.0, 1.0)));
        }
    }
    (positions, (0..150).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect())
}

fn check(name: &str, a: Triangles, b: Triangles, count: usize, seed: u64) -> [Tally; 4] {
    let (a, b) = (Scene::both("", a), Scene::both("", b));
    let mut tallies = Default::default();
    for pose in motions(&a, &b, count, seed) {
        holds(name, &a, &b, &pose, &mut tallies);
    }
    // With exact vertices nothing is left open in general position.
    assert_eq!(tallies[3].open, 0, "{name}: {tallies:?}");
    let all: usize = tallies.iter().map(|tally| tally.open).sum();
    // On a grid thin needles may be moved by as much as they are wide.
    assert!(all * 5 <= count * 4, "{name}: {tallies:?}");
    assert!(tallies[3].apart > 0 && tallies[3].meets > 0, "{name}: {tallies:?}");
    tallies
}

#[test]
fn smooth_solids_meet_exactly_where_their_input_does() {
    check("torus, torus", torus(2.0, 0.75, 20, 10), torus(2.0, 0.75, 20, 10), 40, 1);
    check("spheres", icosphere(2), rough_sphere(2, 0.4, 3), 40, 2);
    check("meridians, parts", uv_sphere(24, 12), two_parts(), 30, 3);
}

#[test]
fn flat_faces_and_needles_meet_exactly_where_their_input_does() {
    check("cubes", cube(1), cube(4), 60, 4);
    check("needles, cube", needle_comb(), cube(3), 40, 5);
    check("grooves", groove_block(), groove_block(), 20, 6);
    check("bracket, sphere", bracket(), rough_sphere(2, 0.8, 7), 16, 7);
}

#[test]
fn soups_meet_exactly_where_their_input_does() {
    check("soups", soup(8), soup(9), 25, 8);
    check("soup, parts", soup(10), joined(&cube(2), &soup(11)), 20, 9);
}

#[test]
fn models_of_very_different_size_are_told_apart() {
    for (factor, seed) in [(1.0 / 64.0, 12), (37.0, 13), (1.0 / 4096.0, 14)] {
        let small = meshsweep_host_tests::generate::scaled(&rough_sphere(1, 0.3, 4), factor);
        let (a, b) = (Scene::both("", torus(2.0, 0.75, 16, 8)), Scene::both("", small));
        let mut tallies: [Tally; 4] = Default::default();
        for pose in motions(&a, &b, 30, seed) {
            holds("sizes", &a, &b, &pose, &mut tallies);
        }
        // The small one beside a vertex of the large one, so that it is met.
        let at = super::motions::placed(
            &b,
            meshsweep_host_tests::generate::corpus::IDENTITY,
            a.positions[5],
        );
        holds("sizes", &a, &b, &at, &mut tallies);
        assert!(tallies[3].meets > 0 && tallies[3].apart > 0, "{factor}: {tallies:?}");
    }
}

#[test]
fn blobs_of_vertices_that_were_moved_speak_of_the_input() {
    for (by, seed) in [(1e-2f32, 15), (1e-4, 16)] {
        let (a, b) = (torus(2.0, 0.75, 20, 10), rough_sphere(2, 0.4, 3));
        let (first, second) = (Scene::moved("", a, by, seed), Scene::moved("", b, by, seed + 10));
        let mut tallies: [Tally; 4] = Default::default();
        for pose in motions(&first, &second, 40, seed) {
            holds("moved", &first, &second, &pose, &mut tallies);
        }
        assert!(
            tallies.iter().all(|tally| tally.apart > 4 && tally.meets > 4),
            "{by}: {tallies:?}"
        );
    }
}
