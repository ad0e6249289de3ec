//! Surfaces that touch, coincide, or miss each other by next to nothing.

use super::motions::{Tally, ask, holds, is_open};
use meshsweep_core::{Pose, Verdict};
use meshsweep_host_tests::generate::corpus::IDENTITY;
use meshsweep_host_tests::generate::{cube, icosphere, joined, needle_comb, torus};
use meshsweep_host_tests::scene::Scene;

fn shifted(by: [f32; 3]) -> Pose {
    Pose::rigid(IDENTITY, by)
}

#[test]
fn surfaces_that_touch_are_open_and_never_apart() {
    for (name, mesh) in [("cube", cube(2)), ("sphere", icosphere(1)), ("needles", needle_comb())] {
        let scene = Scene::both("", mesh);
        let mut tallies: [Tally; 4] = Default::default();
        holds(name, &scene, &scene, &Pose::IDENTITY, &mut tallies);
        assert_eq!(
            tallies.iter().map(|tally| tally.apart).sum::<usize>(),
            0,
            "{name}: {tallies:?}"
        );
    }
    // Cubes of side 2 that share a face, an edge, a vertex.
    let scene = Scene::both("", cube(2));
    for by in [[2.0, 0.0, 0.0], [2.0, 2.0, 0.0], [2.0, -2.0, 2.0], [0.5, 2.0, 0.25]] {
        for tree in scene.trees() {
            let answer = ask(&tree, &tree, &shifted(by));
            assert!(is_open(answer.verdict), "{by:?}");
        }
    }
}

#[test]
fn a_gap_or_an_overlap_of_little_more_than_rounding_is_seen() {
    let scene = Scene::both("", cube(2));
    let [_, single] = scene.trees();
    for gap in [1e-3f32, 1e-6] {
        for axis in 0..3 {
            let mut by = [0.125f32, -0.25, 0.0625];
            by[axis] = 2.0 + gap;
            assert_eq!(ask(&single, &single, &shifted(by)).verdict, Verdict::No, "{by:?}");
            by[axis] = 2.0 - gap;
            let answer = ask(&single, &single, &shifted(by));
            assert_eq!(answer.verdict, Verdict::Yes, "{by:?}");
        }
    }
}

#[test]
fn coplanar_triangles_beside_each_other_are_apart() {
    // All in the plane z = 0: no plane of a triangle parts them.
    let square = (
        vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
        vec![[0, 1, 2], [0, 2, 3]],
    );
    let scene = Scene::both("", square);
    for tree in scene.trees() {
        for by in [[1.001, 0.0, 0.0], [0.3, 1.001, 0.0], [-1.1, -1.1, 0.0]] {
            assert_eq!(ask(&tree, &tree, &shifted(by)).verdict, Verdict::No, "{by:?}");
        }
        assert!(is_open(ask(&tree, &tree, &shifted([0.5, 0.5, 0.0])).verdict));
    }
    // Turned by 45 degrees beside a corner: boxes meet, triangles do not.
    let turned = [[0.6, -0.8, 0.0], [0.8, 0.6, 0.0], [0.0, 0.0, 1.0]];
    let pose = Pose::rigid(turned, [1.45, 0.55, 0.0]);
    let mut tallies: [Tally; 4] = Default::default();
    holds("coplanar", &scene, &scene, &pose, &mut tallies);
}

#[test]
fn a_model_inside_another_does_not_meet_it() {
    let (shell, core) = (Scene::both("", icosphere(3)), Scene::both("", torus(0.4, 0.2, 12, 8)));
    let mut tallies: [Tally; 4] = Default::default();
    holds("inside", &shell, &core, &shifted([0.05, 0.0, -0.1]), &mut tallies);
    assert!(tallies.iter().all(|tally| tally.apart == 1), "{tallies:?}");
}

#[test]
fn triangles_without_area_are_never_proved_to_meet_and_never_lost() {
    // A segment and a point through a square, among the triangles of a far cube.
    let far = (cube(1).0.iter().map(|p| p.map(|x| x + 20.0)).collect(), cube(1).1);
    let spike = vec![[0.2, 0.3, -1.0], [0.2, 0.3, 1.0], [0.7, 0.7, 0.0]];
    let needle = Scene::both("", joined(&(spike.clone(), vec![[0, 1, 1]]), &far));
    let dot = Scene::both("", joined(&(spike, vec![[2, 2, 2]]), &far));
    let square = Scene::both(
        "",
        (
            vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
            vec![[0, 1, 2], [0, 2, 3]],
        ),
    );
    for (a, b) in square.trees().iter().zip(needle.trees()) {
        assert_eq!(
            ask(a, &b, &Pose::IDENTITY).verdict,
            Verdict::Yes,
            "its edge passes through the square"
        );
        assert_eq!(ask(a, &b, &shifted([2.0, 0.0, 0.0])).verdict, Verdict::No);
    }
    for (a, b) in square.trees().iter().zip(dot.trees()) {
        assert!(is_open(ask(a, &b, &Pose::IDENTITY).verdict), "it touches");
        assert_eq!(ask(a, &b, &shifted([0.0, 0.0, 0.01])).verdict, Verdict::No);
    }
}
