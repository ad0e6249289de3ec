//! Models that move from one question to the next, held to the true distance at every pose.

use super::held::{contains, distance_holds, truth, verdict_holds};
use meshsweep_core::{
    Budget, Bvh, CoherentPair, Ended, Motion, Pose, Scratch, ScratchEntry, Verdict,
};
use meshsweep_host_tests::generate::corpus::slivers;
use meshsweep_host_tests::generate::{Rng, Triangles, bracket, cube, rough_sphere, torus};
use meshsweep_host_tests::motion::{placed, rotation};
use meshsweep_host_tests::scene::Scene;

const EXACT: Budget = Budget::EXACT;

fn scratch() -> Scratch<{ Bvh::DISTANCE_ENTRIES }> {
    Scratch::new()
}

/// Poses on the way from one random place to another, with steps of very different sizes.
fn path(a: &Scene, b: &Scene, rng: &mut Rng) -> Vec<Pose> {
    let (low, high) = a.bounds();
    let mut end = || {
        let turn = rotation(rng);
        placed(b, turn, rng.point_in(low.map(|x| x - b.size()), high.map(|x| x + b.size())))
    };
    let motion = Motion::straight(end(), end());
    let steps = [0.0, 1e-5, 1e-4, 1e-4, 1e-3, 1e-3, 1e-3, 1e-2, 1e-2, 0.3];
    let mut t = 0.0;
    let times = steps.iter().cycle().take(25).map(|step| {
        t += step;
        motion.at(t)
    });
    times.collect()
}

/// Asks a pair with memory for `N` groups on a path. Both questions follow each other.
fn follow<const N: usize>(a: &Scene, b: &Scene, which: usize, path: &[(Pose, f64, f64)]) -> usize {
    let (first, second) = (a.trees()[which], b.trees()[1 - which]);
    let (mut pair, mut memory) = (CoherentPair::<N>::new(), scratch());
    let mut kept = 0;
    for &(pose, lower, upper) in path {
        let truth = meshsweep_host_tests::oracle::Bounded { lower, upper };
        let name = format!("{N} groups, {pose:?}");
        let found = pair.distance(&first, &second, pose, EXACT, &mut memory).expect("answers");
        let trees = [&first, &second];
        let width = distance_holds(&name, [a, b], trees, &pose, &found, truth) + 1e-6 * upper;
        for factor in [0.5, 0.99, 1.0, 1.01, 2.0] {
            let distance = (factor * upper) as f32;
            let found = pair.within(&first, &second, pose, distance, EXACT, &mut memory);
            verdict_holds(&name, &found.expect("answers"), distance, truth, width);
        }
        kept += usize::from(pair.groups() > 0);
        assert!(pair.groups() <= N);
    }
    kept
}

#[test]
fn distances_on_a_path_are_those_of_the_input() {
    let meshes: [(Triangles, Triangles); 3] = [
        (torus(2.0, 0.75, 16, 8), rough_sphere(2, 0.4, 3)),
        (bracket(), cube(2)),
        (slivers(60, 8, true), slivers(60, 9, false)),
    ];
    let mut rng = Rng::new(41);
    let mut kept = [0; 4];
    for (a, b) in meshes {
        let (a, b) = (Scene::both("", a), Scene::both("", b));
        for which in [0, 1] {
            let known: Vec<_> = path(&a, &b, &mut rng)
                .into_iter()
                .map(|pose| (pose, truth(&a, &b, &pose)))
                .map(|(pose, truth)| (pose, truth.lower, truth.upper))
                .collect();
            kept[0] += follow::<0>(&a, &b, which, &known);
            kept[1] += follow::<5>(&a, &b, which, &known);
            kept[2] += follow::<60>(&a, &b, which, &known);
            kept[3] += follow::<2048>(&a, &b, which, &known);
        }
    }
    assert_eq!(kept[0], 0, "{kept:?}");
    assert_eq!(kept[3], 150, "{kept:?}");
    assert!(kept[1] < kept[2], "{kept:?}");
}

#[test]
fn a_pair_with_few_steps_or_scratch_never_leaves_the_truth() {
    let (a, b) =
        (Scene::both("", torus(2.0, 0.75, 16, 8)), Scene::both("", rough_sphere(2, 0.4, 3)));
    let (first, second) = (a.bvh(), b.bvh());
    let mut rng = Rng::new(42);
    let (mut short, mut exact) = (0, 0);
    for (steps, entries) in [(0, 384), (1, 384), (7, 384), (40, 384), (u32::MAX, 3), (u32::MAX, 7)]
    {
        let mut pair = CoherentPair::<400>::new();
        let mut memory = [ScratchEntry::EMPTY; Bvh::DISTANCE_ENTRIES];
        let memory = &mut memory[..entries];
        for pose in path(&a, &b, &mut rng) {
            let truth = truth(&a, &b, &pose);
            let budget = EXACT.with_steps(steps);
            let found = pair.distance(&first, &second, pose, budget, memory).expect("answers");
            assert!(contains(found.distance, truth), "{found:?} {truth:?}");
            assert!(found.work.splits <= steps, "{found:?}");
            let (asked, half) = (truth.upper as f32, 0.5 * truth.upper as f32);
            for distance in [half, asked] {
                let found = pair.within(&first, &second, pose, distance, budget, memory);
                let found = found.expect("answers");
                let is_wrong = match found.verdict {
                    Verdict::Yes => f64::from(distance) < truth.lower,
                    Verdict::No => f64::from(distance) >= truth.upper,
                    _ => false,
                };
                assert!(!is_wrong, "{found:?} {truth:?}");
            }
            if found.ended == Ended::Exact { exact += 1 } else { short += 1 }
        }
    }
    assert!(short > 40 && exact > 40, "{short} short, {exact} exact");
}

/// What a pair remembers of two trees says nothing of two others.
#[test]
fn a_pair_begins_anew_with_other_trees() {
    let (a, b) = (Scene::both("", cube(2)), Scene::both("", rough_sphere(2, 0.4, 2)));
    let trees = [a.trees(), b.trees()].concat();
    let mut rng = Rng::new(43);
    let (mut pair, mut memory) = (CoherentPair::<512>::new(), scratch());
    for _ in 0..40 {
        let (i, j) = (rng.below(4), rng.below(4));
        let scenes = [&a, &a, &b, &b];
        let pose = placed(scenes[j], rotation(&mut rng), rng.point_in([-3.0; 3], [3.0; 3]));
        let truth = truth(scenes[i], scenes[j], &pose);
        let found = pair.distance(&trees[i], &trees[j], pose, EXACT, &mut memory);
        let found = found.expect("answers");
        assert!(contains(found.distance, truth), "{found:?} {truth:?}");
    }
}

/// A clear answer is known from the last one while the models may not have come near enough.
#[test]
fn a_model_that_stays_far_is_clear_without_a_look() {
    let (a, b) = (Scene::both("", bracket()), Scene::both("", cube(2)));
    let (first, second) = (a.bvh(), b.bvh());
    let (_, [right, ..]) = a.bounds();
    let (mut pair, mut memory) = (CoherentPair::<512>::new(), scratch());
    for step in 0..50 {
        let x = right + a.size() - 0.01 * a.size() * step as f32;
        let pose = Pose { translation: [x, 0.0, 0.0], ..Pose::IDENTITY };
        let keep = 0.1 * a.size();
        let found = pair.within(&first, &second, pose, keep, EXACT, &mut memory).expect("answers");
        assert!(found.is_clear());
        assert!(step % 25 == 0 || found.work.splits <= 4, "{step}: {found:?}");
    }
}
