//! What boxes and balls prove of two models that are apart, against the distance of all triangles
//! in 106 bits. The models fill their boxes, so that a bound that is too large shows.

use meshsweep_core::{Budget, Bvh, PlacedModel, Pose, Scene as Models, ScratchEntry, Verdict};
use meshsweep_host_tests::generate::{Rng, Triangles, block, cube, icosphere, scaled, torus};
use meshsweep_host_tests::motion::rotation;
use meshsweep_host_tests::oracle::{Bounded, distance_of_placed};
use meshsweep_host_tests::scene::Scene;

fn stack() -> [ScratchEntry; Bvh::DISTANCE_ENTRIES] {
    [ScratchEntry::EMPTY; Bvh::DISTANCE_ENTRIES]
}

fn truth(scenes: [&Scene; 2], poses: &[Pose; 2]) -> Bounded {
    let [a, b] = scenes.map(|scene| (scene.positions.as_slice(), scene.triangles.as_slice()));
    distance_of_placed((a, &poses[0]), (b, &poses[1]))
}

/// Not below the truth: none of these distances may be called clear.
fn near(truth: Bounded) -> impl Iterator<Item = f32> {
    let up = (truth.upper as f32).next_up();
    [0.0, 1e-7, 2e-7, 1e-6, 1e-5, 1e-3].map(|part| up * (1.0 + part)).into_iter()
}

/// How often a verdict was `No` without a look into the trees, and how often there was a look.
#[derive(Debug, Default)]
struct Tally {
    cheap: usize,
    looked: usize,
}

/// Holds all verdicts about two placed models to the truth.
fn holds(scenes: [&Scene; 2], poses: &[Pose; 2], tally: &mut Tally) {
    let truth = truth(scenes, poses);
    for number in 0..4 {
        let trees = [scenes[0].trees()[number & 1], scenes[1].trees()[number >> 1]];
        let placed = [0, 1].map(|k| PlacedModel::new(trees[k], poses[k]).expect("a rotation"));
        for models in [placed, placed.map(PlacedModel::with_least_ball)] {
            let scene = Models::new(&models);
            let ask = |distance: f32| {
                scene.within(distance, |_, _| true, Budget::EXACT, &mut stack()).expect("answers")
            };
            for distance in near(truth) {
                let found = ask(distance);
                assert!(!found.is_clear(), "{found:?} {truth:?} {distance:e} {poses:?}");
            }
            for part in [0.999, 0.9, 0.5, 0.1, 0.0] {
                let found = ask(truth.lower as f32 * part);
                match (found.verdict, found.work.opened) {
                    (Verdict::No, 0) => tally.cheap += 1,
                    _ => tally.looked += 1,
                }
                assert_ne!(found.verdict, Verdict::Yes, "{found:?} {truth:?} {poses:?}");
            }
        }
    }
}

fn shapes() -> [Triangles; 4] {
    [block([-3.0, -0.2, -0.1], [4.0, 0.3, 0.2]), cube(1), icosphere(1), torus(2.0, 0.4, 6, 3)]
}

/// A matrix that is a rotation, a reflection, or one that is stretched and skewed a little.
fn matrix(kind: usize, rng: &mut Rng) -> [[f32; 3]; 3] {
    let mut rows = rotation(rng);
    match kind % 5 {
        1 => rows[2] = rows[2].map(|x| -x),
        2 => rows = rows.map(|row| row.map(|x| x * 1.02)),
        3 => {
            for (x, y) in rows[0].into_iter().zip(&mut rows[1]) {
                *y += 0.03 * x;
            }
        }
        4 => rows[1] = rows[1].map(|x| x * 0.93),
        _ => {}
    }
    rows
}

#[test]
fn no_box_or_ball_makes_two_placed_models_clear_that_are_not() {
    let mut rng = Rng::new(301);
    let mut tally = Tally::default();
    for round in 0..60 {
        let scale = [1.0, 1e-30, 1e30, 1e-12, 37.0, 1e12][round % 6];
        let [a, b] = [(); 2].map(|()| {
            let shape = &shapes()[rng.below(4)];
            Scene::both("", scaled(shape, scale))
        });
        // Far from the world's origin, or at it.
        let base = [0.0, 1.0, 900.0][round % 3];
        let origin = rng.direction().map(|x| x * base);
        let way = rng.direction().map(|x| x * rng.range(5.0, 12.0));
        let place = |by: f32| [0, 1, 2].map(|k| scale * (origin[k] + by * way[k]));
        let poses = [0.0, 1.0]
            .map(|by| Pose { rotation: matrix(rng.below(10), &mut rng), translation: place(by) });
        if truth([&a, &b], &poses).lower > 0.1 * f64::from(scale) {
            holds([&a, &b], &poses, &mut tally);
        }
    }
    assert!(tally.cheap > 100 && tally.looked > 100, "{tally:?}");
}

/// Here the gap of the boxes is the distance.
#[test]
fn boxes_that_nearly_touch_are_never_called_clear() {
    let mut rng = Rng::new(302);
    let mut tally = Tally::default();
    for round in 0..40 {
        let size = [1.0, 1e-3, 250.0, 1e-20][round % 4];
        let scene = Scene::both("", scaled(&cube(1), size));
        let ([low, ..], [high, ..]) = scene.bounds();
        let side = f64::from(high) - f64::from(low);
        let gap = [1e-6, 1e-4, 1e-2, 0.5][round / 4 % 4] * side;
        // The axes of both are those of the world, but for their order and signs; or all turned.
        let swapped = [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
        let turned = if round % 3 == 0 { swapped } else { rotation(&mut rng) };
        let axis = turned.map(|row| f64::from(row[1]));
        let base = rng.point_in([-3.0; 3], [3.0; 3]).map(|x| f64::from(size * x));
        let place = |off: f64| [0, 1, 2].map(|k| (base[k] + off * axis[k]) as f32);
        let poses = [0.0, side + gap].map(|off| Pose { rotation: turned, translation: place(off) });
        holds([&scene, &scene], &poses, &mut tally);
    }
    assert!(tally.cheap > 100, "{tally:?}");
}

/// The matrix of a pair need not be a rotation: its entries are at most 2.
#[test]
fn no_box_makes_a_model_clear_that_any_matrix_moved() {
    let mut rng = Rng::new(303);
    let (mut cheap, mut looked) = (0, 0);
    for round in 0..60 {
        let scale = [1.0, 1e-30, 1e30, 40.0][round % 4];
        let [a, b] = [(); 2].map(|()| {
            let shape = &shapes()[rng.below(4)];
            Scene::both("", scaled(shape, scale))
        });
        let rotation = match round % 3 {
            0 => [(); 3].map(|()| [(); 3].map(|()| rng.range(-2.0, 2.0))),
            1 => [[0.0; 3], rng.direction(), [0.0; 3]],
            _ => matrix(round, &mut rng),
        };
        let translation = rng.direction().map(|x| scale * x * rng.range(6.0, 20.0));
        let poses = [Pose::IDENTITY, Pose { rotation, translation }];
        let truth = truth([&a, &b], &poses);
        if truth.lower < 0.1 * f64::from(scale) {
            continue;
        }
        for number in 0..4 {
            let (first, second) = (a.trees()[number & 1], b.trees()[number >> 1]);
            let ask = |distance: f32| {
                let budget = Budget::EXACT;
                first.within_of(&second, poses[1], distance, budget, &mut stack()).unwrap()
            };
            for distance in near(truth) {
                let found = ask(distance);
                assert!(!found.is_clear(), "{found:?} {truth:?} {distance:e} {poses:?}");
            }
            for part in [0.999, 0.5, 0.0] {
                let found = ask(truth.lower as f32 * part);
                assert_ne!(found.verdict, Verdict::Yes, "{found:?} {truth:?} {poses:?}");
                if found.is_clear() && found.work.opened == 0 { cheap += 1 } else { looked += 1 }
            }
        }
    }
    assert!(cheap > 100 && looked > 50, "{cheap} {looked}");
}
