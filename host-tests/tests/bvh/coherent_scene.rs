//! Scenes that remember, against the distance of all triangles in 106 bits.

use meshsweep_core::{
    Budget, Bvh, CoherentScene, KeptPair, PlacedModel, Pose, QueryError, ScratchEntry, Undecided,
    Verdict,
};
use meshsweep_host_tests::generate::{Rng, block, cube, icosphere, scaled};
use meshsweep_host_tests::motion::rotation;
use meshsweep_host_tests::oracle::{Bounded, distance_of_placed};
use meshsweep_host_tests::scene::Scene;

const MODELS: usize = 4;
const PAIRS: [[u16; 2]; 5] = [[0, 1], [0, 2], [3, 1], [1, 2], [2, 3]];

fn stack() -> [ScratchEntry; Bvh::DISTANCE_ENTRIES] {
    [ScratchEntry::EMPTY; Bvh::DISTANCE_ENTRIES]
}

/// Poses of all models, tick by tick. The first model stands still.
type Walk = Vec<[Pose; MODELS]>;

/// A turn by a small angle about a random axis, up to rounding, of a matrix.
fn turned(rows: &[[f32; 3]; 3], angle: f64, rng: &mut Rng) -> [[f32; 3]; 3] {
    let axis = rng.direction().map(f64::from);
    let (sine, cosine) = angle.sin_cos();
    let column = |k: usize| [0, 1, 2].map(|j| f64::from(rows[j][k]));
    let columns = [0, 1, 2].map(|k| {
        let v = column(k);
        let along: f64 = (0..3).map(|j| axis[j] * v[j]).sum();
        [0, 1, 2].map(|j| {
            let (next, other) = ((j + 1) % 3, (j + 2) % 3);
            let across = axis[next] * v[other] - axis[other] * v[next];
            v[j] * cosine + across * sine + axis[j] * along * (1.0 - cosine)
        })
    });
    [0, 1, 2].map(|j| [0, 1, 2].map(|k| columns[k][j] as f32))
}

/// Small steps, and now and then a jump, to a reflection too. The models rest in turn, so that one
/// that stood still begins to move.
fn walk(ticks: usize, scale: f32, rng: &mut Rng) -> Walk {
    let place = |rng: &mut Rng| rng.point_in([-4.0; 3], [4.0; 3]).map(|x| scale * x);
    let mut poses = [(); MODELS].map(|()| Pose::rigid(rotation(rng), place(rng)));
    let mut walk = Vec::new();
    for tick in 0..ticks {
        for (k, pose) in poses.iter_mut().enumerate().skip(1) {
            if rng.below(25) == 0 {
                *pose = Pose::rigid(rotation(rng), place(rng));
                if rng.below(2) == 0 {
                    pose.rotation[0] = pose.rotation[0].map(|x| -x);
                    pose.is_affine = true;
                }
            } else if tick % 7 != 3 && (tick / 5 + k) % 3 != 0 {
                let step = rng.direction().map(|x| 0.02 * scale * x);
                pose.translation.iter_mut().zip(step).for_each(|(x, by)| *x += by);
                pose.rotation = turned(&pose.rotation, 0.01 * rng.unit_f64(), rng);
            }
        }
        walk.push(poses);
    }
    walk
}

fn truths(scenes: &[Scene; MODELS], poses: &[Pose; MODELS]) -> [Bounded; PAIRS.len()] {
    PAIRS.map(|pair| {
        let [a, b] = pair.map(|at| {
            let (scene, pose) = (&scenes[usize::from(at)], &poses[usize::from(at)]);
            ((scene.positions.as_slice(), scene.triangles.as_slice()), pose)
        });
        distance_of_placed(a, b)
    })
}

#[test]
fn a_scene_that_remembers_never_clears_a_pair_that_is_too_near() {
    let mut rng = Rng::new(401);
    let (mut yes, mut no, mut remembered) = (0, 0, 0);
    for round in 0..8 {
        let scale = [1.0, 1e-30, 1e30, 0.3][round % 4];
        let shapes = [block([-6.0, -6.0, -5.0], [6.0, 6.0, -4.0]), cube(1), cube(1), icosphere(1)];
        let scenes = shapes.map(|shape| Scene::both("", scaled(&shape, scale)));
        let walk = walk(60, scale, &mut rng);
        let truths: Vec<_> = walk.iter().map(|poses| truths(&scenes, poses)).collect();
        for _ in 0..4 {
            // Some thresholds are next to the distance at one of the ticks, most are far below.
            let mut pairs = PAIRS.map(|models| KeptPair { models, distance: 0.0 });
            for (k, pair) in pairs.iter_mut().enumerate() {
                let truth = truths[rng.below(truths.len())][k].upper;
                let part = [1.0, 1.0 + 1e-6, 1.0 - 1e-6, 0.02, 0.02, 0.02, 0.02][rng.below(7)];
                pair.distance = (truth * part) as f32;
            }
            let is_f32 = rng.below(2);
            let placed =
                |k: usize| PlacedModel::new(scenes[k].trees()[is_f32], walk[0][k]).unwrap();
            let mut scene = CoherentScene::new([0, 1, 2, 3].map(placed), pairs).unwrap();
            for (tick, (poses, truths)) in walk.iter().zip(&truths).enumerate() {
                if tick > 0 {
                    for (k, pose) in poses.iter().enumerate().skip(1) {
                        if *pose != walk[tick - 1][k] {
                            scene.move_to(k, *pose).unwrap();
                        }
                    }
                }
                let found = scene.within(Budget::EXACT, &mut stack()).unwrap();
                let near = |k: usize| truths[k].upper <= f64::from(pairs[k].distance);
                match found.verdict {
                    Verdict::No => {
                        no += 1;
                        remembered += usize::from(found.work.bounds == 0);
                        let missed = (0..PAIRS.len()).find(|&k| near(k));
                        assert_eq!(missed, None, "{tick} {found:?} {truths:?} {pairs:?}");
                    }
                    Verdict::Yes => {
                        yes += 1;
                        let named = found.witness.unwrap();
                        let k = PAIRS.iter().position(|pair| pair.map(usize::from) == named);
                        let (truth, pair) = (truths[k.unwrap()], pairs[k.unwrap()]);
                        // The oracle measures triangles that meet by their edges.
                        let slack = 3.0 * f64::from(scale);
                        assert!(truth.lower <= f64::from(pair.distance) + slack, "{found:?}");
                    }
                    _ => {}
                }
            }
        }
    }
    assert!(yes > 40 && no > 40 && remembered > 15, "{yes} {no} {remembered}");
}

#[test]
fn a_scene_that_remembers_agrees_with_one_that_does_not() {
    let mut rng = Rng::new(402);
    let shapes = [block([-6.0, -6.0, -5.0], [6.0, 6.0, -4.0]), cube(1), icosphere(1), cube(2)];
    let scenes = shapes.map(|shape| Scene::both("", shape));
    let pairs = PAIRS.map(|models| KeptPair { models, distance: 0.2 });
    let placed = |poses: &[Pose; MODELS]| {
        [0, 1, 2, 3].map(|k| PlacedModel::new(scenes[k].bvh(), poses[k]).unwrap())
    };
    let walk = walk(200, 1.0, &mut rng);
    let mut scene = CoherentScene::new(placed(&walk[0]), pairs).unwrap();
    let mut bounds = [0, 0];
    for poses in &walk {
        for (k, pose) in poses.iter().enumerate() {
            scene.move_to(k, *pose).unwrap();
        }
        let found = scene.within(Budget::EXACT, &mut stack()).unwrap();
        let mut fresh = CoherentScene::new(placed(poses), pairs).unwrap();
        let again = fresh.within(Budget::EXACT, &mut stack()).unwrap();
        assert_eq!(found.verdict, again.verdict, "{found:?} {again:?}");
        bounds[0] += found.work.bounds;
        bounds[1] += again.work.bounds;
        // Nothing moved: what is clear is clear without a look.
        let still = scene.within(Budget::EXACT, &mut stack()).unwrap();
        assert_eq!(still.verdict, found.verdict);
        // Without steps nothing is searched.
        fresh.reset();
        let cut = fresh.within(Budget::EXACT.with_steps(0), &mut stack()).unwrap();
        assert_eq!(cut.work.opened, 0);
        assert!(matches!(cut.verdict, Verdict::No | Verdict::Undecided(Undecided::Steps)));
    }
    assert!(bounds[0] < bounds[1], "{bounds:?}");
}

#[test]
fn a_scene_that_remembers_refuses_what_it_cannot_keep() {
    let model = Scene::both("", cube(1));
    let pose = |x: f32| Pose { translation: [x, 0.0, 0.0], ..Pose::IDENTITY };
    let models = [0.0, 9.0].map(|x| PlacedModel::new(model.bvh(), pose(x)).unwrap());
    let refused = |models_of: [u16; 2], distance: f32| {
        CoherentScene::new(models, [KeptPair { models: models_of, distance }]).err()
    };
    for pair in [[0, 2], [2, 0], [1, 1], [u16::MAX, 0]] {
        assert_eq!(refused(pair, 1.0), Some(QueryError::NoModel));
    }
    for distance in [-1.0, f32::NAN, f32::INFINITY] {
        assert_eq!(refused([0, 1], distance), Some(QueryError::Tolerance));
    }
    let pairs = [KeptPair { models: [0, 1], distance: 1.0 }];
    let mut scene = CoherentScene::new(models, pairs).unwrap();
    assert_eq!(scene.move_to(2, pose(0.0)), Err(QueryError::NoModel));
    assert_eq!(scene.move_to(1, pose(f32::NAN)), Err(QueryError::NotFinite));
    // A matrix that leaves the rotations by small steps is refused as at once.
    let mut flat = Pose { is_affine: true, ..pose(9.0) };
    let mut is_refused = false;
    for step in 0..200 {
        flat.rotation[2] = [0.0, 0.0, 1.0 - 0.005 * step as f32];
        let at_once = PlacedModel::new(model.bvh(), flat).map(|_| ());
        assert_eq!(scene.move_to(1, flat), at_once);
        is_refused |= at_once == Err(QueryError::PoseOutOfDomain);
    }
    assert!(is_refused);
    // One that may be none is refused when it changes much.
    flat.is_affine = false;
    assert_eq!(scene.move_to(1, flat), Err(QueryError::NotRigid));
    assert!(scene.within(Budget::EXACT, &mut stack()).unwrap().is_clear());
    assert_eq!(scene.within(Budget::EXACT, &mut []), Err(QueryError::NoScratch));
    let mut none = CoherentScene::new([], []).unwrap();
    assert!(none.within(Budget::EXACT, &mut stack()).unwrap().is_clear());
}

/// A huge bar turns about its middle towards a part: its squared gap is infinite in f32.
#[test]
fn a_clearance_whose_square_is_infinite_is_used_up() {
    let bar = Scene::both("", block([-5e20, -1e18, -1e18], [5e20, 1e18, 1e18]));
    let part = Scene::both("", scaled(&cube(1), 1e18));
    let at = Pose { translation: [0.0, 1e20, 0.0], ..Pose::IDENTITY };
    let models = [
        PlacedModel::new(bar.bvh(), Pose::IDENTITY).unwrap(),
        PlacedModel::new(part.bvh(), at).unwrap(),
    ];
    let pairs = [KeptPair { models: [0, 1], distance: 1e18 }];
    let mut scene = CoherentScene::new(models, pairs).unwrap();
    assert!(scene.within(Budget::EXACT, &mut stack()).unwrap().is_clear());
    for step in 1..=80 {
        let (sine, cosine) = (f64::from(step) * std::f64::consts::FRAC_PI_2 / 80.0).sin_cos();
        let [sine, cosine] = [sine, cosine].map(|x| x as f32);
        let turned = [[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]];
        scene.move_to(0, Pose::rigid(turned, [0.0; 3])).unwrap();
        let found = scene.within(Budget::EXACT, &mut stack()).unwrap();
        // Until here the bar is far below the part.
        assert!(step > 70 || found.is_clear(), "{step} {found:?}");
        // At a right angle it passes through.
        assert!(step < 80 || !found.is_clear(), "{found:?}");
    }
}
