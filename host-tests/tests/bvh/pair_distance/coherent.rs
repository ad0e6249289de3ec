//! Models that move from one question to the next, held to the true distance at every pose.

use super::held::{contains, distance_holds, truth, verdict_holds};
use meshsweep_core::{
    Budget, Bvh, CoherentPair, Ended, Interval, Motion, Pose, Scratch, ScratchEntry, Verdict,
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
            assert!(found.work.opened <= steps, "{found:?}");
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
    let mut searched = 0;
    for step in 0..50 {
        let x = right + a.size() - 0.01 * a.size() * step as f32;
        let pose = Pose { translation: [x, 0.0, 0.0], ..Pose::IDENTITY };
        let keep = 0.1 * a.size();
        let found = pair.within(&first, &second, pose, keep, EXACT, &mut memory).expect("answers");
        assert!(found.is_clear());
        searched += usize::from(found.work.opened > 0);
    }
    assert!(searched <= 4, "{searched} of 50");
}

/// Steps toward contact, with memory and steps that change from question to question: no bound that
/// was kept is too high.
#[test]
fn a_pair_contradicts_no_search_from_the_roots() {
    let meshes =
        [torus(2.0, 0.75, 16, 8), rough_sphere(2, 0.4, 3), bracket(), slivers(60, 8, true)];
    let scenes = meshes.map(|mesh| Scene::both("", mesh));
    let mut rng = Rng::new(44);
    let mut fresh = scratch();
    let (mut short, mut whole) = (0, 0);
    for run in 0..48 {
        let (a, b) = (&scenes[rng.below(4)], &scenes[rng.below(4)]);
        let (first, second) = (a.trees()[run & 1], b.trees()[run >> 1 & 1]);
        let mut pair = CoherentPair::<2048>::new();
        let mut memory = [ScratchEntry::EMPTY; Bvh::DISTANCE_ENTRIES];
        let (low, high) = a.bounds();
        let grown = 0.5 * b.size();
        let place = rng.point_in(low.map(|x| x - grown), high.map(|x| x + grown));
        let mut pose = placed(b, rotation(&mut rng), place);
        for _ in 0..24 {
            let truth = first.distance_to(&second, pose, EXACT, &mut fresh).expect("answers");
            let Interval { lower, upper } = truth.distance;
            let is_cut = run % 3 > 0 && rng.below(3) == 0;
            let entries = if is_cut { [1, 3, 6, 9][rng.below(4)] } else { memory.len() };
            let steps = if is_cut && rng.below(2) == 0 { rng.below(30) as u32 } else { u32::MAX };
            let budget = EXACT.with_steps(steps);
            let memory = &mut memory[..entries];
            for part in [0.5, 0.999_999, 1.000_001, 1.5] {
                let distance = part * if part < 1.0 { lower } else { upper };
                let found = pair.within(&first, &second, pose, distance, budget, memory);
                let found = found.expect("answers").verdict;
                let name = format!("{run}: {distance} {found:?} {truth:?}");
                assert!(found != Verdict::Yes || lower <= distance, "{name}");
                assert!(found != Verdict::No || upper > distance, "{name}");
            }
            let found = pair.distance(&first, &second, pose, budget, memory).expect("answers");
            let name = format!("{run}: {found:?} {truth:?}");
            assert!(found.distance.lower <= upper && lower <= found.distance.upper, "{name}");
            short += usize::from(matches!(found.ended, Ended::Steps | Ended::Scratch));
            whole += usize::from(found.ended == Ended::Exact);
            // A small part of the way to contact, or a step anywhere.
            let toward = [0.01, 0.1, 0.5][rng.below(3)];
            let [here, there] = truth.points;
            let aside = rng.direction().map(|x| x * 1e-3 * a.size() * rng.unit_f32());
            for (k, x) in pose.translation.iter_mut().enumerate() {
                *x -= toward * (there[k] - here[k]) + aside[k];
            }
        }
    }
    assert!(short > 20 && whole > 500, "{short} {whole}");
}
