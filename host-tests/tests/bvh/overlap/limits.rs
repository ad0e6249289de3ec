//! Memory, steps, and what is refused.

use super::motions::{ask, ask_all, motions, truth};
use meshsweep::bvh::{TreeOptions, build};
use meshsweep::mesh::{Input, Mesh};
use meshsweep::progress::Watch;
use meshsweep_core::{
    Budget, BuildFor, Bvh, Ended, Pose, QueryError, ScratchEntry, TrianglePair, Undecided, Verdict,
};
use meshsweep_host_tests::generate::{cube, rough_sphere, scaled, torus};
use meshsweep_host_tests::scene::Scene;

#[test]
fn short_stacks_and_few_steps_leave_answers_open_and_never_wrong() {
    let (a, b) =
        (Scene::both("", torus(2.0, 0.75, 24, 12)), Scene::both("", rough_sphere(3, 0.6, 1)));
    let (first, second) = (a.trees()[1], b.trees()[1]);
    let mut cut = [0usize; 2];
    for pose in motions(&a, &b, 40, 6) {
        let full = ask(&first, &second, &pose);
        for entries in 1..8 {
            let mut stack = vec![ScratchEntry::EMPTY; entries];
            let short = first.overlap(&second, pose, Budget::EXACT, &mut stack).expect("answers");
            if short.verdict == Verdict::Undecided(Undecided::Scratch) {
                cut[0] += 1;
            } else {
                assert_eq!(short.verdict, full.verdict);
            }
        }
        let mut stack = [ScratchEntry::EMPTY; Bvh::OVERLAP_ENTRIES];
        for steps in [0, 1, 2, 5, 10, 20] {
            let short = first
                .overlap(&second, pose, Budget::EXACT.with_steps(steps), &mut stack)
                .expect("answers");
            assert!(short.work.opened <= steps);
            if short.verdict == Verdict::Undecided(Undecided::Steps) {
                cut[1] += 1;
            } else {
                assert_eq!((short.verdict, short.witness), (full.verdict, full.witness));
            }
        }
    }
    assert!(cut[0] > 5 && cut[1] > 20, "{cut:?}");
}

#[test]
fn pairs_that_do_not_fit_are_counted() {
    let (a, b) =
        (Scene::both("", torus(2.0, 0.75, 24, 12)), Scene::both("", rough_sphere(3, 0.6, 1)));
    let (first, second) = (a.trees()[1], b.trees()[1]);
    let pose = motions(&a, &b, 40, 7)
        .into_iter()
        .find(|pose| truth(&a, &b, pose).len() > 20)
        .expect("one");
    let (all, _) = ask_all(&first, &second, &pose);
    let mut stack = [ScratchEntry::EMPTY; Bvh::OVERLAP_ENTRIES];
    for room in [0, 1, 7] {
        let mut pairs = vec![TrianglePair::EMPTY; room];
        let found = first
            .all_overlaps(&second, pose, &mut pairs, Budget::EXACT, &mut stack)
            .expect("answers");
        assert_eq!((found.stored, found.dropped as usize), (room, all.len() - room));
        assert_eq!(found.ended, Ended::Scratch);
        assert_eq!(pairs, all[..room]);
    }
}

#[test]
fn what_cannot_be_answered_is_refused() {
    let scene = Scene::both("", cube(2));
    let [tree, _] = scene.trees();
    let mut stack = [ScratchEntry::EMPTY; 8];
    let refused = |a: &Bvh<'_>, b: &Bvh<'_>, pose: Pose, stack: Option<&mut [ScratchEntry]>| {
        let mut own = [ScratchEntry::EMPTY; 8];
        a.overlap(b, pose, Budget::EXACT, stack.unwrap_or(&mut own)).expect_err("refused")
    };
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let mut pose = Pose::IDENTITY;
        pose.translation[1] = bad;
        assert_eq!(refused(&tree, &tree, pose, None), QueryError::NotFinite);
        let mut pose = Pose::IDENTITY;
        pose.rotation[2][0] = bad;
        assert_eq!(refused(&tree, &tree, pose, None), QueryError::NotFinite);
    }
    let mut stretched = Pose::IDENTITY;
    stretched.rotation[0][0] = 2.5;
    assert_eq!(refused(&tree, &tree, stretched, None), QueryError::PoseOutOfDomain);
    assert_eq!(refused(&tree, &tree, Pose::IDENTITY, Some(&mut stack[..0])), QueryError::NoScratch);
    let tiny = Scene::both("", scaled(&cube(2), 1e-20));
    assert_eq!(refused(&tree, &tiny.trees()[0], Pose::IDENTITY, None), QueryError::PoseOutOfDomain);
    assert_eq!(refused(&tiny.trees()[0], &tree, Pose::IDENTITY, None), QueryError::PoseOutOfDomain);
    let mesh = Mesh::new(cube(1).0, cube(1).1);
    let options = TreeOptions::default().with_segments(false);
    let bytes = build(mesh.as_input(), &options, Watch::NONE).expect("builds").0.to_bytes();
    let closest_only = Bvh::open(&bytes).expect("opens");
    // A surface error beside which the model is nothing.
    let bytes =
        build(Input { moved: 1e12, ..mesh.as_input() }, &TreeOptions::default(), Watch::NONE)
            .expect("builds")
            .0
            .to_bytes();
    let vague = Bvh::open(&bytes).expect("opens");
    let flat = Pose::affine([[0.0; 3]; 3], [0.0; 3]);
    for pose in [Pose::IDENTITY, flat] {
        assert_eq!(refused(&vague, &vague, pose, None), QueryError::PoseOutOfDomain);
    }
    let refusal = refused(&tree, &closest_only, Pose::IDENTITY, None);
    assert_eq!(refusal, QueryError::NotServed { build_for: BuildFor::Segment });
}

#[test]
fn far_translations_are_apart_at_once() {
    let scene = Scene::both("", cube(2));
    for tree in scene.trees() {
        for translation in
            [[f32::MAX, 0.0, 0.0], [0.0, -1e30, 1e30], [0.0, 0.0, 2.01], [3e38, 3e38, 3e38]]
        {
            let answer = ask(&tree, &tree, &Pose { translation, ..Pose::IDENTITY });
            assert_eq!(answer.verdict, Verdict::No, "{translation:?}");
        }
    }
}
