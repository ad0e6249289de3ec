//! Memory, steps, tolerances, and what is refused.

use super::held::{ask, contains, truth};
use meshsweep::bvh::{TreeOptions, build};
use meshsweep::mesh::Mesh;
use meshsweep::progress::Watch;
use meshsweep_core::{
    Budget, BuildFor, Bvh, CoherentPair, Ended, Pose, QueryError, Scratch, ScratchEntry, Undecided,
    Verdict,
};
use meshsweep_host_tests::generate::{cube, rough_sphere, scaled, torus};
use meshsweep_host_tests::motion::motions;
use meshsweep_host_tests::scene::Scene;

fn scenes() -> [Scene; 2] {
    [Scene::both("", torus(2.0, 0.75, 24, 12)), Scene::both("", rough_sphere(2, 0.6, 1))]
}

#[test]
fn short_scratch_and_few_steps_widen_intervals_and_never_make_them_wrong() {
    let [a, b] = scenes();
    let (first, second) = (a.trees()[1], b.trees()[1]);
    let mut cut = [0usize; 2];
    for pose in motions(&a, &b, 20, 6) {
        let truth = truth(&a, &b, &pose);
        let full = ask(&first, &second, &pose, Budget::EXACT);
        for entries in 1..16 {
            let mut stack = vec![ScratchEntry::EMPTY; entries];
            let short =
                first.distance_to(&second, pose, Budget::EXACT, &mut stack).expect("answers");
            assert!(contains(short.distance, truth), "{short:?} {truth:?}");
            assert!(short.distance.upper >= full.distance.upper);
            cut[0] += usize::from(short.ended == Ended::Scratch);
            let limit = 0.9 * truth.lower as f32;
            let within = first.within_of(&second, pose, limit, Budget::EXACT, &mut stack);
            let verdict = within.expect("answers").verdict;
            assert!(
                matches!(verdict, Verdict::No | Verdict::Undecided(Undecided::Scratch))
                    || truth.upper == 0.0,
                "{verdict:?}"
            );
        }
        for steps in [0, 1, 2, 5, 10, 20] {
            let short = ask(&first, &second, &pose, Budget::EXACT.with_steps(steps));
            assert!(short.work.opened <= steps);
            assert!(contains(short.distance, truth), "{short:?} {truth:?}");
            cut[1] += usize::from(short.ended == Ended::Steps);
        }
    }
    assert!(cut[0] > 5 && cut[1] > 20, "{cut:?}");
}

#[test]
fn tolerances_are_met_with_less_work() {
    let [a, b] = scenes();
    let mut met = 0;
    let mut work = [0u32; 2];
    for pose in motions(&a, &b, 20, 7) {
        let truth = truth(&a, &b, &pose);
        for (first, second) in a.trees().iter().zip(b.trees()) {
            let full = ask(first, &second, &pose, Budget::EXACT);
            for budget in [Budget::EXACT.with_relative(0.1), Budget::EXACT.with_absolute(0.2)] {
                let found = ask(first, &second, &pose, budget);
                assert!(contains(found.distance, truth), "{found:?} {truth:?}");
                let (lower, upper) = (found.distance.lower, found.distance.upper);
                let near_enough =
                    upper <= lower * (1.0 + budget.relative) || upper - lower <= budget.absolute;
                let is_exact = found.ended == Ended::Exact && found.distance == full.distance;
                assert!(near_enough || is_exact, "{found:?} {full:?}");
                met += usize::from(found.ended == Ended::Tolerance);
                work[0] += full.work.total();
                work[1] += found.work.total();
            }
        }
    }
    assert!(met > 10 && work[1] < work[0], "{met} {work:?}");
}

#[test]
fn what_cannot_be_answered_is_refused() {
    let scene = Scene::both("", cube(2));
    let [tree, _] = scene.trees();
    let refused = |a: &Bvh<'_>, b: &Bvh<'_>, pose: Pose, entries: usize| {
        let mut stack = vec![ScratchEntry::EMPTY; entries];
        let first = a.distance_to(b, pose, Budget::EXACT, &mut stack).expect_err("refused");
        let also = a.within_of(b, pose, 1.0, Budget::EXACT, &mut stack).expect_err("refused");
        assert_eq!(first, also);
        first
    };
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let mut pose = Pose::IDENTITY;
        pose.translation[1] = bad;
        assert_eq!(refused(&tree, &tree, pose, 8), QueryError::NotFinite);
        let mut pose = Pose::IDENTITY;
        pose.rotation[2][0] = bad;
        assert_eq!(refused(&tree, &tree, pose, 8), QueryError::NotFinite);
    }
    let mut stretched = Pose::IDENTITY;
    stretched.rotation[0][0] = 2.5;
    assert_eq!(refused(&tree, &tree, stretched, 8), QueryError::PoseOutOfDomain);
    assert_eq!(refused(&tree, &tree, Pose::IDENTITY, 0), QueryError::NoScratch);
    let tiny = Scene::both("", scaled(&cube(2), 1e-20));
    assert_eq!(refused(&tree, &tiny.trees()[0], Pose::IDENTITY, 8), QueryError::PoseOutOfDomain);
    let mesh = Mesh::new(cube(1).0, cube(1).1);
    let options = TreeOptions::default().with_segments(false);
    let bytes = build(mesh.as_input(), &options, Watch::NONE).expect("builds").0.to_bytes();
    let closest_only = Bvh::open(&bytes).expect("opens");
    let refusal = refused(&tree, &closest_only, Pose::IDENTITY, 8);
    assert_eq!(refusal, QueryError::NotServed { build_for: BuildFor::Segment });
    let mut stack = [ScratchEntry::EMPTY; 8];
    for bad in [-1.0, f32::NAN, f32::INFINITY] {
        let found = tree.within_of(&tree, Pose::IDENTITY, bad, Budget::EXACT, &mut stack);
        assert_eq!(found.expect_err("refused"), QueryError::Tolerance);
        let budget = Budget::EXACT.with_relative(bad);
        let found = tree.distance_to(&tree, Pose::IDENTITY, budget, &mut stack);
        assert_eq!(found.expect_err("refused"), QueryError::Tolerance);
    }
}

/// Without surface errors nothing but rounding widens an interval.
#[test]
fn next_to_contact_an_interval_is_as_narrow_as_that_of_the_search_in_f64() {
    let first = [[30000.0, 30000.0, 30000.0], [60000.0, 0.0, 0.0], [0.0, 60000.0, 0.0]];
    let second = [[30000.0, 30000.0, 30000.0], [60000.0, 1000.0, 60000.0], [0.0, 60000.0, 60000.0]];
    let [a, b] = [first, second].map(|of| Scene::both("", (of.to_vec(), vec![[0, 1, 2]])));
    let (a, b) = (a.bvh(), b.bvh());
    assert_eq!([a.surface_error(), b.surface_error()], [0.0; 2]);
    let mut scratch = Scratch::<{ Bvh::DISTANCE_ENTRIES }>::new();
    for z in [1e3f32, 1.0, 1e-2, 1e-4, 1e-5, 3e-6, 1e-6, 1e-7] {
        let pose = Pose { translation: [0.0, 0.0, z], ..Pose::IDENTITY };
        let found = a.distance_to(&b, pose, Budget::EXACT, &mut scratch).expect("answers");
        let mut pair = CoherentPair::<1024>::new();
        let other = pair.distance(&a, &b, pose, Budget::EXACT, &mut scratch).expect("answers");
        let [width, known] = [found, other].map(|d| d.distance.upper - d.distance.lower);
        assert!(width <= known + 4.0 * f32::EPSILON * z, "{z:e}: {found:?} {other:?}");
    }
}
