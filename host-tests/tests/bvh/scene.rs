//! Pairs of models in a scene, against brute force over all of them.

use meshsweep_core::{
    Budget, Bvh, Ended, PlacedModel, Pose, QueryError, Scene as Models, ScratchEntry, Undecided,
    Verdict,
};
use meshsweep_host_tests::generate::corpus::IDENTITY;
use meshsweep_host_tests::generate::{Rng, cube, rough_sphere, torus};
use meshsweep_host_tests::motion::rotation;
use meshsweep_host_tests::oracle::{Bounded, distance_of_meshes};
use meshsweep_host_tests::scene::Scene;

type Points = Vec<[f32; 3]>;

/// Vertices in the world, rounded.
fn moved(scene: &Scene, pose: &Pose) -> Points {
    scene.positions.iter().map(|&p| pose.to_world(p)).collect()
}

struct World {
    scenes: Vec<Scene>,
    /// Which scene, where.
    places: Vec<(usize, Pose)>,
}

impl World {
    fn random(count: usize, spread: f32, rng: &mut Rng) -> Self {
        let scenes = vec![
            Scene::both("", torus(2.0, 0.75, 12, 6)),
            Scene::both("", rough_sphere(1, 0.4, 3)),
            Scene::both("", cube(2)),
        ];
        let places = (0..count)
            .map(|_| {
                let translation = [(); 3].map(|()| spread * rng.range(-1.0, 1.0));
                (rng.below(scenes.len()), Pose { rotation: rotation(rng), translation })
            })
            .collect();
        Self { scenes, places }
    }

    fn placed(&self, is_f32: bool) -> Vec<PlacedModel<'_>> {
        let tree = |which: usize| self.scenes[which].trees()[usize::from(is_f32)];
        self.places
            .iter()
            .map(|&(which, pose)| PlacedModel::new(tree(which), pose).unwrap())
            .collect()
    }

    fn distance(&self, a: usize, b: usize) -> Bounded {
        let of = |at: usize| {
            let (which, pose) = &self.places[at];
            (moved(&self.scenes[*which], pose), &self.scenes[*which].triangles)
        };
        let ((one, first), (other, second)) = (of(a), of(b));
        distance_of_meshes((&one, first), (&other, second), &IDENTITY, [0.0; 3])
    }

    /// Of all pairs, and a length beside which roundings of the world are small.
    fn least(&self, asks: impl Fn(usize, usize) -> bool) -> (Bounded, f64) {
        let mut least = Bounded { lower: f64::INFINITY, upper: f64::INFINITY };
        for b in 0..self.places.len() {
            for a in (0..b).filter(|&a| asks(a, b)) {
                let found = self.distance(a, b);
                least.lower = least.lower.min(found.lower);
                least.upper = least.upper.min(found.upper);
            }
        }
        let far = self.places.iter().flat_map(|(_, pose)| pose.translation);
        (least, far.fold(3.0, |most: f64, x| most.max(f64::from(x.abs()))))
    }
}

fn stack() -> [ScratchEntry; Bvh::DISTANCE_ENTRIES] {
    [ScratchEntry::EMPTY; Bvh::DISTANCE_ENTRIES]
}

#[test]
fn the_nearest_pair_is_that_of_all_pairs_and_within_agrees() {
    let mut rng = Rng::new(91);
    let (mut yes, mut no) = (0, 0);
    for round in 0..14 {
        let world = World::random(2 + round % 7, [4.0, 12.0, 300.0][round % 3], &mut rng);
        let not_neighbours = |a: usize, b: usize| b != a + 1;
        let all = |_: usize, _: usize| true;
        for is_f32 in [false, true] {
            let models = world.placed(is_f32);
            let scene = Models::new(&models);
            for asks in [&all as &dyn Fn(usize, usize) -> bool, &not_neighbours] {
                let found = scene.nearest_pair(asks, Budget::EXACT, &mut stack()).unwrap();
                let (truth, far) = world.least(asks);
                let Some([a, b]) = found.models else {
                    assert!(world.places.len() == 2 && truth.upper == f64::INFINITY);
                    continue;
                };
                assert!(a < b && asks(a, b));
                // The oracle's vertices were rounded in the world.
                let slack = 4e-7 * far;
                let (lower, upper) =
                    (f64::from(found.distance.lower), f64::from(found.distance.upper));
                assert!(lower <= truth.upper + slack, "{found:?} {truth:?}");
                assert!(truth.lower - slack <= upper, "{found:?} {truth:?}");
                let errors = 2.0 * f64::from(models[a].tree().surface_error())
                    + 2.0 * f64::from(models[b].tree().surface_error());
                assert!(upper - lower <= errors + 1e-5 * far, "{found:?}");
                assert_eq!(found.ended, Ended::Exact);
                let [p, q] = found.points;
                let gap = (0..3).map(|k| f64::from(p[k] - q[k]).powi(2)).sum::<f64>().sqrt();
                assert!(gap <= upper + slack, "{found:?}");
                for distance in [0.0, 0.5 * lower, lower - slack, upper + slack, 2.0 * upper] {
                    let distance = distance.max(0.0) as f32;
                    let near = scene.within(distance, asks, Budget::EXACT, &mut stack()).unwrap();
                    match near.verdict {
                        Verdict::Yes => {
                            yes += 1;
                            assert!(truth.lower <= f64::from(distance) + slack, "{near:?}");
                        }
                        Verdict::No => {
                            no += 1;
                            assert!(truth.upper >= f64::from(distance) - slack, "{near:?}");
                        }
                        _ => assert!(
                            (truth.lower - f64::from(distance)).abs() <= errors + 1e-5 * far,
                            "{near:?} {truth:?} {distance}"
                        ),
                    }
                    assert_eq!(near.witness.is_none(), near.is_clear());
                }
            }
        }
    }
    assert!(yes > 50 && no > 50, "{yes} {no}");
}

/// A matrix that stretches one axis by a twentieth: the world's lengths count, not those of a
/// model.
#[test]
fn a_pose_that_is_no_rotation_is_paid_for() {
    let scene = Scene::both("", cube(2));
    let size = 2.0;
    let mut stretched = IDENTITY;
    stretched[0][0] = 1.05;
    let place = |x: f32| Pose { rotation: stretched, translation: [x, 0.0, 0.0] };
    for tree in scene.trees() {
        let models = [place(0.0), place(10.0)].map(|pose| PlacedModel::new(tree, pose).unwrap());
        let scene = Models::new(&models);
        let found = scene.nearest_pair(|_, _| true, Budget::EXACT, &mut stack()).unwrap();
        let truth = 10.0 - 1.05 * size;
        let (lower, upper) = (f64::from(found.distance.lower), f64::from(found.distance.upper));
        assert!(lower <= truth && truth <= upper, "{found:?}");
        let clear = scene.within(6.0, |_, _| true, Budget::EXACT, &mut stack()).unwrap();
        assert!(clear.is_clear(), "{clear:?}");
    }
}

#[test]
fn few_steps_give_an_interval_that_holds() {
    let mut rng = Rng::new(92);
    for _ in 0..6 {
        let world = World::random(6, 8.0, &mut rng);
        let (truth, far) = world.least(|_, _| true);
        let slack = 4e-7 * far;
        let models = world.placed(false);
        let scene = Models::new(&models);
        for steps in [0, 1, 3, 10, 30] {
            let budget = Budget::EXACT.with_steps(steps);
            let found = scene.nearest_pair(|_, _| true, budget, &mut stack()).unwrap();
            assert!(f64::from(found.distance.lower) <= truth.upper + slack, "{found:?}");
            assert!(truth.lower <= f64::from(found.distance.upper) + slack, "{found:?}");
            assert!(found.work.opened <= steps);
            let near = scene.within(1.0, |_, _| true, budget, &mut stack()).unwrap();
            assert!(near.work.opened <= steps);
            if near.verdict == Verdict::No {
                assert!(truth.upper + slack >= 1.0, "{near:?} {truth:?}");
            }
        }
        let found = scene.within(1.0, |_, _| true, Budget::EXACT.with_steps(0), &mut stack());
        let verdict = found.unwrap().verdict;
        assert!(matches!(verdict, Verdict::No | Verdict::Undecided(Undecided::Steps)));
    }
}

#[test]
fn a_scene_of_forty_models_looks_into_few_pairs() {
    let mut rng = Rng::new(93);
    let world = World::random(40, 60.0, &mut rng);
    let models = world.placed(false);
    let scene = Models::new(&models);
    let found = scene.nearest_pair(|_, _| true, Budget::EXACT, &mut stack()).unwrap();
    assert!(found.work.bounds >= 40 * 39 / 2 && found.work.opened < 400, "{found:?}");
}

#[test]
fn what_cannot_be_asked_is_refused_and_no_pair_is_no_error() {
    let scene = Scene::both("", cube(1));
    let tree = scene.bvh();
    let pose = |x: f32| Pose { translation: [x, 0.0, 0.0], ..Pose::IDENTITY };
    let at = |x: f32| PlacedModel::new(tree, pose(x)).unwrap();
    let ask = |models: &[PlacedModel<'_>], scratch: &mut [ScratchEntry]| {
        Models::new(models)
            .nearest_pair(|_, _| true, Budget::EXACT, scratch)
            .map(|near| near.models)
    };
    assert_eq!(ask(&[], &mut stack()), Ok(None));
    assert_eq!(ask(&[at(0.0)], &mut stack()), Ok(None));
    assert_eq!(ask(&[at(0.0), at(9.0)], &mut stack()), Ok(Some([0, 1])));
    assert_eq!(ask(&[at(0.0), at(9.0)], &mut []), Err(QueryError::NoScratch));
    // A model that is refused stays where it was.
    let mut model = at(3.0);
    for lost in [f32::NAN, f32::INFINITY] {
        let found = PlacedModel::new(tree, pose(lost)).map(|_| ());
        assert_eq!(found, Err(QueryError::NotFinite));
        assert_eq!(model.move_to(pose(lost)), Err(QueryError::NotFinite));
        let mut flat = pose(9.0);
        flat.rotation[1][2] = lost;
        assert_eq!(model.move_to(flat), Err(QueryError::NotFinite));
    }
    for place in [3.0, 1e6, f32::MAX] {
        let mut flat = pose(place);
        flat.rotation[2] = [0.0; 3];
        assert_eq!(model.move_to(flat), Err(QueryError::PoseOutOfDomain));
        flat.rotation = [[0.0; 3]; 3];
        assert_eq!(model.move_to(flat), Err(QueryError::PoseOutOfDomain));
    }
    assert_eq!(*model.pose(), pose(3.0));
    for far in [1e20, 1e30, f32::MAX] {
        let found =
            Models::new(&[at(0.0), at(far)]).nearest_pair(|_, _| true, Budget::EXACT, &mut stack());
        let found = found.unwrap().distance;
        assert!(found.lower <= far && far <= found.upper * 1.001, "{found:?}");
    }
    let two = [at(0.0), at(9.0)];
    let bad = Models::new(&two).within(-1.0, |_, _| true, Budget::EXACT, &mut stack());
    assert_eq!(bad, Err(QueryError::Tolerance));
}

/// The exact gap of two cubes of any size, one beside the other.
#[test]
fn a_scene_of_any_scale_is_never_wrongly_clear() {
    for exponent in [-76, -63, -30, 0, 30, 100, 126] {
        let unit = 2f32.powi(exponent);
        let cube = meshsweep_host_tests::generate::scaled(&cube(1), unit);
        let scene = Scene::both("", cube);
        let mut rng = Rng::new(94);
        for tree in scene.trees() {
            let [low, high] = tree.bounds();
            for _ in 0..200 {
                let off = (high[1] - low[1]) * rng.range(1.0, 1.5);
                let pose = Pose { translation: [0.0, off, 0.0], ..Pose::IDENTITY };
                let models =
                    [Pose::IDENTITY, pose].map(|pose| PlacedModel::new(tree, pose).unwrap());
                let truth = f64::from(off) - (f64::from(high[1]) - f64::from(low[1]));
                let scene = Models::new(&models);
                let Ok(found) = scene.nearest_pair(|_, _| true, Budget::EXACT, &mut stack()) else {
                    assert!(exponent > 120);
                    continue;
                };
                let (lower, upper) =
                    (f64::from(found.distance.lower), f64::from(found.distance.upper));
                assert!(lower <= truth && truth <= upper, "{exponent} {found:?} {truth:e}");
                let within = 1.02 * truth as f32;
                let near = scene.within(within, |_, _| true, Budget::EXACT, &mut stack()).unwrap();
                assert!(!near.is_clear(), "{exponent} {near:?} {truth:e} {within:e}");
            }
        }
    }
}

/// Boxes that reach beyond f32 have corners in f64.
#[test]
fn a_model_at_the_end_of_f32_is_paid_for() {
    let m = f32::MAX;
    let blade = (vec![[0.0; 3], [m, 0.0, 0.0], [0.3 * m, 0.0, 0.01 * m]], vec![[0, 1, 2]]);
    let at = 0.677 * m;
    let size = 0.2 * m;
    let plate = (
        vec![
            [at, -size, -size],
            [at, size * 4.5, -size],
            [at, size * 4.5, size],
            [at, -size, size],
        ],
        vec![[0, 1, 2], [0, 2, 3]],
    );
    let (blade, plate) = (Scene::both("", blade), Scene::both("", plate));
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let turned = [[half, -half, 0.0], [half, half, 0.0], [0.0, 0.0, 1.0]];
    let mut stretched = Pose::IDENTITY;
    stretched.rotation[0][0] = 1.05;
    // The blade's tip, and the plate as it is stretched.
    let truth = 1.05 * f64::from(at) - f64::from(half) * f64::from(m);
    for (first, second) in plate.trees().into_iter().zip(blade.trees()) {
        let models = [
            PlacedModel::new(first, stretched).unwrap(),
            PlacedModel::new(second, Pose { rotation: turned, ..Pose::IDENTITY }).unwrap(),
        ];
        let scene = Models::new(&models);
        match scene.nearest_pair(|_, _| true, Budget::EXACT, &mut stack()) {
            Ok(found) => {
                let lower = f64::from(found.distance.lower);
                assert!(lower <= truth.abs(), "{found:?} {truth:e}");
            }
            Err(error) => assert_eq!(error, QueryError::OutOfDomain),
        }
        let within = (1.5 * truth.abs()) as f32;
        match scene.within(within, |_, _| true, Budget::EXACT, &mut stack()) {
            Ok(near) => assert!(!near.is_clear(), "{near:?} {truth:e}"),
            Err(error) => assert_eq!(error, QueryError::OutOfDomain),
        }
        assert!(
            scene
                .within(f32::MAX, |_, _| true, Budget::EXACT, &mut stack())
                .is_ok_and(|near| !near.is_clear())
        );
    }
}
