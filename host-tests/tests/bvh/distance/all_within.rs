//! All triangles within a distance.

use super::scenes::{STACK, all, stack};
use meshsweep_core::{AllWithin, Budget, Ended, Neighbor, QueryError};
use meshsweep_host_tests::generate::{Rng, cube, scaled, torus};
use meshsweep_host_tests::scene::Scene;

fn ask(
    scene: &Scene,
    p: [f32; 3],
    d: f32,
    n: usize,
    stop: &Budget,
    entries: usize,
) -> (AllWithin, Vec<Neighbor>) {
    let mut out = vec![Neighbor::EMPTY; n];
    let answer = scene
        .bvh()
        .all_within(p, d, &mut out, *stop, &mut stack(entries))
        .expect("a finite question");
    assert!(answer.certain <= answer.stored && answer.stored <= n);
    out.truncate(answer.stored);
    (answer, out)
}

/// Distances that some, none or all triangles are within.
fn distances(scene: &Scene, p: [f32; 3]) -> [f32; 6] {
    let nearest = scene.truth(p).upper;
    let size = f64::from(scene.size());
    [0.0, nearest * 0.9, nearest, nearest * 1.01, nearest + 0.1 * size, nearest * 2.0 + 2.0 * size]
        .map(|d| d.min(3e38) as f32)
}

#[test]
fn certain_ones_are_within_and_none_that_is_within_is_missing() {
    for scene in all() {
        for p in scene.points(24, &mut Rng::new(51)) {
            let truths: Vec<_> =
                (0..scene.triangles.len() as u32).map(|t| scene.truth_of(p, t)).collect();
            for d in distances(scene, p) {
                let (answer, out) = ask(scene, p, d, truths.len() + 1, &Budget::EXACT, STACK);
                assert_eq!((answer.dropped, answer.ended), (0, Ended::Exact), "{d:e}");
                let mut listed = vec![false; truths.len()];
                for (i, near) in out.iter().enumerate() {
                    let truth = truths[near.triangle() as usize];
                    let holds = f64::from(near.distance().lower) <= truth.upper
                        && truth.lower <= f64::from(near.distance().upper);
                    assert!(holds, "{near:?} does not contain {truth:?}");
                    assert!(near.distance().lower <= d, "{near:?} is beyond {d:e}");
                    assert_eq!(near.distance().upper <= d, i < answer.certain, "{near:?} {d:e}");
                    assert!(
                        !std::mem::replace(&mut listed[near.triangle() as usize], true),
                        "twice"
                    );
                }
                for (t, truth) in truths.iter().enumerate().filter(|(t, _)| !listed[*t]) {
                    assert!(truth.upper > f64::from(d), "{t} at {truth:?} misses from {d:e}");
                }
                assert!(out.is_sorted_by(|a, b| a.distance().upper <= b.distance().upper));
            }
        }
    }
}

#[test]
fn what_does_not_fit_is_counted_and_the_closest_are_kept() {
    for scene in all() {
        for p in scene.points(12, &mut Rng::new(52)) {
            for d in distances(scene, p) {
                let (all, most) = ask(scene, p, d, scene.triangles.len(), &Budget::EXACT, STACK);
                for n in [0, 1, 3, 10] {
                    let (answer, out) = ask(scene, p, d, n, &Budget::EXACT, STACK);
                    assert_eq!(answer.stored + answer.dropped as usize, all.stored);
                    assert_eq!(out, most[..answer.stored], "{d:e}");
                    assert_eq!(answer.certain, all.certain.min(answer.stored));
                }
            }
        }
    }
}

#[test]
fn short_stacks_and_few_steps_store_only_what_is_within() {
    let mut cut = 0;
    for scene in all() {
        for p in scene.points(12, &mut Rng::new(53)) {
            for d in distances(scene, p) {
                for (steps, entries) in [(u32::MAX, 1), (u32::MAX, 9), (0, 9), (2, STACK)] {
                    let (answer, out) =
                        ask(scene, p, d, 16, &Budget::EXACT.with_steps(steps), entries);
                    for near in out.iter().take(answer.certain) {
                        assert!(scene.truth_of(p, near.triangle()).lower <= f64::from(d));
                    }
                    cut += u32::from(answer.ended != Ended::Exact);
                }
            }
        }
    }
    assert!(cut > 100, "only {cut} searches were cut short");
}

#[test]
fn from_far_away_all_or_none_are_within() {
    let scene = Scene::tree("torus", scaled(&torus(2.0, 0.75, 12, 8), 1e-20), false);
    let p = [1.0, 2.0, 2.0];
    let all = scene.triangles.len();
    assert_eq!(ask(&scene, p, 2.5, all, &Budget::EXACT, STACK).0.stored, 0);
    let (answer, _) = ask(&scene, p, 3.5, 5, &Budget::EXACT, STACK);
    assert_eq!((answer.stored, answer.certain, answer.dropped as usize), (5, 5, all - 5));
    let (answer, _) = ask(&scene, p, 3.0, all, &Budget::EXACT, STACK);
    assert_eq!((answer.stored, answer.certain), (all, 0));
}

#[test]
fn bad_questions_are_typed_errors() {
    let scene = Scene::tree("cube", cube(1), false);
    let (tree, mut out) = (scene.bvh(), [Neighbor::EMPTY; 2]);
    for bad in [f32::NAN, f32::INFINITY, -1.0] {
        let answer = tree.all_within([0.0; 3], bad, &mut out, Budget::EXACT, &mut stack(64));
        assert_eq!(answer, Err(QueryError::Tolerance));
    }
    let nan = [0.0, 0.0, f32::NAN];
    assert_eq!(
        tree.all_within(nan, 1.0, &mut out, Budget::EXACT, &mut stack(64)),
        Err(QueryError::NotFinite)
    );
    assert_eq!(
        tree.all_within([0.0; 3], 1.0, &mut out, Budget::EXACT, &mut []),
        Err(QueryError::NoScratch)
    );
}
