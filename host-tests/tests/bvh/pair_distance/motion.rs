//! A model that moves keeps its distance as long as is said, and no much longer.

use super::held::truth;
use meshsweep_core::{Budget, Bvh, Ended, Motion, PairContact, Pose, QueryError, ScratchEntry};
use meshsweep_host_tests::generate::corpus::IDENTITY;
use meshsweep_host_tests::generate::{Rng, cube, rough_sphere, torus};
use meshsweep_host_tests::motion::{motions, placed, rotation};
use meshsweep_host_tests::scene::Scene;

fn ask(a: &Bvh<'_>, b: &Bvh<'_>, motion: &Motion, keep: f32, budget: Budget) -> PairContact {
    let mut stack = [ScratchEntry::EMPTY; Bvh::DISTANCE_ENTRIES];
    a.first_contact_of(b, motion, keep, budget, &mut stack).expect("answers")
}

/// A motion, and its pose at a time, rounded.
struct Course<'a> {
    motion: Motion,
    at: Box<dyn Fn(f64) -> Pose + 'a>,
}

fn straight(ends: [Pose; 2]) -> Course<'static> {
    let [from, to] = ends;
    Course { motion: Motion::straight(from, to), at: Box::new(move |t| mixed(&ends, t)) }
}

type Point = [f64; 3];

/// A screw about an axis through a point: an angle and a way along it.
struct Screw {
    axis: Point,
    through: Point,
    angle: f64,
    along: f64,
}

impl Screw {
    /// A point after a part of the screw, by its parts along and across the axis.
    fn moved(&self, p: Point, t: f64) -> Point {
        let n = self.axis;
        let v: Point = [0, 1, 2].map(|k| p[k] - self.through[k]);
        let height: f64 = (0..3).map(|k| n[k] * v[k]).sum();
        let across: Point = [0, 1, 2].map(|k| v[k] - height * n[k]);
        let beside = [
            n[1] * across[2] - n[2] * across[1],
            n[2] * across[0] - n[0] * across[2],
            n[0] * across[1] - n[1] * across[0],
        ];
        let (sine, cosine) = (t * self.angle).sin_cos();
        let height = height + t * self.along;
        let turned = |k: usize| cosine * across[k] + sine * beside[k] + height * n[k];
        [0, 1, 2].map(|k| self.through[k] + turned(k))
    }

    /// A pose after a part of the screw: where the frame's origin and the ends of its axes are.
    fn pose(&self, from: &Pose, t: f64) -> Pose {
        let origin = from.translation.map(f64::from);
        let end = |k: usize| [0, 1, 2].map(|i: usize| origin[i] + f64::from(from.rotation[i][k]));
        let at = self.moved(origin, t);
        let ends = [0, 1, 2].map(|k| self.moved(end(k), t));
        Pose::rigid(
            [0, 1, 2].map(|i: usize| [0, 1, 2].map(|k: usize| (ends[k][i] - at[i]) as f32)),
            at.map(|x| x as f32),
        )
    }

    fn random(rng: &mut Rng, size: f32) -> Self {
        let axis = rng.direction().map(f64::from);
        let length = axis.iter().map(|x| x * x).sum::<f64>().sqrt();
        Self {
            axis: axis.map(|x| x / length),
            through: rng.direction().map(|x| f64::from(x * size)),
            angle: f64::from(rng.range(0.0, 3.0)) * [1.0, 1e-3, 1e-7, 0.0][rng.below(4)],
            along: f64::from(rng.range(-size, size)),
        }
    }
}

fn screwed(from: Pose, screw: &Screw) -> Course<'_> {
    let motion = Motion::screw(from, screw.pose(&from, 1.0)).expect("rotations");
    Course { motion, at: Box::new(move |t| screw.pose(&from, t)) }
}

fn mixed(ends: &[Pose; 2], t: f64) -> Pose {
    let mix = |a: f32, b: f32| (f64::from(a) * (1.0 - t) + f64::from(b) * t) as f32;
    let [from, to] = ends;
    let row = |i: usize| [0, 1, 2].map(|k: usize| mix(from.rotation[i][k], to.rotation[i][k]));
    let shift = |k: usize| mix(from.translation[k], to.translation[k]);
    Pose::affine([0, 1, 2].map(row), [0, 1, 2].map(shift))
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
        let poses = motions(a, b, 12, 5 + number as u64);
        for ends in poses.chunks_exact(2) {
            let turned = Pose { translation: ends[1].translation, ..ends[0] };
            let keep = 0.3 * rng.unit_f32();
            let away =
                |pose: &Pose| Pose { translation: pose.translation.map(|x| 2.5 * x), ..*pose };
            let passing = [&ends[0], &ends[1]].map(away);
            let screw = Screw::random(&mut rng, 3.0);
            for course in [
                straight([ends[0], ends[1]]),
                straight([ends[0], turned]),
                straight(passing),
                screwed(ends[0], &screw),
                screwed(passing[0], &screw),
            ] {
                for (first, second) in a.trees().iter().zip(b.trees()) {
                    let found = ask(first, &second, &course.motion, keep, Budget::EXACT);
                    let until = f64::from(found.clear_until).min(1.0);
                    let slack = 1e-5 * (a.reach() + b.reach());
                    if until > 0.0 {
                        for part in [0.0, 0.1, 0.35, 0.6, 0.85, 0.99] {
                            let truth = truth(a, b, &(course.at)(until * part));
                            assert!(truth.upper > f64::from(keep) - slack, "{found:?} {truth:?}");
                        }
                    }
                    clear += usize::from(found.is_clear());
                    assert_eq!(found.is_clear(), found.ended == Ended::Exact, "{found:?}");
                    if !found.is_clear() {
                        stopped += 1;
                        let errors = f64::from(first.surface_error() + second.surface_error());
                        let near = truth(a, b, &(course.at)(until));
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
            let found =
                ask(first, &second, &Motion::straight(ends[0], ends[1]), 0.0, Budget::EXACT);
            assert!(found.clear_until < 0.5 && found.clear_until > 0.4, "{found:?}");
        }
    }
}

#[test]
fn few_steps_and_bad_numbers_are_said() {
    let scene = Scene::both("", torus(2.0, 0.75, 24, 12));
    let [tree, _] = scene.trees();
    let at = |x: f32| Pose::rigid(IDENTITY, [x, 0.0, 0.0]);
    let ends = Motion::straight(at(-9.0), at(9.0));
    let found = ask(&tree, &tree, &ends, 0.0, Budget::EXACT.with_steps(3));
    assert!(found.ended == Ended::Steps && found.work.opened <= 3, "{found:?}");
    let full = ask(&tree, &tree, &ends, 0.0, Budget::EXACT);
    assert!(found.clear_until <= full.clear_until, "{found:?} {full:?}");
    let mut stack = [ScratchEntry::EMPTY; Bvh::DISTANCE_ENTRIES];
    let mut refused =
        |motion, keep| tree.first_contact_of(&tree, &motion, keep, Budget::EXACT, &mut stack);
    assert_eq!(refused(Motion::straight(at(0.0), at(f32::NAN)), 0.0), Err(QueryError::NotFinite));
    assert_eq!(refused(ends, -1.0), Err(QueryError::Tolerance));
    assert_eq!(refused(ends, f32::INFINITY), Err(QueryError::Tolerance));
}

#[test]
fn a_screw_between_two_poses_is_the_one_that_leads_from_one_to_the_other() {
    let mut rng = Rng::new(4);
    for _ in 0..2000 {
        let screw = Screw::random(&mut rng, 10.0);
        let from = Pose::rigid(rotation(&mut rng), rng.direction().map(|x| 20.0 * x));
        let Course { motion, at } = screwed(from, &screw);
        assert_eq!(motion.at(0.0), from);
        assert_eq!(motion.at(1.0), screw.pose(&from, 1.0));
        for part in [0.0, 0.25, 0.5, 0.9, 1.0] {
            let (found, wanted) = (motion.at(part), at(f64::from(part)));
            let numbers = |pose: &Pose| -> Vec<f32> {
                pose.rotation.iter().flatten().chain(&pose.translation).copied().collect()
            };
            for (x, y) in numbers(&found).iter().zip(numbers(&wanted)) {
                assert!((x - y).abs() < 2e-5, "{part} {found:?} {wanted:?}");
            }
        }
    }
}

/// The ball swings about an axis from one side of a thin wall to the other. The chord of its way
/// goes round the wall.
#[test]
fn a_wall_in_the_way_of_a_turn_is_found() {
    let mut wall = cube(4);
    wall.0.iter_mut().for_each(|p| *p = [1e-4 * p[0], p[1] + 8.0, p[2]]);
    let (wall, ball) = (Scene::both("", wall), Scene::both("", rough_sphere(1, 0.3, 2)));
    let at = |degrees: f32| {
        let (s, c) = degrees.to_radians().sin_cos();
        let rotation = [[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]];
        Pose::rigid(rotation, [-8.0 * s, 8.0 * c, 0.0])
    };
    let (from, to) = (at(-80.0), at(80.0));
    for (first, second) in wall.trees().iter().zip(ball.trees()) {
        let turn = Motion::screw(from, to).expect("rotations");
        let found = ask(first, &second, &turn, 0.0, Budget::EXACT);
        assert!(found.clear_until < 0.5 && found.clear_until > 0.3, "{found:?}");
        let chord = Motion::straight(from, to);
        assert!(ask(first, &second, &chord, 0.0, Budget::EXACT).is_clear());
    }
}

#[test]
fn a_screw_ends_at_its_second_pose_also_with_matrices_of_three_decimals() {
    let mut rng = Rng::new(5);
    let coarse = |rng: &mut Rng| {
        let rotation = rotation(rng).map(|row| row.map(|x| (x * 2e3).round() / 2e3));
        Pose::rigid(rotation, rng.direction())
    };
    let scene = Scene::both("", cube(1));
    for _ in 0..50 {
        let (from, to) = (coarse(&mut rng), coarse(&mut rng));
        let motion = Motion::screw(from, to).expect("nearly rotations");
        assert_eq!((motion.at(0.0), motion.at(1.0)), (from, to));
        // What is missing of a rotation is made up for on the way: no point jumps.
        let corner = [1.0, -1.0, 1.0];
        let place = |t: f32| motion.at(t).to_world(corner).map(f64::from);
        let pieces = 200;
        let mut longest = 0f64;
        for k in 0..pieces {
            let (a, b) = (place(k as f32 / pieces as f32), place((k + 1) as f32 / pieces as f32));
            let step = (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt();
            longest = longest.max(step * f64::from(pieces));
        }
        let [tree, _] = scene.trees();
        let from_afar = Pose { translation: [9.0, 0.0, 0.0], ..Pose::IDENTITY };
        let shifted = |pose: Pose| {
            let [x, y, z] = pose.translation;
            Pose { translation: [x + from_afar.translation[0], y, z], ..pose }
        };
        let away = Motion::screw(shifted(from), shifted(to)).expect("nearly rotations");
        assert!(ask(&tree, &tree, &away, 0.0, Budget::EXACT).clear_until > 0.0);
        assert!(longest < 20.0, "{longest}");
    }
}

#[test]
fn what_is_no_rotation_has_no_screw() {
    let mut mirror = Pose::IDENTITY;
    mirror.rotation[0][0] = -1.0;
    let mut large = Pose::IDENTITY;
    large.rotation[1][1] = 1.01;
    for other in [mirror, large] {
        for (from, to) in [(Pose::IDENTITY, other), (other, Pose::IDENTITY)] {
            assert_eq!(Motion::screw(from, to), Err(QueryError::NotRigid));
        }
    }
    let nan = Pose { translation: [0.0, f32::NAN, 0.0], ..Pose::IDENTITY };
    assert_eq!(Motion::screw(nan, Pose::IDENTITY), Err(QueryError::NotFinite));
}

#[test]
fn every_pose_on_a_screw_serves_the_next_question() {
    let mut rng = Rng::new(11);
    let scene = Scene::both("", cube(1));
    let [tree, _] = scene.trees();
    let mut stack = [ScratchEntry::EMPTY; Bvh::DISTANCE_ENTRIES];
    // Rotations as f32 rounds them, and those that are as long or as short as one may be.
    for lack in [0.0, 1.45e-3] {
        let mut affine = 0;
        for _ in 0..200 {
            let longer = |pose: Pose, by: f32| Pose {
                rotation: pose.rotation.map(|row| row.map(|x| x * (1.0 + by))),
                ..pose
            };
            let from = Pose::rigid(rotation(&mut rng), [4.0, 0.0, 0.0]);
            let to = Screw::random(&mut rng, 3.0).pose(&from, 1.0);
            let motion = Motion::screw(longer(from, lack), longer(to, -lack)).expect("rotations");
            for part in 0..=32 {
                let pose = motion.at(part as f32 / 32.0);
                affine += u32::from(pose.is_affine);
                tree.distance_to(&tree, pose, Budget::EXACT, &mut stack).expect("answers");
            }
        }
        assert_eq!(affine > 0, lack > 0.0, "{affine}");
    }
}
