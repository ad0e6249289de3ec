//! Is the mesh within a distance?

use super::scenes::{STACK, all, allowed_width, stack};
use meshsweep_core::{Budget, Decided, QueryError, Undecided, Verdict};
use meshsweep_host_tests::generate::{Rng, cube, scaled, torus};
use meshsweep_host_tests::oracle::Bounded;
use meshsweep_host_tests::scene::Scene;
use proptest::prelude::*;

fn ask(scene: &Scene, p: [f32; 3], d: f32, stop: &Budget, entries: usize) -> Decided<u32> {
    scene.bvh().within(p, d, *stop, &mut stack(entries)).expect("a finite question")
}

/// Never a wrong answer; whether there was one.
fn check(scene: &Scene, p: [f32; 3], d: f32, truth: Bounded, answer: Decided<u32>) -> bool {
    let name = &scene.name;
    match answer.verdict {
        Verdict::Yes => {
            let triangle = answer.witness.expect("a tree knows its triangles");
            assert!(
                truth.lower <= f64::from(d),
                "{name}: {p:?}: within {d:e}? {answer:?}, {truth:?}"
            );
            let named = scene.truth_of(p, triangle);
            assert!(
                named.lower <= f64::from(d),
                "{name}: {p:?}: within {d:e}? {answer:?}, {named:?}"
            );
        }
        Verdict::No => {
            assert!(
                truth.upper > f64::from(d),
                "{name}: {p:?}: within {d:e}? {answer:?}, {truth:?}"
            )
        }
        _ => assert!(answer.witness.is_none(), "{name}: {answer:?}"),
    }
    assert_eq!(answer.is_clear(), answer.verdict == Verdict::No);
    !matches!(answer.verdict, Verdict::Undecided(_))
}

#[test]
fn verdict_is_true_and_unknown_only_next_to_the_distance() {
    for scene in all() {
        for p in scene.points(36, &mut Rng::new(31)) {
            let truth = scene.truth(p);
            for factor in [0.0, 0.5, 0.99, 0.999_999, 1.0, 1.000_001, 1.01, 2.0, 1e6] {
                let d = (truth.upper * factor).min(3e38) as f32;
                let answer = ask(scene, p, d, &Budget::EXACT, STACK);
                if !check(scene, p, d, truth, answer) {
                    let off = (truth.upper - f64::from(d)).abs();
                    let allowed = allowed_width(scene, truth.upper);
                    assert!(off <= allowed, "unknown at {d:e}, {off:e} off {truth:?}");
                    assert_eq!(answer.verdict, Verdict::Undecided(Undecided::Resolution));
                }
            }
        }
    }
}

#[test]
fn a_short_stack_or_few_steps_never_make_a_wrong_verdict() {
    let mut unknown = 0;
    for scene in all() {
        for p in scene.points(36, &mut Rng::new(32)) {
            let truth = scene.truth(p);
            for factor in [0.3, 0.9, 1.1, 3.0] {
                let d = (truth.upper * factor).min(3e38) as f32;
                for (steps, entries) in
                    [(u32::MAX, 1), (u32::MAX, 3), (0, STACK), (1, STACK), (3, 8)]
                {
                    let answer = ask(scene, p, d, &Budget::EXACT.with_steps(steps), entries);
                    unknown += u32::from(!check(scene, p, d, truth, answer));
                    assert!(answer.work.opened <= steps);
                }
            }
        }
    }
    assert!(unknown > 100, "only {unknown} searches were cut short");
}

#[test]
fn far_points_and_huge_distances_are_answered() {
    for factor in [1.0, 1e-30, 1e30] {
        let scene = Scene::tree("torus", scaled(&torus(2.0, 0.75, 12, 8), factor), false);
        let mut rng = Rng::new(33);
        let mut far = f64::from(scene.size());
        while far < 3e38 {
            let p = rng.direction().map(|x| (f64::from(x) * far) as f32);
            let truth = scene.truth(p);
            for d in [
                0.0,
                0.5 * far as f32,
                far as f32,
                (2.0 * far).min(3.4e38) as f32,
                f32::MAX,
                f32::MIN_POSITIVE,
            ] {
                check(&scene, p, d, truth, ask(&scene, p, d, &Budget::EXACT, STACK));
            }
            let certain =
                check(&scene, p, f32::MAX, truth, ask(&scene, p, f32::MAX, &Budget::EXACT, STACK));
            assert!(certain, "{p:?}");
            far *= 7.0;
        }
    }
}

#[test]
fn out_of_reach_opens_at_most_one_node() {
    let scene = Scene::tree("cube", cube(8), false);
    let answer = ask(&scene, [3.0, 0.0, 0.0], 1.5, &Budget::EXACT, STACK);
    assert_eq!((answer.verdict, answer.work.triangles), (Verdict::No, 0));
    assert!(answer.work.opened <= 1, "{answer:?}");
}

#[test]
fn bad_distances_and_points_are_typed_errors() {
    let scene = Scene::tree("cube", cube(1), false);
    let tree = scene.bvh();
    for bad in [f32::NAN, f32::INFINITY, -1.0, -f32::MIN_POSITIVE] {
        assert_eq!(
            tree.within([0.0; 3], bad, Budget::EXACT, &mut stack(64)),
            Err(QueryError::Tolerance)
        );
    }
    for bad in [f32::NAN, f32::INFINITY] {
        assert_eq!(
            tree.within([0.0, bad, 0.0], 1.0, Budget::EXACT, &mut stack(64)),
            Err(QueryError::NotFinite)
        );
    }
    assert_eq!(tree.within([0.0; 3], 1.0, Budget::EXACT, &mut []), Err(QueryError::NoScratch));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn verdict_holds_for_any_soup_and_distance(
        seed in 0u64..100_000,
        kind in 0usize..3,
        single in any::<bool>(),
        p in prop::array::uniform3(-2f32..2.0),
        factor in 0f64..2.0,
    ) {
        let scene = super::scenes::random(kind, seed, single);
        let truth = scene.truth(p);
        let d = (truth.upper * factor) as f32;
        check(&scene, p, d, truth, ask(&scene, p, d, &Budget::EXACT, STACK));
    }
}

/// A lower end below the least normal number is reported as 0, and 0 is within every distance.
#[test]
fn next_to_the_surface_of_a_tiny_mesh_a_distance_of_zero_is_never_cleared_by_underflow() {
    let mut rng = Rng::new(35);
    let mut undecided = 0;
    for _ in 0..200 {
        let corners: Vec<[f32; 3]> =
            (0..9).map(|_| rng.point_in([0.0; 3], [2f32.powi(-122); 3])).collect();
        let mesh = (corners.clone(), vec![[0, 1, 2], [3, 4, 5], [6, 7, 8]]);
        let scene = Scene::tree("tiny", mesh, false);
        let tree = scene.bvh();
        for corner in corners {
            let by = 2f32.powi(-127) * 0.5f32.powi([0, 1, 2, 3][rng.below(4)]);
            let p = corner.map(|x| x + by);
            let answer = tree.within(p, 0.0, Budget::EXACT, &mut stack(STACK)).expect("a point");
            let near = tree.closest_point(p, Budget::EXACT, &mut stack(STACK)).expect("a point");
            let truth = scene.truth(p);
            check(&scene, p, 0.0, truth, answer);
            // Both questions look at the same triangles on every target.
            assert_eq!(near.distance.lower > 0.0, answer.verdict == Verdict::No, "{p:?}");
            undecided += usize::from(near.distance.lower == 0.0);
        }
    }
    assert!(undecided > 100, "{undecided}");
}
