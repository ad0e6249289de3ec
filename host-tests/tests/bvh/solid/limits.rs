//! Memory, steps, tolerances, and refusals.

use super::shapes::Shape;
use super::truth::{ask, contains};
use meshsweep_core::{
    Budget, BuildFor, Ended, QueryError, ScratchEntry, Solid, Undecided, Verdict,
};
use meshsweep_host_tests::generate::{Rng, rough_sphere, torus};
use meshsweep_host_tests::scene::Scene;

#[test]
fn short_scratch_and_few_steps_widen_intervals_and_never_make_them_wrong() {
    let scene = Scene::both("torus", torus(2.0, 0.75, 24, 12));
    let mut rng = Rng::new(1);
    let mut cut = [0usize; 2];
    for kind in 0..25 {
        let shape = Shape::random(kind, scene.around(1.5, &mut rng), 1.0, &mut rng);
        let mut to = shape.clone();
        to.corners.iter_mut().for_each(|p| p[0] += 3.0);
        let truth = shape.truth(&scene);
        for tree in scene.trees() {
            let mut stack = vec![ScratchEntry::EMPTY; tree.scratch_entries()];
            let full =
                tree.solid_first_contact(&shape.solid(), &to.solid(), Budget::EXACT, &mut stack);
            let full = full.expect("answers");
            for (entries, steps) in [(1, u32::MAX), (4, u32::MAX), (64, 0), (64, 1), (64, 3)] {
                let budget = Budget::EXACT.with_steps(steps);
                let stack = &mut vec![ScratchEntry::EMPTY; entries][..];
                let short = tree.solid_distance(&shape.solid(), budget, stack).expect("answers");
                assert!(contains(&short, truth, shape.radius), "{short:?} {truth:?}");
                assert!(short.work.opened <= steps);
                cut[0] += usize::from(matches!(short.ended, Ended::Scratch | Ended::Steps));
                let limit = (truth.upper as f32 - shape.radius).max(0.0) * 0.9;
                let within = tree.solid_within(&shape.solid(), limit, budget, stack);
                let verdict = within.expect("answers").verdict;
                let is_open = matches!(verdict, Verdict::Undecided(_));
                assert!(verdict == Verdict::No || is_open || limit == 0.0, "{verdict:?}");
                let motion = tree.solid_first_contact(&shape.solid(), &to.solid(), budget, stack);
                let motion = motion.expect("answers");
                assert!(motion.t.lower <= full.t.lower, "{motion:?} {full:?}");
                cut[1] += usize::from(matches!(motion.ended, Ended::Scratch | Ended::Steps));
            }
        }
    }
    assert!(cut[0] > 50 && cut[1] > 50, "{cut:?}");
}

#[test]
fn tolerances_are_met_with_less_work() {
    let scene = Scene::both("sphere", rough_sphere(3, 0.4, 3));
    let mut rng = Rng::new(2);
    let mut work = [0u32; 2];
    for kind in 0..40 {
        let shape = Shape::random(kind, scene.around(3.0, &mut rng), 0.5, &mut rng);
        let truth = shape.truth(&scene);
        for tree in scene.trees() {
            let full = ask(&tree, &shape, Budget::EXACT);
            let found = ask(&tree, &shape, Budget::EXACT.with_relative(0.3));
            assert!(contains(&found, truth, shape.radius), "{found:?} {truth:?}");
            let (lower, upper) = (found.distance.lower, found.distance.upper);
            assert!(
                upper <= lower * 1.3 || found.ended == Ended::Exact,
                "{shape:?} {found:?} {full:?}"
            );
            work[0] += full.work.total();
            work[1] += found.work.total();
        }
    }
    assert!(work[1] < work[0], "{work:?}");
}

#[test]
fn what_no_solid_is_and_no_tree_serves_is_refused_by_name() {
    let many = [[0f32; 3]; 33];
    assert_eq!(Solid::new(&[], 1.0), Err(QueryError::Corners { found: 0 }));
    assert_eq!(Solid::new(&many, 1.0), Err(QueryError::Corners { found: 33 }));
    for bad in [f32::NAN, f32::INFINITY] {
        assert_eq!(Solid::new(&[[0.0, bad, 0.0]], 1.0), Err(QueryError::NotFinite));
        assert_eq!(Solid::new(&[[0.0; 3]], bad), Err(QueryError::Tolerance));
    }
    assert_eq!(Solid::new(&[[0.0; 3]], -1.0), Err(QueryError::Tolerance));

    let scene = Scene::both("torus", torus(2.0, 0.75, 16, 8));
    let [tree, _] = scene.trees();
    let mut stack = vec![ScratchEntry::EMPTY; tree.scratch_entries()];
    let (one, two) = ([[0f32; 3]], [[0f32; 3]; 2]);
    let (one, two) = (Solid::new(&one, 1.0).unwrap(), Solid::new(&two, 1.0).unwrap());
    let moved = tree.solid_first_contact(&one, &two, Budget::EXACT, &mut stack);
    assert_eq!(moved, Err(QueryError::Corners { found: 2 }));
    let far = [[1e30f32, 0.0, 0.0]];
    let far = Solid::new(&far, 1.0).unwrap();
    let found = tree.solid_distance(&far, Budget::EXACT, &mut stack);
    assert_eq!(found, Err(QueryError::OutOfDomain));
    let found = tree.solid_first_contact(&one, &far, Budget::EXACT, &mut stack);
    assert_eq!(found, Err(QueryError::OutOfDomain));
    // As large a radius would leave nothing of f32's range.
    let large = [[0f32; 3]];
    let large = Solid::new(&large, 1e25).unwrap();
    let found = tree.solid_first_contact(&large, &large, Budget::EXACT, &mut stack);
    assert_eq!(found, Err(QueryError::OutOfDomain));
    let found = tree.solid_within(&one, f32::NAN, Budget::EXACT, &mut stack);
    assert_eq!(found, Err(QueryError::Tolerance));
    let found = tree.solid_distance(&one, Budget::EXACT, &mut []);
    assert_eq!(found, Err(QueryError::NoScratch));

    let scene = Scene::tree("torus", torus(2.0, 0.75, 16, 8), false);
    let found = scene.bvh().solid_distance(&one, Budget::EXACT, &mut stack);
    assert_eq!(found, Err(QueryError::NotServed { build_for: BuildFor::Segment }));
}

#[test]
fn a_radius_and_a_distance_of_any_size_end() {
    let scene = Scene::both("torus", torus(2.0, 0.75, 16, 8));
    for tree in scene.trees() {
        let mut stack = vec![ScratchEntry::EMPTY; tree.scratch_entries()];
        for size in [1.0, 1e4, 1e9, 1e19, 1e30, f32::MAX] {
            let at = [[5.0f32, 0.0, 0.0]];
            let solid = Solid::new(&at, size).unwrap();
            let found = tree.solid_first_contact(&solid, &solid, Budget::EXACT, &mut stack);
            match found {
                Ok(found) => assert!(found.t.lower == 0.0 || size == 1.0, "{size} {found:?}"),
                Err(error) => assert!(error == QueryError::OutOfDomain && size > 1e4, "{size}"),
            }
            let found = tree.solid_distance(&solid, Budget::EXACT, &mut stack);
            match found {
                Ok(found) => assert!(found.distance.upper == 0.0 || size == 1.0, "{found:?}"),
                Err(error) => assert!(error == QueryError::OutOfDomain && size > 1e4, "{size}"),
            }
            let solid = Solid::new(&at, 0.5).unwrap();
            let found = tree.solid_within(&solid, size, Budget::EXACT, &mut stack).unwrap();
            assert_eq!(found.verdict == Verdict::Yes, size > 1.75, "{size} {found:?}");
        }
    }
}

/// Answers without steps are undecided for that reason.
#[test]
fn no_steps_leave_it_open() {
    let scene = Scene::both("torus", torus(2.0, 0.75, 16, 8));
    let [tree, _] = scene.trees();
    let mut stack = vec![ScratchEntry::EMPTY; tree.scratch_entries()];
    let shape = Shape::sphere([2.0, 0.0, 0.0], 0.1);
    let budget = Budget::EXACT.with_steps(0);
    let within = tree.solid_within(&shape.solid(), 1.0, budget, &mut stack).expect("answers");
    assert_eq!(within.verdict, Verdict::Undecided(Undecided::Steps));
    let motion = tree.solid_first_contact(&shape.solid(), &shape.solid(), budget, &mut stack);
    let motion = motion.expect("answers");
    assert!(motion.t.lower == 0.0 && motion.hit.is_none() && motion.ended == Ended::Steps);
}
