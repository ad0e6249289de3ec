//! A model that moves keeps its distance as long as is said, and no much longer.

use super::held::truth;
use meshsweep_core::{Budget, Bvh, Ended, PairContact, Pose, QueryError, ScratchEntry};
use meshsweep_host_tests::generate::corpus::IDENTITY;
use meshsweep_host_tests::generate::{Rng, cube, rough_sphere, torus};
use meshsweep_host_tests::motion::{motions, placed, rotation};
use meshsweep_host_tests::scene::Scene;

fn ask(a: &Bvh<'_>, b: &Bvh<'_>, ends: [Pose; 2], keep: f32, budget: Budget) -> PairContact {
    let mut stack = [ScratchEntry::EMPTY; Bvh::DISTANCE_ENTRIES];
    a.first_contact_of(b, ends, keep, budget, &mut stack).expect("answers")
}

/// The pose at a part of the motion, rounded.
fn at(ends: &[Pose; 2], t: f64) -> Pose {
    let mix = |a: f32, b: f32| (f64::from(a) * (1.0 - t) + f64::from(b) * t) as f32;
    let [from, to] = ends;
    Pose {
        rotation: [0, 1, 2]
            .map(|i: usize| [0, 1, 2].map(|k: usize| mix(from.rotation[i][k], to.rotation[i][k]))),
        translation: [0, 1, 2].map(|k: usize| mix(from.translation[k], to.translation[k])),
    }
}

#[test]
fn surfaces_keep_their_distance_as_long_as_is_said_and_not_much_longer() {
    let pairs = [
        (Scene::both("", torus(2.0, 0.75, 12, 6)), Scene::both("", rough_sphere(1, 0.4, 3))),
        (Scene::both("", cube(2)), Scene::both("", cube(1))),
    ];
    let mut rng = Rng::new(1);
    let (mut clear, mut stopped) = (0, 0);
    for (number, (a, b)) in pairs.iter().enumerate() {
        let poses = motions(a, b, 24, 5 + number as u64);
        for ends in poses.chunks_exact(2) {
            let turned = Pose { translation: ends[1].translation, ..ends[0] };
            let keep = 0.3 * rng.unit_f32();
            let away =
                |pose: &Pose| Pose { translation: pose.translation.map(|x| 2.5 * x), ..*pose };
            let passing = [&ends[0], &ends[1]].map(away);
            for ends in [[ends[0], ends[1]], [ends[0], turned], passing] {
                for (first, second) in a.trees().iter().zip(b.trees()) {
                    let found = ask(first, &second, ends, keep, Budget::EXACT);
                    let until = f64::from(found.clear_until).min(1.0);
                    let slack = 1e-5 * (a.reach() + b.reach());
                    if until > 0.0 {
                        for part in [0.0, 0.1, 0.35, 0.6, 0.85, 0.99] {
                            let truth = truth(a, b, &at(&ends, until * part));
                            assert!(truth.upper > f64::from(keep) - slack, "{found:?} {truth:?}");
                        }
                    }
                    clear += usize::from(found.is_clear());
                    assert_eq!(found.is_clear(), found.ended == Ended::Exact, "{found:?}");
                    if !found.is_clear() {
                        stopped += 1;
                        let errors = f64::from(first.surface_error() + second.surface_error());
                        let near = truth(a, b, &at(&ends, until));
                        let most = f64::from(keep) + 3.0 * errors + 10.0 * slack;
                        assert!(near.lower <= most, "{found:?} {near:?} {keep}");
                    }
                }
            }
        }
    }
    assert!(clear >= 10 && stopped > 20, "{clear} {stopped}");
}

/// A thin plate between two poses that are both far from it.
#[test]
fn a_wall_between_two_places_is_not_jumped_over() {
    let mut wall = cube(4);
    wall.0.iter_mut().for_each(|p| p[0] *= 1e-4);
    let (wall, ball) = (Scene::both("", wall), Scene::both("", rough_sphere(1, 0.3, 2)));
    let mut rng = Rng::new(2);
    for _ in 0..6 {
        let turn = rotation(&mut rng);
        let ends = [-40.0, 40.0].map(|x| placed(&ball, turn, [x, 0.1, 0.2]));
        for (first, second) in wall.trees().iter().zip(ball.trees()) {
            let found = ask(first, &second, ends, 0.0, Budget::EXACT);
            assert!(found.clear_until < 0.5 && found.clear_until > 0.4, "{found:?}");
        }
    }
}

#[test]
fn few_steps_and_bad_numbers_are_said() {
    let scene = Scene::both("", torus(2.0, 0.75, 24, 12));
    let [tree, _] = scene.trees();
    let at = |x: f32| Pose { rotation: IDENTITY, translation: [x, 0.0, 0.0] };
    let ends = [at(-9.0), at(9.0)];
    let found = ask(&tree, &tree, ends, 0.0, Budget::EXACT.with_steps(3));
    assert!(found.ended == Ended::Steps && found.work.splits <= 3, "{found:?}");
    let full = ask(&tree, &tree, ends, 0.0, Budget::EXACT);
    assert!(found.clear_until <= full.clear_until, "{found:?} {full:?}");
    let mut stack = [ScratchEntry::EMPTY; Bvh::DISTANCE_ENTRIES];
    let mut refused =
        |ends, keep| tree.first_contact_of(&tree, ends, keep, Budget::EXACT, &mut stack);
    assert_eq!(refused([at(0.0), at(f32::NAN)], 0.0), Err(QueryError::NotFinite));
    assert_eq!(refused(ends, -1.0), Err(QueryError::Tolerance));
    assert_eq!(refused(ends, f32::INFINITY), Err(QueryError::Tolerance));
}
