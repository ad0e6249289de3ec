//! Questions about a model that a pose moved, beside the mesh with every vertex moved in 106 bits.

use super::distance::scenes::{STACK, all, stack};
use meshsweep_core::{
    Budget, Bvh, Ended, Facing, Hull, Interval, Pose, PosedPoint, QueryError, Verdict,
};
use meshsweep_host_tests::generate::{Rng, cube, rough_sphere};
use meshsweep_host_tests::motion::{Point, placed, rotation};
use meshsweep_host_tests::oracle::moved::{Place, triangles_meet};
use meshsweep_host_tests::oracle::{Bounded, distance_to_moved_mesh};
use meshsweep_host_tests::scene::Scene;
use robust::{Coord, orient2d};

fn truth(scene: &Scene, pose: &Pose, world: Point) -> Bounded {
    let (points, rows) = (scene.positions.as_slice(), pose.rotation.as_slice());
    distance_to_moved_mesh(world, [points, rows], &scene.triangles, pose.translation)
}

fn contains(interval: Interval, truth: Bounded) -> bool {
    f64::from(interval.lower) <= truth.upper && truth.lower <= f64::from(interval.upper)
}

fn has_area([a, b, c]: [Point; 3]) -> bool {
    (0..3).any(|k| {
        let [i, j] = [(k + 1) % 3, (k + 2) % 3];
        let at = |p: Point| Coord { x: f64::from(p[i]), y: f64::from(p[j]) };
        orient2d(at(a), at(b), at(c)) != 0.0
    })
}

/// Rotations, one of them with stretched and sheared columns, and the model near and far from its
/// origin's place.
fn poses(scene: &Scene, rng: &mut Rng) -> Vec<Pose> {
    let (turned, size) = (rotation(rng), scene.size());
    let bent = turned.map(|[x, y, z]| [1.03 * x, y + 0.05 * x, 0.96 * z]);
    let (near, far) = ([size, -size, 0.0], [900.0 * size, 0.1 * size, -300.0 * size]);
    vec![
        Pose::IDENTITY,
        placed(scene, turned, near),
        placed(scene, turned, far),
        placed(scene, bent, near),
    ]
}

/// Every scene with its poses, and points of the world near the moved model.
fn each(count: usize, seed: u64, mut ask: impl FnMut(&Scene, &Pose, Point)) {
    let mut rng = Rng::new(seed);
    for scene in all() {
        for pose in poses(scene, &mut rng) {
            for p in scene.points(count, &mut rng) {
                ask(scene, &pose, pose.to_world(p));
            }
        }
    }
}

#[test]
fn distances_of_a_moved_model_contain_the_truth_and_are_narrow() {
    let mut narrow = 0;
    let mut asked = 0;
    each(7, 71, |scene, pose, world| {
        let Ok(here) = pose.to_model(world) else { return };
        let tree = scene.bvh();
        let near =
            tree.closest_point(here.point, Budget::EXACT, &mut stack(STACK)).expect("finite");
        let (distance, truth) = (here.distance(near.distance), truth(scene, pose, world));
        assert!(
            contains(distance, truth),
            "{}: {pose:?} {world:?}: {distance:?} {truth:?}",
            scene.name
        );
        asked += 1;
        let width = f64::from(distance.upper) - f64::from(distance.lower);
        let reach =
            truth.upper + scene.reach() + world.iter().fold(0f64, |m, x| m.max(f64::from(x.abs())));
        let stretched = if pose.rotation[0][0] == 1.0 { 0.0 } else { 1e-6 };
        let allowed = 2.0 * f64::from(tree.surface_error()) + 4e-6 * reach + stretched * reach;
        narrow += usize::from(width <= allowed);
    });
    assert!(asked > 1000 && 4 * narrow > 2 * asked, "{narrow} of {asked} are narrow");
}

#[test]
fn a_model_that_is_not_within_is_farther_in_the_world() {
    let (mut clear, mut near) = (0, 0);
    each(5, 72, |scene, pose, world| {
        let Ok(here) = pose.to_model(world) else { return };
        let truth = truth(scene, pose, world);
        for factor in [0.5, 0.9, 0.999_999, 1.0, 1.1] {
            let d = (truth.upper * factor).min(1e38) as f32;
            let found = scene
                .bvh()
                .within(here.point, here.model_distance(d), Budget::EXACT, &mut stack(STACK))
                .expect("finite");
            if found.verdict == Verdict::No {
                assert!(truth.upper > f64::from(d), "{}: {pose:?} {world:?} {d:e}", scene.name);
                clear += 1;
            } else {
                near += 1;
            }
        }
    });
    assert!(clear > 400 && near > 400, "{clear} clear, {near} near");
}

#[test]
fn a_carried_segment_with_its_error_is_never_clear_of_what_it_meets() {
    let (mut clear, mut sure) = (0, 0);
    let mut rng = Rng::new(73);
    for scene in super::segments::scenes::all().iter().filter(|scene| scene.triangles.len() < 400) {
        for pose in poses(scene, &mut rng) {
            let places: Vec<Place> = scene
                .positions
                .iter()
                .map(|&p| Place::moved(p, &pose.rotation, pose.translation))
                .collect();
            for _ in 0..4 {
                let [a, b] = [scene.around(1.5, &mut rng), scene.on_surface(&mut rng)]
                    .map(|p| pose.to_world(p));
                let Ok([from, to]) =
                    (|| Ok::<_, QueryError>([pose.to_model(a)?, pose.to_model(b)?]))()
                else {
                    continue;
                };
                let [tree, _] = scene.trees();
                let tree = tree.with_error(from.error.max(to.error)).expect("finite");
                let hit = tree
                    .first_hit(from.point, to.point, Facing::Both, Budget::EXACT, &mut stack(STACK))
                    .expect("in the domain");
                let [a, b] = [a, b].map(Place::of);
                // The axes of the predicate part no two segments of one plane.
                let with_area = scene
                    .triangles
                    .iter()
                    .filter(|t| has_area(t.map(|v| scene.positions[v as usize])));
                let mut met = with_area
                    .filter(|t| triangles_meet(t.map(|v| &places[v as usize]), [&a, &b, &b]));
                let meets = met.next().is_some();
                if hit.is_clear() {
                    assert!(!meets, "{}: {pose:?} {from:?} {to:?}", scene.name);
                    clear += 1;
                } else if hit.ended == Ended::Exact {
                    // Without area nothing is proved to be met.
                    assert!(meets, "{}: {pose:?} {from:?} {to:?}", scene.name);
                    sure += 1;
                }
            }
        }
    }
    assert!(clear + sure > 100, "{clear} clear, {sure} sure");
}

#[test]
fn an_error_of_the_place_is_in_every_distance() {
    let mut rng = Rng::new(74);
    for scene in all() {
        let size = scene.size();
        for p in scene.points(6, &mut rng) {
            let d = rng.direction();
            let asked: Point = std::array::from_fn(|k| p[k] + d[k] * 0.01 * size);
            let away: f64 =
                (0..3).map(|k| (f64::from(asked[k]) - f64::from(p[k])).powi(2)).sum::<f64>().sqrt();
            let error = (away as f32).next_up();
            let tree = scene.bvh().with_error(error).expect("finite");
            let Ok(near) = tree.closest_point(asked, Budget::EXACT, &mut stack(STACK)) else {
                continue;
            };
            let truth = scene.truth(p);
            assert!(contains(near.distance, truth), "{}: {p:?} {near:?} {truth:?}", scene.name);
        }
        let tree = scene.bvh();
        for bad in [-1.0, f32::NAN, f32::INFINITY] {
            assert_eq!(tree.with_error(bad).err(), Some(QueryError::Tolerance));
        }
        assert!(tree.with_error(0.0).expect("none").surface_error() >= tree.surface_error());
    }
}

#[test]
fn a_segment_that_may_turn_is_clear_of_no_facing_that_a_place_of_it_meets() {
    // Planes that the segment crosses within the error of an end, so that it may cross the other
    // way, and one that it crosses far from both ends.
    let oblique = |z: f32, y: f32| [0.04 * (z - 10.0), y, z];
    let planes = [
        [oblique(-190.0, -100.0), oblique(-190.0, 100.0), oblique(310.0, 0.0)],
        [[-100.0, -100.0, 0.3], [100.0, -90.0, 0.3], [0.0, 120.0, 0.3]],
        [[-100.0, -100.0, 10.0], [100.0, -90.0, 10.0], [0.0, 120.0, 10.0]],
    ];
    let mut rng = Rng::new(76);
    let mut clear = 0;
    for plane in planes {
        let scene = Scene::both("plane", (plane.to_vec(), vec![[0, 1, 2]]));
        for tree in scene.trees() {
            let noisy = tree.with_error(1.0).expect("finite");
            for facing in [Facing::Front, Facing::Back] {
                for (a, b) in [([0.0; 3], [0.0, 0.0, 20.0]), ([0.0; 3], [0.0, 0.0, 0.1])] {
                    let ask = |tree: &Bvh<'_>, a: Point, b: Point| {
                        let (exact, queue) = (Budget::EXACT, &mut stack(STACK));
                        let any = tree.any_hit(a, b, facing, exact, queue).expect("answers");
                        let first = tree.first_hit(a, b, facing, exact, queue).expect("answers");
                        (any.verdict, first.is_clear())
                    };
                    let (verdict, is_clear) = ask(&noisy, a, b);
                    clear += usize::from(verdict == Verdict::No);
                    for _ in 0..200 {
                        let [by_a, by_b] = [rng.direction(), rng.direction()];
                        let place =
                            |p: Point, by: Point| std::array::from_fn(|k| p[k] + 0.99 * by[k]);
                        let (meets, misses) = ask(&tree, place(a, by_a), place(b, by_b));
                        assert!(
                            verdict != Verdict::No || meets != Verdict::Yes,
                            "{plane:?} {facing:?} {a:?} {b:?}"
                        );
                        assert!(
                            !is_clear || misses || meets != Verdict::Yes,
                            "{plane:?} {facing:?}"
                        );
                        assert!(
                            verdict != Verdict::Yes || meets != Verdict::No,
                            "{plane:?} {facing:?} {a:?} {b:?}"
                        );
                    }
                }
            }
        }
    }
    assert!(clear > 0, "nothing was clear");
}

#[test]
fn an_error_that_overflows_is_refused_and_any_other_is_never_clear_of_walls() {
    let (positions, mut triangles) = cube(1);
    let is_lid = |t: &[u32; 3], z: f32| t.iter().all(|&v| positions[v as usize][2] == z);
    triangles.retain(|t| !is_lid(t, 1.0) && !is_lid(t, -1.0));
    for tree in Scene::both("tube", (positions, triangles)).trees() {
        let errors = (0..4000).map(|k| f32::MAX * 0.9f32.powi(k));
        let most = errors.filter_map(|error| tree.with_error(error).ok()).next().expect("some");
        let (a, b) = ([0.25, 0.0, -2.0], [0.25, 0.0, 2.0]);
        let any = most.any_hit(a, b, Facing::Both, Budget::EXACT, &mut stack(STACK));
        assert_ne!(any.expect("answers").verdict, Verdict::No);
        assert_eq!(tree.with_error(f32::MAX).err(), Some(QueryError::Tolerance));
    }
}

#[test]
fn a_sweep_about_a_point_and_a_model_that_both_move_holds() {
    let scene = Scene::hull("rough sphere", rough_sphere(3, 0.2, 7), &Default::default());
    let model: Hull<'_> = scene.model();
    let mut scratch = stack(512);
    let mut rng = Rng::new(75);
    let mut pose = placed(&scene, rotation(&mut rng), [3.0, 1.0, -2.0]);
    let mut world = [4.0, 2.0, -1.0];
    let first = pose.to_model(world).expect("a rotation");
    let mut sweep = model.sweep(first.point, &mut scratch).expect("finite");
    for step in 0..300 {
        let by = [1e-5, 1e-4, 1e-3, 0.02][step / 20 % 4];
        world = world.map(|x| x + by * rng.range(-1.0, 1.0));
        pose.translation = pose.translation.map(|x| x + by * rng.range(-1.0, 1.0));
        if step % 50 == 49 {
            pose = placed(&scene, rotation(&mut rng), pose.translation);
        }
        let here: PosedPoint = pose.to_model(world).expect("a rotation");
        sweep.move_to(here.point).expect("finite");
        let near = sweep.closest_point(Budget::EXACT).expect("answers");
        let fresh =
            model.closest_point(here.point, Budget::EXACT, &mut stack(512)).expect("finite");
        assert_eq!((near.triangle, near.point), (fresh.triangle, fresh.point));
        let (distance, truth) = (here.distance(near.distance), truth(&scene, &pose, world));
        assert!(contains(distance, truth), "step {step}: {distance:?} {truth:?}");
    }
}

#[test]
fn a_pose_that_is_no_motion_is_refused() {
    let of = |rotation: [Point; 3], translation: Point| Pose::rigid(rotation, translation);
    let zero = of([[0.0; 3]; 3], [0.0; 3]);
    assert_eq!(zero.to_model([0.0; 3]).err(), Some(QueryError::PoseOutOfDomain));
    let mut twice = Pose::IDENTITY;
    twice.rotation[1][1] = 2.0;
    assert_eq!(twice.to_model([0.0; 3]).err(), Some(QueryError::PoseOutOfDomain));
    let mut huge = Pose::IDENTITY;
    huge.rotation[0][2] = 3e38;
    assert_eq!(huge.to_model([0.0; 3]).err(), Some(QueryError::PoseOutOfDomain));
    let away = of(Pose::IDENTITY.rotation, [-3e38, 0.0, 0.0]);
    assert_eq!(away.to_model([3e38, 0.0, 0.0]).err(), Some(QueryError::OutOfDomain));
    for bad in [f32::NAN, f32::INFINITY] {
        assert_eq!(Pose::IDENTITY.to_model([0.0, bad, 0.0]).err(), Some(QueryError::NotFinite));
        let nowhere = of(Pose::IDENTITY.rotation, [bad, 0.0, 0.0]);
        assert_eq!(nowhere.to_model([0.0; 3]).err(), Some(QueryError::NotFinite));
    }
    let here = Pose::IDENTITY.to_model([1.0, 2.0, 3.0]).expect("no motion");
    assert_eq!(here.point, [1.0, 2.0, 3.0]);
    assert!(here.error < 1e-14, "{here:?}");
}
